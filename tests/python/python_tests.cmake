# The Python package, with pytest: numbers against those of the program, memory, errors, pictures, and the examples of
# docs/python.md.

if(TARGET clsurf_python)
  get_target_property(interpreter clsurf_python CLSURF_INTERPRETER)
  set(pytest ${interpreter} -B -m pytest -q -p no:cacheprovider)
  foreach(file numbers memory errors picture repair)
    add_test(NAME python.${file} COMMAND ${pytest} ${CMAKE_CURRENT_LIST_DIR}/test_${file}.py)
    list(APPEND python_tests python.${file})
  endforeach()
  # The page uses part.nc and run.biip, like a reader.
  set(page ${CMAKE_CURRENT_BINARY_DIR}/python_page)
  file(MAKE_DIRECTORY ${page})
  configure_file(${PROJECT_SOURCE_DIR}/data/programs/bottle_uneven.nc ${page}/part.nc COPYONLY)
  add_test(NAME python.page WORKING_DIRECTORY ${page} COMMAND sh -ec
    "cp '${PROJECT_BINARY_DIR}/samples/bottle_uneven.biip' run.biip; exec '${interpreter}' -B -m pytest -q -p no:cacheprovider --rootdir=. --doctest-glob='*.md' -o doctest_optionflags='NORMALIZE_WHITESPACE ELLIPSIS' '${PROJECT_SOURCE_DIR}/docs/python.md'")
  list(APPEND python_tests python.page)
  # The installed package finds its libraries (consumer/consumer.cmake installs).
  set(installed ${CMAKE_CURRENT_BINARY_DIR}/consumer/installed/${CLSURF_PYTHON_SITE})
  add_test(NAME python.installed COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${installed} ${interpreter} -B -c
    "import sys, clsurf; assert clsurf.__file__.startswith(sys.argv[3]), clsurf.__file__; assert clsurf.Part(*sys.argv[1:3]).picture(size=(320, 240)).png"
    ${PROJECT_SOURCE_DIR}/data/programs/bottle_uneven.nc ${PROJECT_BINARY_DIR}/samples/bottle_uneven.biip ${installed})
  set_tests_properties(python.installed PROPERTIES LABELS python FIXTURES_REQUIRED installed_tree)
  # The wheel, made like the target clsurf_wheel.
  add_test(NAME python.wheel COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/wheel_test ${CMAKE_CURRENT_BINARY_DIR}/python_wheel ${interpreter}
    ${CMAKE_COMMAND} ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR} ${PROJECT_VERSION})
  set_tests_properties(python.wheel PROPERTIES LABELS python TIMEOUT 600)
  # The notebook, cell by cell: the shown results are the computed ones.
  list(APPEND python_tests python.notebook)
  add_test(NAME python.notebook COMMAND ${interpreter} -B ${CMAKE_CURRENT_LIST_DIR}/run_notebook.py check ${PROJECT_SOURCE_DIR}/docs/notebook/bottle.ipynb)
  set_tests_properties(${python_tests} PROPERTIES LABELS python TIMEOUT 600 ENVIRONMENT
    "PYTHONPATH=${PROJECT_BINARY_DIR}/python;CLSURF=$<TARGET_FILE:clsurf>;CLSURF_DATA=${PROJECT_SOURCE_DIR}/data;CLSURF_SAMPLES=${PROJECT_BINARY_DIR}/samples")
endif()
