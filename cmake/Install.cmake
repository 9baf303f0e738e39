# cmake --install puts libraries, headers, tools and a package file that find_package(granulaw) reads.
include(CMakePackageConfigHelpers)
install(EXPORT granulawTargets NAMESPACE granulaw::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/granulaw)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/granulawConfig.cmake.in
  ${PROJECT_BINARY_DIR}/granulawConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/granulaw
  PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/granulawConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/granulawConfig.cmake
              ${PROJECT_BINARY_DIR}/granulawConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/granulaw)
