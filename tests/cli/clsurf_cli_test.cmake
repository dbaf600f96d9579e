# clsurf_cli_test(NAME name ARGS word… [EXIT code] [STDOUT regex…] [NO_STDOUT regex…] [STDERR regex…]
#                 [FILE name…] [NO_FILE path…] [SAME name…] [SETUP shell commands]):
# runs the built program in a new empty folder and checks the exit code (0), that every
# regex (extended, over all lines) is found and no NO_STDOUT, that the FILEs exist and are not empty,
# that the NO_FILEs do not exist, and that all files of SAME are equal byte for byte. A run that fails (exit code 2 to 4) must
# leave no new file except FILEs, and change none.
#
# In ARGS and SETUP, @DATA@ is the folder data of the project, @LOGS@ the folder of the unpacked logs.
# SETUP may use $CLSURF, the program.
#
# Tests with the same command line (SETUP, ARGS and EXIT) run it once: the first test does, the others check its
# results. AFTER test: this test runs after that one, whose folder is @AFTER@ in ARGS and SETUP.
function(clsurf_cli_test)
  cmake_parse_arguments(PARSE_ARGV 0 TEST "" "NAME;EXIT;SETUP;AFTER" "ARGS;STDOUT;NO_STDOUT;STDERR;FILE;NO_FILE;SAME")
  if(TEST_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "clsurf_cli_test ${TEST_NAME}: what is ${TEST_UNPARSED_ARGUMENTS}?")
  endif()
  if(NOT DEFINED TEST_EXIT)
    set(TEST_EXIT 0)
  endif()
  set(DATA ${PROJECT_SOURCE_DIR}/data)
  set(LOGS ${PROJECT_BINARY_DIR}/samples)
  set(fixtures "")
  if(TEST_AFTER)
    set(fixtures cli.${TEST_AFTER})
    set_property(TEST cli.${TEST_AFTER} PROPERTY FIXTURES_SETUP cli.${TEST_AFTER})
    set(AFTER ${PROJECT_BINARY_DIR}/tests/cli/${TEST_AFTER}/work)
  endif()
  string(CONFIGURE "${TEST_ARGS}" TEST_ARGS @ONLY)
  string(CONFIGURE "${TEST_SETUP}" TEST_SETUP @ONLY)

  set(folder ${TEST_NAME})
  set(words --exit ${TEST_EXIT})
  string(SHA256 command_line "${TEST_EXIT} ${TEST_SETUP} -- ${TEST_ARGS}")
  get_property(first GLOBAL PROPERTY clsurf_cli_${command_line})
  if(first)
    list(APPEND fixtures cli.${first})
    set_property(TEST cli.${first} PROPERTY FIXTURES_SETUP cli.${first})
    set(folder ${first})
    list(APPEND words --left yes)
  else()
    set_property(GLOBAL PROPERTY clsurf_cli_${command_line} ${TEST_NAME})
  endif()
  if(TEST_SETUP)
    string(REPLACE ";" "\\;" TEST_SETUP "${TEST_SETUP}")
    list(APPEND words --setup "${TEST_SETUP}")
  endif()
  foreach(check STDOUT NO_STDOUT STDERR FILE NO_FILE SAME)
    string(TOLOWER ${check} option)
    foreach(value IN LISTS TEST_${check})
      list(APPEND words --${option} ${value})
    endforeach()
  endforeach()
  add_test(NAME cli.${TEST_NAME}
    COMMAND bash ${PROJECT_SOURCE_DIR}/tests/cli/run_cli_test
      ${PROJECT_BINARY_DIR}/tests/cli/${folder} $<TARGET_FILE:clsurf> ${words} -- ${TEST_ARGS})
  set_tests_properties(cli.${TEST_NAME} PROPERTIES TIMEOUT 120)
  if(fixtures)
    set_tests_properties(cli.${TEST_NAME} PROPERTIES FIXTURES_REQUIRED "${fixtures}")
  endif()
endfunction()
