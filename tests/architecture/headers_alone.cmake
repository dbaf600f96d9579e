# Every header compiles by itself: a source per header that includes nothing else, twice (for the
# guard). Built by the test of that name, since it takes as long as half of the program.
file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
  ${PROJECT_SOURCE_DIR}/src/*.h ${PROJECT_SOURCE_DIR}/io/*.h ${PROJECT_SOURCE_DIR}/viz/*.h)
foreach(header ${headers})
  string(REGEX REPLACE "^src/" "" include ${header})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/headers_alone/${header}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "#include \"@include@\"\n#include \"@include@\"  // NOLINT\n" @ONLY)
  list(APPEND header_sources ${source})
endforeach()
add_library(clsurf_headers_alone OBJECT EXCLUDE_FROM_ALL ${header_sources})
target_include_directories(clsurf_headers_alone PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(clsurf_headers_alone PRIVATE clsurf_cli tomlplusplus::tomlplusplus ${VTK_LIBRARIES})
add_test(NAME headers_alone COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target clsurf_headers_alone)
set_tests_properties(headers_alone PROPERTIES RUN_SERIAL ON TIMEOUT 900)
