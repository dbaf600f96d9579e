# Every header compiles by itself: a source per header that includes nothing else, twice (for the
# guard); and all headers compile together. Built by the test of that name.
#
# A header with a source of its own has no other source here: its own begins with it (architecture_test), and
# tests/sanitize compiles that by itself. src/python is not part of that build.
#
# What the large libraries' headers cost is most of it. Those that reach core/geometry.h (Eigen) or
# cli/options.h (Boost.Program_options) share a precompiled one: it stands before all that they say in any case.
set(shared_options src/cli/options.h)
set(shared_geometry src/core/geometry.h)
file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
  ${PROJECT_SOURCE_DIR}/src/*.h ${PROJECT_SOURCE_DIR}/io/*.h ${PROJECT_SOURCE_DIR}/viz/*.h)

# Sets `result` to whether a header includes `base` through any number of others.
function(clsurf_reaches header base result)
  get_property(known GLOBAL PROPERTY clsurf_reaches_${base}_${header})
  if("${known}" STREQUAL "")
    set(known FALSE)
    file(STRINGS ${PROJECT_SOURCE_DIR}/${header} lines REGEX "^#include \"")
    foreach(line ${lines})
      string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" included "${line}")
      if(EXISTS ${PROJECT_SOURCE_DIR}/src/${included})
        set(included src/${included})
      elseif(NOT EXISTS ${PROJECT_SOURCE_DIR}/${included})
        continue()  # made by the build
      endif()
      set(through TRUE)
      if(NOT included STREQUAL base)
        clsurf_reaches(${included} ${base} through)
      endif()
      if(through)
        set(known TRUE)
        break()
      endif()
    endforeach()
    set_property(GLOBAL PROPERTY clsurf_reaches_${base}_${header} ${known})
  endif()
  set(${result} ${known} PARENT_SCOPE)
endfunction()

if(TARGET clsurf_python)
  get_target_property(python_headers clsurf_python CLSURF_PYTHON_HEADERS)
else()
  list(FILTER headers EXCLUDE REGEX "^src/python/")
endif()

foreach(header ${headers})
  string(REGEX REPLACE "[.]h$" ".cpp" own_source ${header})
  if(EXISTS ${PROJECT_SOURCE_DIR}/${own_source} AND NOT header MATCHES "^src/python/")
    continue()
  endif()
  string(REGEX REPLACE "^src/" "" include ${header})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/headers_alone/${header}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "#include \"@include@\"\n#include \"@include@\"  // NOLINT\n" @ONLY)
  set(kind other)
  foreach(shared options geometry)
    clsurf_reaches(${header} ${shared_${shared}} reaches)
    if(reaches)
      set(kind ${shared})
      break()
    endif()
  endforeach()
  list(APPEND ${kind}_sources ${source})
endforeach()

# All headers in one source: a type that two of them define is an error here. Everywhere else it would be undefined
# behaviour without a message.
set(together ${CMAKE_CURRENT_BINARY_DIR}/headers_alone/all_headers.cpp)
string(REGEX REPLACE "(^|;)src/" "\\1" all_includes "${headers}")
list(TRANSFORM all_includes REPLACE "(.+)" "#include \"\\1\"\n")
list(JOIN all_includes "" all_includes)
file(CONFIGURE OUTPUT ${together} CONTENT "@all_includes@" @ONLY)
list(APPEND options_sources ${together})

add_custom_target(clsurf_headers_alone)
foreach(kind options geometry other)
  set(target clsurf_headers_alone_${kind})
  add_library(${target} OBJECT EXCLUDE_FROM_ALL ${${kind}_sources})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${target} PRIVATE clsurf_cli tomlplusplus::tomlplusplus ${VTK_LIBRARIES})
  target_include_directories(${target} SYSTEM PRIVATE ${python_headers})
  if(shared_${kind})
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/${shared_${kind}})
  endif()
  add_dependencies(clsurf_headers_alone ${target})
endforeach()
add_test(NAME headers_alone COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target clsurf_headers_alone)
set_tests_properties(headers_alone PROPERTIES RUN_SERIAL ON TIMEOUT 900)
