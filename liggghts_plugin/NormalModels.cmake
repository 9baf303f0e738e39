# granulaw_plugin_options(TARGET): how code is compiled that meets LIGGGHTS's templates.
function(granulaw_plugin_options target)
  granulaw_target(${target})
  # Else the plug-in's copies of LIGGGHTS's inline templates would replace the stock ones in the whole process.
  set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  # LIGGGHTS's templates, instantiated here, shadow members and leave parameters unused; inlined into one loop they
  # look uninitialized where they write what they read only for pairs.
  target_compile_options(${target} PRIVATE -Wno-shadow -Wno-unused-parameter -Wno-maybe-uninitialized
    # Else gcc 12 pairs the components of vectors that were just stored one by one: each such load waits for the stores,
    # and the loop over contacts takes a quarter longer.
    -fno-tree-slp-vectorize)
  target_link_libraries(${target} PRIVATE granulaw_plugin_core liggghts_headers fmt::fmt ${CMAKE_DL_LIBS})
endfunction()

# granulaw_plugin_of_models(TARGET LIST PREFIX): a plug-in with the normal models of LIST (models.list says how it is
# written). PREFIX: of their headers in an #include; their .cpp files stand beside LIST.
function(granulaw_plugin_of_models target list prefix)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
  get_filename_component(folder ${list} DIRECTORY)
  add_library(${target} SHARED $<TARGET_OBJECTS:granulaw_plugin_parts> ${PROJECT_SOURCE_DIR}/liggghts_plugin/loop/registration.cpp)
  granulaw_plugin_options(${target})
  granulaw_grouped(${target})
  target_link_options(${target} PRIVATE -Wl,--exclude-libs,ALL)
  file(STRINGS ${list} lines REGEX "^[^#]")
  foreach(line ${lines})
    string(REGEX MATCH "^([a-z0-9_]+) +([A-Za-z0-9_]+)$" matched "${line}")
    if(NOT matched)
      message(FATAL_ERROR "${list}: '${line}' is no 'NAME CLASS'")
    endif()
    set(name ${CMAKE_MATCH_1})
    set(class ${CMAKE_MATCH_2})
    set(header ${prefix}${name}_physics.hpp)
    set(registers ${CMAKE_CURRENT_BINARY_DIR}/generated/register_${name}.cpp)
    configure_file(${PROJECT_SOURCE_DIR}/liggghts_plugin/loop/register_model.cpp.in ${registers} @ONLY)
    target_sources(${target} PRIVATE ${folder}/${name}_physics.cpp ${registers})
    set_source_files_properties(${registers} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)  # a loop over contacts each
  endforeach()
endfunction()
