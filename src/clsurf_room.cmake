# clsurf_room(NAME NEEDS rooms… SOURCES … HEADERS … [LIBRARIES …]): a room of the project, as the
# library clsurf::NAME. Sources are listed, never globbed; a room may include only what it NEEDS
# (tests/architecture reads the includes).

add_library(clsurf_build_options INTERFACE)
target_compile_features(clsurf_build_options INTERFACE cxx_std_20)
# No FMA contraction: the same numbers whatever the compiler makes of an expression.
# -Wno-restrict: GCC 12 warns falsely of std::string operator+ (GCC bug 105651).
target_compile_options(clsurf_build_options INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic
  -Wshadow -Wnon-virtual-dtor -Wno-restrict $<$<BOOL:${CLSURF_STRICT}>:-Werror>)
if(CLSURF_SANITIZE STREQUAL "address")
  target_compile_options(clsurf_build_options INTERFACE -fsanitize=address,undefined
    -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(clsurf_build_options INTERFACE -fsanitize=address,undefined)
elseif(CLSURF_SANITIZE STREQUAL "thread")
  target_compile_options(clsurf_build_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(clsurf_build_options INTERFACE -fsanitize=thread)
endif()

function(clsurf_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "" "" "NEEDS;SOURCES;HEADERS;LIBRARIES")
  add_library(clsurf_${name} ${ROOM_SOURCES})
  add_library(clsurf::${name} ALIAS clsurf_${name})
  get_filename_component(base ${CMAKE_CURRENT_SOURCE_DIR} DIRECTORY)
  target_sources(clsurf_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${base} FILES ${ROOM_HEADERS})
  target_include_directories(clsurf_${name} PUBLIC $<BUILD_INTERFACE:${base}>)
  target_link_libraries(clsurf_${name} PRIVATE $<BUILD_INTERFACE:clsurf_build_options>)
  foreach(need ${ROOM_NEEDS})
    target_link_libraries(clsurf_${name} PUBLIC clsurf_${need})
  endforeach()
  target_link_libraries(clsurf_${name} ${ROOM_LIBRARIES})
  set_property(TARGET clsurf_${name} PROPERTY EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY CLSURF_ROOMS clsurf_${name})
endfunction()
