# The package in use by another project: installed into an empty folder, found, linked, run.

if(CLSURF_SANITIZE STREQUAL "none")
  set(launcher)
  if(CCACHE_PROGRAM)
    set(launcher -DCMAKE_CXX_COMPILER_LAUNCHER=${CCACHE_PROGRAM})
  endif()
  set(here ${CMAKE_CURRENT_BINARY_DIR}/consumer)
  add_test(NAME consumer.install
    COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${here}/installed)
  add_test(NAME consumer.uses_the_installed_package
    COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${here}/build
      --build-generator ${CMAKE_GENERATOR}
      --build-options -DCMAKE_PREFIX_PATH=${here}/installed -DCMAKE_BUILD_TYPE=Release
                      -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
                      ${launcher}
      --test-command consumer ${PROJECT_SOURCE_DIR}/data/programs/bottle_uneven.nc
                              ${PROJECT_BINARY_DIR}/samples/bottle_uneven.biip)
  add_test(NAME consumer.draws COMMAND ${here}/build/picture ${here}/picture.png)
  set_tests_properties(consumer.install PROPERTIES FIXTURES_SETUP installed_tree)
  set_tests_properties(consumer.uses_the_installed_package PROPERTIES FIXTURES_REQUIRED installed_tree FIXTURES_SETUP consumer_built
    PASS_REGULAR_EXPRESSION "lines [0-9]+ to [0-9]+: [0-9]+ mm/min, adjacent passes [0-9]+ mm/min.*[0-9]+ to [0-9]+ mm/min.*[0-9.]+ s simulated")
  set_tests_properties(consumer.draws PROPERTIES FIXTURES_REQUIRED consumer_built
    PASS_REGULAR_EXPRESSION "text drawn with [1-9][0-9]+ dark values")
endif()
