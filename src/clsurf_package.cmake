# Installs the package config next to the libraries, so that another project can use
# find_package(clsurf COMPONENTS toolpath surface) and link clsurf::toolpath.

include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/clsurf)

get_property(CLSURF_ROOMS GLOBAL PROPERTY CLSURF_ROOMS)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/clsurf-config.cmake.in
  ${PROJECT_BINARY_DIR}/clsurf-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/clsurf-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/clsurf-config.cmake
              ${PROJECT_BINARY_DIR}/clsurf-config-version.cmake DESTINATION ${package_folder})
install(EXPORT clsurf_rooms NAMESPACE clsurf:: DESTINATION ${package_folder})

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/clsurf)
install(FILES ${PROJECT_SOURCE_DIR}/viz/page/dist/NOTICE.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/clsurf)
