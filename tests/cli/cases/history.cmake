# A history from making to queries, and refused arguments. Rows are also read with Python's own SQLite.

set(bottle @DATA@/programs/bottle_uneven.nc)
set(recorded "$CLSURF history shop.db add ${bottle} @LOGS@/bottle_uneven.biip --tool ball:6 --param tool=D6R3 --time 2026-11-02 -q; $CLSURF history shop.db add ${planted} @LOGS@/planted_loops.biip --param tool=D8R1 --time 2026-11-01 -q")
# The same without the as-machined surface, which takes seconds.
string(REPLACE "--tool ball:6" "--tool none" two_parts "${recorded}")
clsurf_cli_test(NAME history_add SETUP "cp ${bottle} part.nc; cp @LOGS@/bottle_uneven.biip run.biip"
  ARGS history shop.db add part.nc run.biip --tool none --param tool=D6R3 FILE shop.db STDOUT "^run 1 of shop.db" "part.nc" "tool=D6R3")
clsurf_cli_test(NAME history_row_is_what_check_says
  SETUP "${recorded}; $CLSURF check ${bottle} @LOGS@/bottle_uneven.biip --tool ball:6 -o check.json; python3 @DATA@/../tests/cli/read_history.py shop.db check.json ${bottle} @LOGS@/bottle_uneven.biip"
  ARGS history shop.db show 1 STDOUT "^run 1 of 2026-11-02 00:00" "feed_drop +distinct")
clsurf_cli_test(NAME history_list_is_in_the_order_of_time SETUP "${two_parts}" ARGS history shop.db list STDOUT "  2 2026-11-01 00:00 planted_loops.nc.*  1 2026-11-02 00:00 bottle_uneven.nc")
set(same_runs "cp @AFTER@/shop.db .")
clsurf_cli_test(NAME history_list_json_has_the_stated_keys
  SETUP "${recorded}; $CLSURF history shop.db list --json > runs.json; python3 -c \"import json; run = json.load(open('runs.json'))['runs'][1]; assert list(run)[:15] == 'id time program program_sha256 log_sha256 machine duration_s defects worst_score deepest_um ra_um speed_mismatch_p99_percent judged within_budget parameters'.split(), run; assert run['parameters'] == {'tool': 'D6R3'} and run['judged'] is True and run['ra_um'] > 0\""
  ARGS history shop.db list --where tool=D8R1 NO_STDOUT "bottle" STDOUT "planted")
clsurf_cli_test(NAME history_adds_a_run_once SETUP "${two_parts}; ${two_parts}" ARGS history shop.db list --json STDOUT "\"id\": 1" "\"id\": 2" NO_STDOUT "\"id\": 3")
clsurf_cli_test(NAME history_adds_it_again_with_other_parameters AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db add ${bottle} @LOGS@/bottle_uneven.biip --tool none --param tool=new STDOUT "^run 3 of shop.db\n")
clsurf_cli_test(NAME history_says_what_it_replaced AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db add ${bottle} @LOGS@/bottle_uneven.biip --tool none --param tool=D6R3 STDOUT "^run 1 of shop.db, replaces an earlier record")
clsurf_cli_test(NAME history_add_fails_as_check_does ARGS history shop.db add ${bottle} @LOGS@/bottle_uneven.biip --tool none --max-depth 5um EXIT 1 FILE shop.db STDOUT "over budget")
clsurf_cli_test(NAME history_adds_what_is_not_judged SETUP "head -c 100000 @LOGS@/bottle_uneven.biip > run.biip" ARGS history shop.db add ${bottle} run.biip EXIT 5 STDOUT "not judged")

# ---- since when, with which tool ----
# Twelve runs of one part: without defects with the new tool; with the worn one five passes slow down.
set(twelve "for day in 01 02 03 04 05 06; do $CLSURF history shop.db add ${planted} @LOGS@/planted_loops.biip --time 2026-11-$day --param tool=new --param number=$day -q; done; python3 @DATA@/../tests/cli/worsen_runs.py shop.db 6")
clsurf_cli_test(NAME history_since_when SETUP "${twelve}" ARGS history shop.db trend --quantity worst_score --by tool -o trend.png FILE trend.png
  STDOUT "Since run 7 .2026-11-07 00:00. the median has been" "worn +6 runs.*new +6 runs")
