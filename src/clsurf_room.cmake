# clsurf_room(NAME NEEDS rooms… SOURCES … HEADERS … [LIBRARIES …]): a room of the project, as the
# library clsurf::NAME. Sources are listed, never globbed; a room may include only what it NEEDS
# (tests/architecture reads the includes, preset `rooms` links without undefined symbols). The allowed includes are
# written to arrows.txt in the build folder, which is the only table of them.

add_library(clsurf_build_options INTERFACE)
target_compile_features(clsurf_build_options INTERFACE cxx_std_20)
# No FMA contraction, so that results do not depend on the compiler's choice.
# -Wno-restrict: false warnings of GCC 12 about std::string operator+ (GCC bug 105651).
target_compile_options(clsurf_build_options INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic
  -Wshadow -Wnon-virtual-dtor $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${CLSURF_STRICT}>:-Werror>)
if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
  # The first is for ccache; the others are further false warnings of the same bug, which precompiled headers expose.
  target_compile_options(clsurf_build_options INTERFACE
    "$<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess;-Wno-stringop-overflow;-Wno-array-bounds>")
endif()
if(CLSURF_SANITIZE STREQUAL "address")
  target_compile_options(clsurf_build_options INTERFACE -fsanitize=address,undefined
    -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(clsurf_build_options INTERFACE -fsanitize=address,undefined)
elseif(CLSURF_SANITIZE STREQUAL "thread")
  target_compile_options(clsurf_build_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(clsurf_build_options INTERFACE -fsanitize=thread)
endif()
if(CLSURF_LTO)
  # The linker then sees every type: two different types of the same name are an error. `-O1` limits the work at link time.
  target_compile_options(clsurf_build_options INTERFACE -flto=auto)
  target_link_options(clsurf_build_options INTERFACE -flto=auto -O1 -Werror=odr -Werror=lto-type-mismatch)
endif()
if(NOT CLSURF_SANITIZE STREQUAL "none")
  # In instrumented code GCC does not see that an optional is checked before it is read.
  target_compile_options(clsurf_build_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()

if(CLSURF_FUZZ)
  # Coverage instrumentation for every room; tests/fuzz adds the driver to its targets only.
  target_compile_options(clsurf_build_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# clsurf_arrows(NAME rooms…): the rooms that NAME may include.
function(clsurf_arrows name)
  list(JOIN ARGN " " needs)
  set_property(GLOBAL APPEND_STRING PROPERTY CLSURF_ARROWS "${name}: ${needs}\n")
endfunction()

# clsurf_listed_sources(VARIABLE LIST): the sources that the rows KIND(name, sources) of a list (.def) name, which are in its
# folder. C++ includes the same list.
function(clsurf_listed_sources variable list)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${list})
  file(STRINGS ${list} rows REGEX "^[A-Z_]+\\(")
  list(TRANSFORM rows REPLACE "^.*, (.*)\\)$" "\\1")
  string(REGEX MATCHALL "[^ ;]+" sources "${rows}")
  list(REMOVE_DUPLICATES sources)
  get_filename_component(folder ${list} DIRECTORY)
  list(TRANSFORM sources PREPEND ${folder}/)
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

function(clsurf_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "" "" "NEEDS;SOURCES;HEADERS;LIBRARIES")
  get_filename_component(base ${CMAKE_CURRENT_SOURCE_DIR} DIRECTORY)
  add_library(clsurf_${name} ${ROOM_SOURCES})
  add_library(clsurf::${name} ALIAS clsurf_${name})
  target_sources(clsurf_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${base} FILES ${ROOM_HEADERS})
  target_compile_features(clsurf_${name} PUBLIC cxx_std_20)
  clsurf_arrows(${name} ${ROOM_NEEDS})
  # Rooms include each other as "room/header.h", users include <clsurf/room/header.h>.
  target_include_directories(clsurf_${name} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM ROOM_NEEDS PREPEND clsurf_)
  # A static room can become part of a shared object (the Python module, or another project's plug-in). Its functions are
  # never interposed, so calls inside a file can be direct and inlined.
  set_target_properties(clsurf_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(clsurf_${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
  target_link_libraries(clsurf_${name} PRIVATE $<BUILD_INTERFACE:clsurf_build_options>)
  target_link_libraries(clsurf_${name} PUBLIC ${ROOM_NEEDS})
  target_link_libraries(clsurf_${name} ${ROOM_LIBRARIES})
  if(name STREQUAL "core")
    clsurf_precompiled(clsurf_core)
  else()
    clsurf_precompiled(clsurf_${name} FROM clsurf_core)
  endif()
  set_target_properties(clsurf_${name} PROPERTIES EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

  set_property(GLOBAL APPEND PROPERTY CLSURF_ROOMS ${name})

  install(TARGETS clsurf_${name} EXPORT clsurf_rooms
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/clsurf)
endfunction()
