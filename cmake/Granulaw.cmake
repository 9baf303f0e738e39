# granulaw_target(NAME): the house's compile options for one target, and nothing global.
function(granulaw_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${name} SYSTEM PRIVATE ${Boost_INCLUDE_DIRS})  # where they are not the compiler's own
  # Nobody reads errno: with it a square root is a call.
  target_compile_options(${name} PRIVATE -fno-math-errno -Wall -Wextra -Wshadow -Wno-unknown-pragmas)
  if(GRANULAW_SANITIZE)
    target_compile_options(${name} PUBLIC -fsanitize=address,undefined -fno-omit-frame-pointer)
    target_link_options(${name} PUBLIC -fsanitize=address,undefined)
  endif()
endfunction()

# Sources of a library or program are compiled in groups: a third of the compiler's time, or less. No two files of a group may give one name to two things.
option(GRANULAW_UNITY "Compile the sources in groups" ON)
function(granulaw_grouped)
  foreach(target IN LISTS ARGN)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${GRANULAW_UNITY} UNITY_BUILD_BATCH_SIZE 16)
  endforeach()
endfunction()

# A program of tests: its own files are compiled in groups and lightly optimised, since most of their time is the compiler's. The names of a
# test file lie in a namespace of the file's name, so that they do not meet.
function(granulaw_test_target name)
  granulaw_target(${name})
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${GRANULAW_UNITY} UNITY_BUILD_BATCH_SIZE 12)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  if(CMAKE_BUILD_TYPE STREQUAL Release)
    target_compile_options(${name} PRIVATE -O1)
  endif()
endfunction()

# The commit that is compiled in and written into every output file.
find_package(Git QUIET)
set(GRANULAW_GIT_HASH "unknown")
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12
                  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                  OUTPUT_VARIABLE GRANULAW_GIT_HASH OUTPUT_STRIP_TRAILING_WHITESPACE
                  ERROR_QUIET RESULT_VARIABLE granulaw_git_result)
  if(NOT granulaw_git_result EQUAL 0)
    set(GRANULAW_GIT_HASH "unknown")
  endif()
  # A commit makes the next build configure again.
  if(EXISTS ${PROJECT_SOURCE_DIR}/.git/logs/HEAD)
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/.git/logs/HEAD)
  endif()
endif()
