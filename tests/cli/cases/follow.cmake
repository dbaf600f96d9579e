# Logs that are still being written: arguments that are refused before reading; the rest is in tests/cli/follow_test.
set(followed @DATA@/programs/planted_zigzag.nc @LOGS@/planted_zigzag.biip)

clsurf_cli_test(NAME follow_a_closed_log ARGS check ${followed} --follow STDOUT "finding [0-9] .provisional.: Pass 31 runs 24 % slower" "its writer closed it" "confirms 3 of 3 findings")
clsurf_cli_test(NAME follow_quietly ARGS check ${followed} --follow -q --fail-on distinct EXIT 1 NO_STDOUT "finding")
clsurf_cli_test(NAME follow_into_a_file ARGS check ${followed} --follow -o part.sarif STDOUT "finding 3 .provisional" FILE part.sarif)
clsurf_cli_test(NAME follow_as_csv ARGS check ${followed} --follow --format csv EXIT 2 STDERR "as text or JSON" "hint: give the csv report a file with -o")
clsurf_cli_test(NAME follow_two_logs ARGS check ${followed} @LOGS@/planted_zigzag.biip --follow EXIT 2 STDERR "--follow accepts one log")
clsurf_cli_test(NAME follow_timeout_alone ARGS check ${followed} --follow-timeout 3 EXIT 2 STDERR "--follow-timeout needs --follow")
clsurf_cli_test(NAME follow_timeout_below_zero ARGS check ${followed} --follow --follow-timeout -3 EXIT 2 STDERR "--follow-timeout must not be negative")
clsurf_cli_test(NAME follow_program_and_log_on_standard_input ARGS check - - --follow EXIT 2 STDERR "cannot both come from standard input")
clsurf_cli_test(NAME follow_json ARGS check @DATA@/programs/planted_zigzag.nc @LOGS@/edge_300.json --follow EXIT 3 STDERR "written as a whole: it cannot be followed")
clsurf_cli_test(NAME follow_a_packed_log ARGS check @DATA@/programs/planted_zigzag.nc @DATA@/logs/planted_zigzag.biip.xz --follow EXIT 3 STDERR "is compressed: such a log cannot be followed")
clsurf_cli_test(NAME follow_another_program ARGS check @DATA@/programs/planted_loops.nc @LOGS@/planted_zigzag.biip --follow EXIT 3 STDERR "warning: does not belong to .* so far" "error: does not belong")
clsurf_cli_test(NAME follow_with_a_picture_on_standard_output ARGS render ${followed} --follow -o - EXIT 2 STDERR "-o")
clsurf_cli_test(NAME follow_with_a_program_on_standard_input ARGS report - @LOGS@/planted_zigzag.biip --follow -o page.html EXIT 2 STDERR "cannot come from standard input")
clsurf_cli_test(NAME follow_without_a_log ARGS render @DATA@/programs/planted_zigzag.nc --follow -o map.png EXIT 2 STDERR "--follow needs a LOG")
clsurf_cli_test(NAME follow_a_log_that_is_too_short SETUP "head -c 5000 @LOGS@/planted_zigzag.biip > run.biip" ARGS check @DATA@/programs/planted_zigzag.nc run.biip --follow --follow-timeout 0.2 EXIT 5 STDOUT "There were no findings" "NOT JUDGED")

add_test(NAME cli.follow COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/cli/follow_test
  ${PROJECT_BINARY_DIR}/tests/cli/follow $<TARGET_FILE:clsurf> ${PROJECT_SOURCE_DIR}/data ${PROJECT_BINARY_DIR}/samples)
set_tests_properties(cli.follow PROPERTIES TIMEOUT 300)