clsurf_cli_test(NAME history_trend_of_a_pass AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db trend --program bottle_uneven.nc --pass 7 --json STDOUT "\"pass\": 7" "\"value\": [1-9]")
clsurf_cli_test(NAME history_trend_of_lines AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db trend --program bottle_uneven.nc --lines 500-670 --quantity defects STDOUT "Defects, lines 500-670 over 1 run: [1-9]")
clsurf_cli_test(NAME history_trend_of_passes_of_two_programs AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db trend --pass 7 EXIT 2 STDERR "passes and lines are those of one program" "--program")
clsurf_cli_test(NAME history_trend_of_an_unknown_quantity AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db trend --quantity worst_scor -o t.png EXIT 2 STDERR "has no quantity 'worst_scor'" "did you mean 'worst_score'" NO_FILE t.png)
clsurf_cli_test(NAME history_trend_of_the_whole_run AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db trend --quantity ra_um --cause corner EXIT 2 STDERR "ra_um describes whole runs")
clsurf_cli_test(NAME history_trend_by_nothing AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db trend --by spindle EXIT 2 STDERR "--by: no run has a parameter 'spindle'")
clsurf_cli_test(NAME history_trend_limit AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db trend --limit 1 STDOUT "2 of 2 runs are above 1")
clsurf_cli_test(NAME history_trend_over_its_own_database AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}; ln shop.db shop.png" ARGS history shop.db trend -o shop.png EXIT 2 STDERR "would be overwritten")
clsurf_cli_test(NAME history_outliers AFTER history_since_when SETUP "${same_runs}" ARGS history shop.db outliers --json STDOUT "\"outliers\": ")
clsurf_cli_test(NAME history_against_first AFTER history_since_when SETUP "${same_runs}" ARGS history shop.db against first STDOUT "run 12 .* against run 1 .*: 0 new defects, [0-9]+ worse")
clsurf_cli_test(NAME history_against_best AFTER history_since_when SETUP "${same_runs}" ARGS history shop.db against best --run 8 --json STDOUT "\"state\": \"worse\"")
clsurf_cli_test(NAME history_against_a_number AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db against 2 STDERR "warning: runs 1 and 2 are of different programs" STDOUT "new defects")
# Every 32nd record only: too few to judge.
set(one_unjudged "cp @DATA@/programs/dome_loops.nc . && $CLSURF export dome_loops.nc @LOGS@/dome_loops.biip -o all.csv --columns cmd.x,cmd.y,cmd.z -q && awk 'NR == 1 || NR % 32 == 0' all.csv > slow.csv && $CLSURF history shop.db add dome_loops.nc @LOGS@/dome_loops.biip --tool none -q && { $CLSURF history shop.db add dome_loops.nc slow.csv --period 0.032 -q || true; }")
clsurf_cli_test(NAME history_against_without_a_verdict SETUP "${one_unjudged}" ARGS history shop.db against 1 --run 2 EXIT 3 STDERR "run 2 was not judged: A record comes every 32 ms" "hint: choose runs with a verdict")
clsurf_cli_test(NAME history_trend_without_a_verdict AFTER history_against_without_a_verdict SETUP "${same_runs}" ARGS history shop.db trend STDOUT "over 1 run: [0-9.]+ times the threshold in run 1 .*, the latest with a value" "1 run has no value: failed, or not judged")
clsurf_cli_test(NAME history_against_none AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db against best EXIT 3 STDERR "no other judged run of the same program as run 1")
clsurf_cli_test(NAME history_report AFTER history_since_when SETUP "${same_runs}; $CLSURF history shop.db report -o shop.html; python3 @DATA@/../tests/cli/read_shop_page.py shop.html" ARGS history shop.db report -o shop.html FILE shop.html)

# ---- parameters ----
set(rules "printf '[tool]\nvalues = [\"D6R3\", \"D8R1\"]\nrequired = true\n[wear]\nkind = \"number\"\nunit = \"mm\"\nrange = [0, 0.2]\n' > rules.toml")
set(ruled "${rules}; $CLSURF history shop.db add ${planted} @LOGS@/planted_loops.biip --parameters rules.toml --param tool=D6R3 --param wear=0.05mm -q")
clsurf_cli_test(NAME history_parameters_are_kept SETUP "${ruled}" ARGS history shop.db list STDOUT "tool=D6R3 wear=0.05$")
clsurf_cli_test(NAME history_parameter_out_of_range SETUP "${ruled}" ARGS history shop.db add ${planted} @LOGS@/planted_loops.biip --param tool=D6R3 --param wear=0.3 EXIT 2 STDERR "wear=0.3 is out of range: 0 … 0.2 mm")
clsurf_cli_test(NAME history_parameter_of_no_name SETUP "${ruled}" ARGS history shop.db add ${planted} @LOGS@/planted_loops.biip --param tol=D6R3 EXIT 2 STDERR "there is no parameter 'tol'" "did you mean 'tool'")
clsurf_cli_test(NAME history_parameter_missing SETUP "${ruled}" ARGS history shop.db add ${planted} @LOGS@/planted_loops.biip EXIT 2 STDERR "the parameter 'tool' is required")
clsurf_cli_test(NAME history_parameter_without_a_value ARGS history shop.db add ${planted} @LOGS@/planted_loops.biip --param tool EXIT 2 STDERR "--param: 'tool' is not NAME=VALUE")
clsurf_cli_test(NAME history_parameters_malformed SETUP "printf '[wear]\nkind = \"nubmer\"\n' > rules.toml" ARGS history shop.db add ${planted} @LOGS@/planted_loops.biip --parameters rules.toml EXIT 3 STDERR "rules.toml:2:[0-9]+: error: 'nubmer' is not text, number or integer")
clsurf_cli_test(NAME history_parameters_range_of_a_text SETUP "printf '[tool]\nrange = [0, 1]\n' > rules.toml" ARGS history shop.db add ${planted} @LOGS@/planted_loops.biip --parameters rules.toml EXIT 3 STDERR "rules.toml:2:[0-9]+: error: is for numbers")

