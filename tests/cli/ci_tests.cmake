# Use in CI: exit codes by severity and depth, several logs, one shape of JSON.
clsurf_cli_test(NAME ci_fail_on ARGS check ${part} ${run} --tool none --fail-on 2 -q EXIT 1 NO_STDOUT ".")
clsurf_cli_test(NAME ci_fail_on_a_word ARGS check ${part} ${run} --tool none --fail-on visible EXIT 1 STDOUT "max_severity +[234] of 1 +NOT KEPT")
clsurf_cli_test(NAME ci_fail_on_what_is_not_there ARGS check @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip --fail-on reject STDOUT "max_severity +[0-3] of 3 +kept")
clsurf_cli_test(NAME ci_fail_on_an_unknown_word ARGS check ${part} ${run} --fail-on bad EXIT 2 STDERR "--fail-on: 'bad' is not one of trace, visible, distinct, reject, 1, 2, 3, 4")
clsurf_cli_test(NAME ci_max_depth ARGS check ${part} ${run} --tool none --max-depth 5um EXIT 1 STDOUT "max_depth_um +[0-9.]+ of 5 +NOT KEPT")
clsurf_cli_test(NAME ci_max_depth_in_mm ARGS check ${part} ${run} --tool none --max-depth 0.5mm STDOUT "max_depth_um +[0-9.]+ of 500 +kept")
clsurf_cli_test(NAME ci_max_depth_before_the_budget SETUP "echo 'max_depth_um = 1000' > part.toml" ARGS check ${part} ${run} --tool none --budget part.toml --max-depth 5µm EXIT 1 STDOUT " of 5 +NOT KEPT")
foreach(length 5 5in um -5um)
  clsurf_cli_test(NAME ci_max_depth_of_${length} ARGS check ${part} ${run} --max-depth=${length} EXIT 2 STDERR "--max-depth: '${length}' is not a length with its unit, such as 5um or 0.005mm")
endforeach()
set(two_logs "cp @LOGS@/planted_loops.biip a.biip; cp a.biip b.biip")
set(planted @DATA@/programs/planted_loops.nc)
clsurf_cli_test(NAME ci_several_logs SETUP "${two_logs}" ARGS check ${planted} a.biip b.biip STDOUT "^a.biip:.*3 defects.*b.biip:.*3 defects")
clsurf_cli_test(NAME ci_several_logs_json SETUP "${two_logs}; $CLSURF check ${planted} a.biip b.biip -o two.json; $CLSURF check ${planted} a.biip -o one.json; python3 -c \"import json; one = json.load(open('one.json')); two = json.load(open('two.json')); assert len(two['logs']) == 2 and two['logs'][0]['defects'] == one['logs'][0]['defects'] == one['defects'] and set(two) == {'schema_version', 'logs'} and two['schema_version'] == 2\""
  ARGS check ${planted} a.biip b.biip --fail-on 4 STDOUT "kept")
clsurf_cli_test(NAME ci_several_logs_csv SETUP "${two_logs}" ARGS check ${planted} a.biip b.biip --format csv STDOUT "^log,.*a.biip,.*b.biip," NO_STDOUT "log,.*log,")
clsurf_cli_test(NAME ci_several_logs_sarif SETUP "${two_logs}; $CLSURF check ${planted} a.biip b.biip -o two.sarif; python3 -c \"import json; runs = json.load(open('two.sarif'))['runs']; assert len(runs) == 2 and len(runs[0]['results']) == len(runs[1]['results']) > 0 and runs[0]['automationDetails'] != runs[1]['automationDetails']\""
  ARGS check ${planted} a.biip -o one.sarif FILE one.sarif)
# A step in the second log only.
clsurf_cli_test(NAME ci_worst_of_several_logs SETUP "cp ${run} b.biip; head -c 100000 b.biip > a.biip" ARGS check ${part} a.biip b.biip --tool none --max-depth 5um -q EXIT 5 NO_STDOUT ".")
# A log that cannot be used is also a result.
clsurf_cli_test(NAME ci_one_of_several_logs_missing SETUP "${two_logs}" ARGS check ${planted} nowhere.biip a.biip EXIT 3 STDERR "nowhere.biip: error: cannot open" STDOUT "^nowhere.biip:\nERROR: nowhere.biip: cannot open: [^\n]*\n\na.biip:.*3 defects")
clsurf_cli_test(NAME ci_one_of_several_logs_foreign SETUP "${two_logs}" ARGS check ${planted} a.biip @LOGS@/bottle_uneven.biip -o report.xml EXIT 3 STDERR "bottle_uneven.biip: error: does not belong to" FILE report.xml)
foreach(form json csv sarif junit)
  clsurf_cli_test(NAME ci_one_of_several_logs_unusable_${form} SETUP "${two_logs}; echo no log > b.biip; $CLSURF check ${planted} b.biip a.biip --format ${form} > report || test $? -eq 3; python3 @DATA@/../tests/cli/read_unusable.py ${form} report" ARGS check ${planted} b.biip a.biip --max-depth 1um --format ${form} EXIT 3 STDERR "b.biip: error: is not a log")
endforeach()
clsurf_cli_test(NAME ci_program_of_several_logs_missing SETUP "${two_logs}" ARGS check nowhere.nc a.biip b.biip -o report.json EXIT 3 STDERR "^nowhere.nc: error: cannot open" NO_FILE report.json)
clsurf_cli_test(NAME ci_program_from_standard_input SETUP "${two_logs}; cp ${planted} stdin" ARGS check - a.biip b.biip EXIT 2 STDERR "the program of several logs cannot come from standard input")
# The shell steps of the GitHub action, run as by a runner.
clsurf_cli_test(NAME ci_action SETUP "/usr/bin/python3 ${PROJECT_SOURCE_DIR}/tests/cli/run_action.py ${PROJECT_SOURCE_DIR}/action.yml $CLSURF @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip" ARGS --version STDOUT "clsurf")
