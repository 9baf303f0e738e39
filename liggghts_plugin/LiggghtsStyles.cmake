# liggghts_style_headers(INCLUDE_DIR OUTPUT_DIR): the style_<kind>_model.h headers that LIGGGHTS's own build
# generates and Debian does not ship: one include for each installed <kind>_model_<name>.h but the base.
function(liggghts_style_headers include_dir output_dir)
  foreach(kind normal tangential cohesion rolling surface)
    file(GLOB headers RELATIVE ${include_dir} ${include_dir}/${kind}_model_*.h)
    list(FILTER headers EXCLUDE REGEX "_base\\.h$")
    list(SORT headers)
    if(NOT headers)
      message(FATAL_ERROR "no ${kind}_model_*.h in ${include_dir}: is this LIGGGHTS 3.8.0?")
    endif()
    set(text "")
    foreach(header ${headers})
      string(APPEND text "#include \"${header}\"\n")
    endforeach()
    file(CONFIGURE OUTPUT ${output_dir}/style_${kind}_model.h CONTENT "${text}" @ONLY)
  endforeach()
  file(CONFIGURE OUTPUT ${output_dir}/style_contact_model.h CONTENT "" @ONLY)
endfunction()

# liggghts_find(ROOT): sets LIGGGHTS_INCLUDE_DIR, LIGGGHTS_LIBRARY and LIGGGHTS_FLAGS from a source tree or install
# prefix, or from the system where ROOT is empty.
macro(liggghts_find root)
  set(LIGGGHTS_FLAGS "")
  if("${root}" STREQUAL "")
    find_path(LIGGGHTS_INCLUDE_DIR contact_models.h PATH_SUFFIXES liggghts DOC "LIGGGHTS headers (libliggghts-dev)")
    find_library(LIGGGHTS_LIBRARY liggghts DOC "LIGGGHTS library (libliggghts-dev)")
    if(NOT LIGGGHTS_INCLUDE_DIR OR NOT LIGGGHTS_LIBRARY)
      message(FATAL_ERROR "LIGGGHTS was not found: install libliggghts-dev, name your own build with "
                          "-DGRANULAW_LIGGGHTS_ROOT=PATH, or configure with -DGRANULAW_BUILD_PLUGIN=OFF")
    endif()
  else()
    find_path(liggghts_own_headers contact_models.h PATHS ${root}
              PATH_SUFFIXES src include/liggghts include . NO_DEFAULT_PATH NO_CACHE)
    # The names: LIGGGHTS's own CMake and its make -f Makefile.shlib; the folders: prefix, src, a build beside it.
    find_library(liggghts_own_library NAMES liggghts PATHS ${root} ${root}/src ${root}/build ${root}/src/build
                 PATH_SUFFIXES lib lib64 lib/${CMAKE_LIBRARY_ARCHITECTURE} . NO_DEFAULT_PATH NO_CACHE)
    if(NOT liggghts_own_headers)
      message(FATAL_ERROR "GRANULAW_LIGGGHTS_ROOT: no contact_models.h in ${root}, its src, include or include/liggghts")
    endif()
    if(NOT liggghts_own_library)
      message(FATAL_ERROR "GRANULAW_LIGGGHTS_ROOT: no libliggghts.so in ${root}, its src, build or lib: build the shared "
                          "library (docs/guide/own-liggghts.md), or put the models into LIGGGHTS's src")
    endif()
    file(REAL_PATH ${liggghts_own_headers} LIGGGHTS_INCLUDE_DIR)
    file(REAL_PATH ${liggghts_own_library} LIGGGHTS_LIBRARY)
    liggghts_check_layout(${LIGGGHTS_INCLUDE_DIR} ${LIGGGHTS_LIBRARY})
  endif()
endmacro()

# The library itself says how its structures are laid out: by the symbols that it has. One sentence each for what is
# refused; the flags that superquadrics need go to LIGGGHTS_FLAGS.
function(liggghts_check_layout headers library)
  set(versions ${headers}/version_liggghts.txt)
  if(EXISTS ${versions})
    file(STRINGS ${versions} version LIMIT_COUNT 1)
    if(NOT version MATCHES "^ *3\\.8\\.0")
      message(FATAL_ERROR "${headers} is LIGGGHTS ${version}: the plug-in is written for 3.8.0")
    endif()
  endif()
  execute_process(COMMAND ${CMAKE_NM} -D --defined-only ${library} OUTPUT_VARIABLE symbols RESULT_VARIABLE failed ERROR_VARIABLE why)
  if(failed)
    message(FATAL_ERROR "${library} cannot be read as a shared library: ${why}")
  endif()
  set(shapes "spheres only")
  if(symbols MATCHES "_ZTVN9LAMMPS_NS19AtomVecSuperquadricE")
    set(shapes "superquadrics")
    set(LIGGGHTS_FLAGS SUPERQUADRIC_ACTIVE_FLAG NONSPHERICAL_ACTIVE_FLAG PARENT_SCOPE)
  endif()
  if(symbols MATCHES "AtomVecConvexHullC")
    message(FATAL_ERROR "${library} was built with convex particles: build it without CONVEX_ACTIVE_FLAG")
  endif()
  # Domain::remap(double*, tagint&) and Update::reset_timestep(bigint) carry the widths in their names.
  if(NOT symbols MATCHES "_ZN9LAMMPS_NS6Domain5remapEPdRi" OR NOT symbols MATCHES "_ZN9LAMMPS_NS6Update14reset_timestepEl")
    message(FATAL_ERROR "${library} was not built with LAMMPS_SMALLBIG, LIGGGHTS's default (32-bit ids, 64-bit steps): rebuild it")
  endif()
  message(STATUS "LIGGGHTS: headers ${headers}, library ${library} (${shapes}, SMALLBIG)")
endfunction()

# liggghts_link_headers(INCLUDE_DIR OUTPUT_DIR): links to every header but the style lists of the tree's own build.
# A quoted include looks first beside its includer: were the headers read in place, a tree configured for few models
# would hide the others from the plug-in.
function(liggghts_link_headers include_dir output_dir)
  file(GLOB headers RELATIVE ${include_dir} CONFIGURE_DEPENDS ${include_dir}/*.h)
  file(MAKE_DIRECTORY ${output_dir})
  list(FILTER headers EXCLUDE REGEX "^style_(normal|tangential|cohesion|rolling|surface|contact)_model\\.h$")
  foreach(header ${headers})
    file(CREATE_LINK ${include_dir}/${header} ${output_dir}/${header} SYMBOLIC)
  endforeach()
endfunction()