# ---- refused arguments ----
clsurf_cli_test(NAME history_of_nothing ARGS history EXIT 2 STDERR "missing argument: DB")
clsurf_cli_test(NAME history_without_a_verb ARGS history shop.db EXIT 2 STDERR "missing argument: VERB")
clsurf_cli_test(NAME history_unknown_verb ARGS history shop.db lst EXIT 2 STDERR "'lst' is not one of add, list, show" "did you mean 'list'")
clsurf_cli_test(NAME history_missing ARGS history nowhere.db list EXIT 3 STDERR "nowhere.db: error: cannot open")
clsurf_cli_test(NAME history_is_no_database SETUP "cp ${bottle} shop.db" ARGS history shop.db list EXIT 3 STDERR "shop.db: error: is not a history of clsurf")
clsurf_cli_test(NAME history_add_to_no_database SETUP "cp ${bottle} shop.db" ARGS history shop.db add ${bottle} @LOGS@/bottle_uneven.biip EXIT 3 STDERR "shop.db: error: is not a history of clsurf")
clsurf_cli_test(NAME history_of_another_program SETUP "python3 -c \"import sqlite3; sqlite3.connect('shop.db').execute('CREATE TABLE t (a)')\"" ARGS history shop.db list EXIT 3 STDERR "SQLite database of another program")
clsurf_cli_test(NAME history_of_a_newer_version AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}; python3 -c \"import sqlite3; sqlite3.connect('shop.db').execute('PRAGMA user_version = 99')\"" ARGS history shop.db list EXIT 3 STDERR "is a history of version 99. this clsurf reads versions up to [0-9]+" "use a newer clsurf")
clsurf_cli_test(NAME history_of_version_1 SETUP "python3 -c \"import sqlite3; sqlite3.connect('shop.db').executescript(open('@DATA@/../tests/history/version_1.sql').read())\"" ARGS history shop.db list STDOUT "monday|2026-11-20 06:00" "tool=D6R3")
clsurf_cli_test(NAME history_show_a_run_that_is_not_there AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db show 7 EXIT 3 STDERR "shop.db: error: has no run 7")
clsurf_cli_test(NAME history_show_no_number AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db show best EXIT 2 STDERR "'best' is not the number of a run")
clsurf_cli_test(NAME history_show_nothing AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db show EXIT 2 STDERR "missing argument: N")
clsurf_cli_test(NAME history_list_with_arguments AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db list all EXIT 2 STDERR "unexpected argument 'all'")
clsurf_cli_test(NAME history_option_of_another_verb AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db list --param tool=D6R3 EXIT 2 STDERR "history … list takes no --param")
clsurf_cli_test(NAME history_add_a_missing_log ARGS history shop.db add ${bottle} nowhere.biip EXIT 3 STDERR "nowhere.biip: error: cannot open" NO_FILE shop.db)
clsurf_cli_test(NAME history_add_without_a_log ARGS history shop.db add ${bottle} EXIT 2 STDERR "missing argument: PROGRAM LOG")
clsurf_cli_test(NAME history_add_standard_input SETUP "cp ${bottle} stdin" ARGS history shop.db add - @LOGS@/bottle_uneven.biip EXIT 2 STDERR "a run from standard input cannot be recorded")
clsurf_cli_test(NAME history_add_at_no_time ARGS history shop.db add ${bottle} @LOGS@/bottle_uneven.biip --time yesterday EXIT 2 STDERR "--time: 'yesterday' is not a time such as 2026-11-24")
clsurf_cli_test(NAME history_report_of_no_runs AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db report --last 3 --program other.nc -o shop.html EXIT 3 STDERR "has no such runs" NO_FILE shop.html)
clsurf_cli_test(NAME history_report_as_a_picture AFTER history_list_is_in_the_order_of_time SETUP "${same_runs}" ARGS history shop.db report -o shop.png EXIT 2 STDERR "must end in .html")
clsurf_cli_test(NAME history_in_a_folder_that_is_not_there ARGS history no/shop.db add ${planted} @LOGS@/planted_loops.biip EXIT 4 STDERR "no/shop.db: unable to open database file")

