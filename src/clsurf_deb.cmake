# `cpack -G DEB` in the build folder: packages divided as usual in Debian: clsurf (program, man pages, completion),
# libclsurf-dev (libraries, headers, CMake package), clsurf-doc, and python3-clsurf if the Python package is built. The same
# commit gives the same packages, byte for byte: times are those of the commit (SOURCE_DATE_EPOCH, tests/deb/build).

set(debian_names clsurf libclsurf-dev clsurf-doc)
if(TARGET clsurf_python)
  list(APPEND debian_names python3-clsurf)
  get_target_property(python_versions clsurf_python CLSURF_PYTHON_VERSIONS)
endif()
set(debian_files ${PROJECT_BINARY_DIR}/debian)
file(MAKE_DIRECTORY ${debian_files})

# Copyright: the project's licence, and the licences of the libraries in the page of `report`.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE license)
file(READ ${PROJECT_SOURCE_DIR}/viz/page/dist/NOTICE.md notice)
file(WRITE ${debian_files}/copyright "clsurf, Debian packages made by its own build (src/clsurf_deb.cmake)\n\n${license}\n\n${notice}")
# The time of the changelog is filled in when the packages are made.
file(WRITE ${debian_files}/changelog.in "clsurf (${PROJECT_VERSION}) unstable; urgency=medium\n\n  * See CHANGELOG.md of the sources.\n\n -- the clsurf authors <clsurf@example.org>  @time@\n")

foreach(name ${debian_names})
  install(FILES ${debian_files}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${name} EXCLUDE_FROM_ALL)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/clsurf-doc COMPONENT clsurf-doc)
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/clsurf-doc COMPONENT clsurf-doc)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME clsurf)
set(CPACK_PACKAGE_VENDOR "the clsurf authors")
set(CPACK_PACKAGE_CONTACT "the clsurf authors <clsurf@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL ${debian_names})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/clsurf_deb_files.cmake)
set(CPACK_CLSURF_CHANGELOG ${debian_files}/changelog.in)

set(CPACK_DEBIAN_CLSURF_PACKAGE_NAME clsurf)
set(CPACK_DEBIAN_CLSURF_PACKAGE_SECTION science)
set(CPACK_DEBIAN_CLSURF_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_CLSURF_PACKAGE_SUGGESTS clsurf-doc)
set(CPACK_DEBIAN_CLSURF_DESCRIPTION "clsurf reads an NC program and the interpolation log of its run, compares adjacent finishing passes, and reports which lines and which behaviour of the controller will leave marks on the part.")
set(CPACK_DEBIAN_LIBCLSURF-DEV_PACKAGE_NAME libclsurf-dev)
set(CPACK_DEBIAN_LIBCLSURF-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBCLSURF-DEV_PACKAGE_DEPENDS
  "libeigen3-dev, libtbb-dev, libfmt-dev, libtomlplusplus-dev, zlib1g-dev, libzstd-dev, liblzma-dev, libexpat1-dev, libssl-dev, libsqlite3-dev, libmodbus-dev")
# Programs that draw load the shared libraries of the package clsurf.
set(CPACK_DEBIAN_LIBCLSURF-DEV_PACKAGE_SUGGESTS clsurf)
set(CPACK_DEBIAN_LIBCLSURF-DEV_DESCRIPTION "Static libraries, headers and the CMake package of clsurf, which finds the NC program lines that mark a machined surface.")
# libclsurf_image, which writes pictures, comes from the package clsurf; VTK is linked to this package itself.
set(CPACK_DEBIAN_PYTHON3-CLSURF_PACKAGE_NAME python3-clsurf)
set(CPACK_DEBIAN_PYTHON3-CLSURF_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-CLSURF_PACKAGE_SHLIBDEPS ON)
list(JOIN python_versions "), python3 (<< " python_versions)
set(CPACK_DEBIAN_PYTHON3-CLSURF_PACKAGE_DEPENDS
  "clsurf (= ${PROJECT_VERSION}), python3-numpy, python3 (>= ${python_versions})")
set(CPACK_DEBIAN_PYTHON3-CLSURF_PACKAGE_SUGGESTS "python3-pandas, python3-vtk9")
set(CPACK_DEBIAN_PYTHON3-CLSURF_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/python/prerm)
set(CPACK_DEBIAN_PYTHON3-CLSURF_DESCRIPTION "Python package of clsurf, which finds the NC program lines that mark a machined surface: points as NumPy arrays, defects as a table, maps in notebooks.")
set(CPACK_DEBIAN_CLSURF-DOC_PACKAGE_NAME clsurf-doc)
set(CPACK_DEBIAN_CLSURF-DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_CLSURF-DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_CLSURF-DOC_DESCRIPTION "Tutorial, guide, reference and measurements of clsurf, which finds the NC program lines that mark a machined surface.")
include(CPack)
