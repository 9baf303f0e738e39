# granulaw_gtests(PROGRAM LABELS label... [SUFFIX _word] [ENVIRONMENT VARIABLE=VALUE...]): a ctest for each suite of a GoogleTest program, listed when the
# program is built. Suites named ...Slow, which take over 20 CPU seconds, have the label slow alone.
function(granulaw_gtests program)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SUFFIX" "LABELS;ENVIRONMENT")
  set(file ${CMAKE_CURRENT_BINARY_DIR}/${program}${arg_SUFFIX}_suites.cmake)
  add_custom_command(TARGET ${program} POST_BUILD BYPRODUCTS ${file}
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${program}> -DFILE=${file} -DSUFFIX=${arg_SUFFIX} "-DLABELS=${arg_LABELS}"
            "-DENVIRONMENT=${arg_ENVIRONMENT}" -P ${PROJECT_SOURCE_DIR}/cmake/GoogleTests.cmake VERBATIM)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${program}${arg_SUFFIX}_include.cmake)
  file(WRITE ${include} "if(EXISTS \"${file}\")\n  include(\"${file}\")\nelse()\n  add_test(${program}_NOT_BUILT ${program}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()
if(NOT CMAKE_SCRIPT_MODE_FILE OR NOT DEFINED PROGRAM)
  return()
endif()

# As a script: writes FILE, which ctest includes.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n[A-Za-z0-9_/]+\\." suites "\n${listed}")
if(NOT suites)
  message(FATAL_ERROR "${PROGRAM}: lists no test")
endif()
set(text "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n(.*)\\.$" "\\1" suite "${suite}")
  set(properties "LABELS [==[${LABELS}]==] TIMEOUT 900")
  if(suite MATCHES "Slow(/|$)")
    set(properties "LABELS slow TIMEOUT 1800")
  endif()
  if(ENVIRONMENT)
    string(APPEND properties " ENVIRONMENT [==[${ENVIRONMENT}]==]")
  endif()
  # a filter that fits nothing runs nothing, and ends with 0
  string(APPEND text "add_test([==[${suite}${SUFFIX}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])\n"
                     "set_tests_properties([==[${suite}${SUFFIX}]==] PROPERTIES ${properties} FAIL_REGULAR_EXPRESSION [==[Running 0 tests]==])\n")
endforeach()
file(WRITE ${FILE} "${text}")