# ---- check --record ----
clsurf_cli_test(NAME record_check SETUP "$CLSURF check ${bottle} @LOGS@/bottle_uneven.biip --tool none --record shop.db --param tool=D6R3 -q" ARGS history shop.db list STDOUT "bottle_uneven.nc.*tool=D6R3")
clsurf_cli_test(NAME record_says_where ARGS check ${planted} @LOGS@/planted_loops.biip --record shop.db FILE shop.db STDERR "recorded as run 1 of shop.db")
clsurf_cli_test(NAME record_without_a_history ARGS check ${planted} @LOGS@/planted_loops.biip --param tool=D6R3 EXIT 2 STDERR "--param needs --record" "--record shop.db")
clsurf_cli_test(NAME record_into_no_database SETUP "cp ${bottle} shop.db" ARGS check ${planted} @LOGS@/planted_loops.biip --record shop.db EXIT 3 STDERR "shop.db: error: is not a history of clsurf")
# The configuration of a part is found next to the part, wherever the history is.
clsurf_cli_test(NAME record_with_the_configuration_of_the_part
  SETUP "mkdir part; cp ${bottle} part/part.nc; echo 'tool = \"ball:6\"' > part/.clsurf.toml; for k in 1 2; do $CLSURF history shop.db add part/part.nc @LOGS@/bottle_uneven.biip --param k=$k -q; done"
  ARGS history shop.db list --json STDOUT "\"tool\": \"ball:6\".*\"tool\": \"ball:6\"")

# ---- parameters in the metadata of a log ----
set(laser @DATA@/parameters/laser_drilling.toml)
set(with_parameters "$CLSURF convert @LOGS@/planted_loops.biip --parameters ${laser} --param hole=12 --param feed=1200 --param c=359.5deg --param laser_power=3 -o laser.biip -q")
clsurf_cli_test(NAME parameters_are_shown_on_the_page SETUP "${with_parameters} && $CLSURF report @DATA@/programs/planted_loops.nc laser.biip --before @LOGS@/planted_loops.biip --fields speed -o r.html -q && grep -q '<dt>Parameters</dt><dd>c=359.5 deg, feed=1200 mm/min, hole=12, laser_power=3.* <small>before: none</small>' r.html && $CLSURF report @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip --fields speed -o r.html -q && ! grep -q '<dt>Parameters' r.html"
  ARGS --version)
clsurf_cli_test(NAME parameters_are_shown_with_the_log SETUP "${with_parameters}" ARGS info laser.biip
  STDOUT "parameters: c=359.5 deg, feed=1200 mm/min, hole=12, laser_power=3")
clsurf_cli_test(NAME parameters_are_in_the_json_of_the_log SETUP "${with_parameters}" ARGS info laser.biip --json STDOUT "\"parameters\": ." "\"feed\": \"1200 mm/min\"")
clsurf_cli_test(NAME parameters_keep_to_their_range ARGS convert @LOGS@/planted_loops.biip --parameters ${laser} --param a=100 -o laser.biip EXIT 2
  STDERR "a=100 is out of range: -95 … 95 deg" NO_FILE laser.biip)
clsurf_cli_test(NAME parameters_keep_to_their_unit ARGS convert @LOGS@/planted_loops.biip --parameters ${laser} --param feed=1200mm/s -o laser.biip EXIT 2
  STDERR "is in 'mm/s', expected mm/min")
clsurf_cli_test(NAME parameters_of_the_schema_only ARGS convert @LOGS@/planted_loops.biip --parameters ${laser} --param power=3 -o laser.biip EXIT 2
  STDERR "there is no parameter 'power'")
clsurf_cli_test(NAME parameters_of_a_log_go_into_the_history SETUP "${with_parameters}; $CLSURF history laser.db add ${planted} laser.biip --parameters ${laser} --param track=1 -q"
  ARGS history laser.db list --where feed=1200 --json STDOUT "\"hole\": \"12\"" "\"track\": \"1\"")
clsurf_cli_test(NAME parameters_of_a_log_are_held_to_the_rules SETUP "$CLSURF convert @LOGS@/planted_loops.biip --param hole=none -o laser.biip -q"
  ARGS history laser.db add ${planted} laser.biip --parameters ${laser} EXIT 2 STDERR "hole=none is not a whole number")
