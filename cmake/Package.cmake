# cmake --build --preset release --target package: granulaw_VERSION_ARCH.deb for those who run it, and
# granulaw-dev_VERSION_ARCH.deb with the libraries and headers for those who program with it.
set(GRANULAW_PACKAGE OFF)
if(NOT TARGET liggghts-mpm OR NOT GRANULAW_LIGGGHTS_ROOT STREQUAL "")
  message(STATUS "No target `package`: it needs the plug-in for Debian's own LIGGGHTS")
  return()
endif()
set(GRANULAW_PACKAGE ON)
include(${CMAKE_CURRENT_LIST_DIR}/Maintainer.cmake)
set(GRANULAW_MAINTAINER "${maintainer_of_citation}" CACHE STRING "Of the Debian packages: NAME <ADDRESS>")
# The plug-in is compiled from LIGGGHTS's headers and refuses every other version (liggghts_plugin/run/checks.cpp).
set(liggghts_range "liggghts (>= 3.8.0), liggghts (<< 3.8.1~)")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME granulaw)
set(CPACK_PACKAGE_VENDOR "Granulaw")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL runtime development)
if(TARGET granulaw_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${GRANULAW_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
file(STRINGS ${PROJECT_SOURCE_DIR}/CITATION.cff citation_url REGEX "^(url|repository-code): ")
if(citation_url MATCHES "^[a-z-]+: *\"?([^\"; ]+)")
  set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${CMAKE_MATCH_1}")
endif()

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME granulaw)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "\
The material point method computes how two solid particles press against each
other and part: elastic, yielding, layered, rate-dependent. The tool mpm makes
a contact law with a stated error from the data of a material. The launcher
liggghts-mpm runs LIGGGHTS with that law as a normal model of pair_style gran
and fix wall/gran.

The package also holds the atlas, which answers most homogeneous materials at
once, and example decks in /usr/share/granulaw/examples.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "${liggghts_range}, python3")
# mpm plot draws with them, and the examples' run.py.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "python3-h5py, python3-matplotlib, python3-numpy")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "granulaw-dev, liggghts-doc, paraview")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/tools/package/prerm ${PROJECT_SOURCE_DIR}/tools/package/triggers)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME granulaw-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "\
C++ libraries and headers. find_package(granulaw) gives granulaw::law, which
evaluates, reads and writes contact laws, granulaw::shape, bodies of any shape,
granulaw::solver, the material point method, and granulaw::characterise, which
makes laws from runs.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "granulaw (= ${PROJECT_VERSION}), libfmt-dev, libeigen3-dev, libhdf5-dev, libtomlplusplus-dev")
# One module for one minor version of Python, as Debian's own packages.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-granulaw)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "\
Contact laws in Python: import granulaw makes, reads and asks laws, runs the
solver, fits materials to measurements and advances contacts on NumPy arrays.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
include(CPack)
