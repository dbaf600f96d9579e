# Many runs: failures are rows, recorded runs are not judged again, tasks and merged databases give the same.

set(planted @DATA@/programs/planted_loops.nc)
set(fleet_runs "cp ${planted} part.nc; cp @LOGS@/planted_loops.biip part_1.biip; cp @LOGS@/planted_loops.biip part_2.biip; printf 'x' >> part_2.biip; printf '[[run]]\nprogram = \"part.nc\"\nlog = \"part_1.biip\"\nparameters = { tool = \"D6 R3\", wear = 0.1 }\ntime = \"2026-11-01\"\n[[run]]\nprogram = \"part.nc\"\nlog = \"nowhere.biip\"\n[[run]]\nprogram = \"part.nc\"\nlog = \"part_2.biip\"\ntime = \"2026-11-02\"\n' > runs.toml")
set(fleet_twice "${fleet_runs}; $CLSURF fleet runs.toml -o shop.db -q || true")
# The rows of two histories of the same runs, without their times and order of judging.
set(rows "import sqlite3, sys; print(sorted(sqlite3.connect(sys.argv[1]).execute('SELECT log_sha256, CASE WHEN length(failure) = 0 THEN time END, worst_score, defects, failure, settings, (SELECT count(*) FROM sections WHERE run = id), (SELECT group_concat(value) FROM parameters WHERE run = id) FROM runs')))")
clsurf_cli_test(NAME fleet_a_failure_is_a_row SETUP "${fleet_runs}" ARGS fleet runs.toml -o shop.db EXIT 1 FILE shop.db
  STDOUT "^3 runs in shop.db: 2 judged, 0 of them over their limits, 0 not judged, 1 failed" "failed: part.nc nowhere.biip: nowhere.biip: error: cannot open")
clsurf_cli_test(NAME fleet_rows SETUP "${fleet_twice}" ARGS history shop.db list --json STDOUT "\"failure\": \"nowhere.biip: error: cannot open" "\"tool\": \"D6 R3\"" "\"wear\": \"0.1\"")
# A failed run is not a run without defects.
set(failed_and_judged "cp ${planted} part.nc; $CLSURF fleet --program part.nc --log nowhere.biip -o shop.db -q || true; $CLSURF fleet --program part.nc --log @LOGS@/planted_loops.biip -o shop.db -q")
clsurf_cli_test(NAME fleet_a_failure_has_no_measures SETUP "${failed_and_judged}; $CLSURF history shop.db list --json > list.json; $CLSURF history shop.db show 1 --json > show.json; python3 @DATA@/../tests/cli/read_failed.py list.json show.json"
  ARGS history shop.db list STDOUT "part.nc +- +- +- +- +- failed")
clsurf_cli_test(NAME fleet_a_failure_is_shown_without_measures SETUP "${failed_and_judged}" ARGS history shop.db show 1 STDOUT "nowhere.biip: error: cannot open" NO_STDOUT "Worst|Defects|Deepest|Area")
clsurf_cli_test(NAME fleet_a_failure_is_not_averaged SETUP "${failed_and_judged}; $CLSURF history shop.db report -o shop.html -q; grep -q '<td>part.nc</td><td class=\"n\">2</td><td class=\"n\">1</td><td class=\"n\">0</td><td class=\"n\">3.0</td>' shop.html; grep -q '<td class=\"n\">–</td><td class=\"n\">–</td><td class=\"n\">–</td><td>failed</td>' shop.html"
  ARGS history shop.db report -o again.html FILE again.html)
clsurf_cli_test(NAME fleet_goes_on_where_it_was SETUP "${fleet_twice}" ARGS fleet runs.toml -o shop.db EXIT 1 STDOUT "2 judged.*1 failed. 3 of the 3 were recorded already")
clsurf_cli_test(NAME fleet_judges_again_what_changed SETUP "${fleet_twice}; printf 'y' >> part_2.biip" ARGS fleet runs.toml -o shop.db EXIT 1 STDOUT ". 2 of the 3 were recorded already")
clsurf_cli_test(NAME fleet_judges_again_with_other_options SETUP "${fleet_twice}" ARGS fleet runs.toml -o shop.db --tool ball:6 --json EXIT 1 STDOUT "\"already_recorded\": 0" "\"cause\": \"nowhere.biip: error")
clsurf_cli_test(NAME fleet_tries_failed_runs_again SETUP "${fleet_twice}; $CLSURF history shop.db list > ../before; cp @LOGS@/planted_loops.biip nowhere.biip" ARGS fleet runs.toml -o shop.db --retry-failed STDOUT "3 judged.*0 failed. 2 of the 3 were recorded already")
clsurf_cli_test(NAME fleet_a_verdict_replaces_its_failure SETUP "${fleet_twice}; cp @LOGS@/planted_loops.biip nowhere.biip; $CLSURF fleet runs.toml -o shop.db --retry-failed -q" ARGS history shop.db list --json STDOUT "\"log\": \"nowhere.biip\"" NO_STDOUT "\"failure\": \"nowhere")
# Parameters of the log count, even if --param gives another one.
clsurf_cli_test(NAME fleet_knows_runs_by_the_parameters_of_their_logs
  SETUP "cp ${planted} part.nc; $CLSURF convert @LOGS@/planted_loops.biip --param tool=D6R3 -o part.biip -q; $CLSURF fleet --program part.nc --log part.biip -o shop.db --param wear=0.1 -q"
  ARGS fleet --program part.nc --log part.biip -o shop.db --param wear=0.1 STDOUT "^1 run in shop.db: 1 judged.* 0 failed. 1 of the 1 was recorded already")
clsurf_cli_test(NAME fleet_merge_of_one SETUP "${fleet_runs}; $CLSURF history a.db add part.nc part_1.biip -q" ARGS fleet --merge a.db -o m.db STDOUT "^1 run of 1 database taken into m.db, which has 1 now")
clsurf_cli_test(NAME fleet_merge_of_other_rules SETUP "${fleet_runs}; printf '[wear]\nkind = \"number\"\n' > a.toml; printf '[wear]\nkind = \"text\"\n' > b.toml; for k in a b; do $CLSURF history $k.db add part.nc part_1.biip --parameters $k.toml --param wear=1 -q; done"
  ARGS fleet --merge a.db b.db -o m.db EXIT 3 STDERR "b.db: error: has another rule for the parameter 'wear' than a.db" "--parameters FILE")
clsurf_cli_test(NAME fleet_is_killed_and_goes_on
  SETUP "${fleet_runs}; $CLSURF fleet runs.toml -o whole.db -q || true; for wait in 0.02 0.1 0.3 0.6 1; do timeout -s KILL $wait $CLSURF fleet runs.toml -o shop.db --jobs 1 -q || true; done; $CLSURF fleet runs.toml -o shop.db -q || true; python3 -c \"${rows}\" whole.db > a; python3 -c \"${rows}\" shop.db > b; cmp a b"
  ARGS fleet runs.toml -o shop.db EXIT 1 STDOUT "3 of the 3 were recorded already")
clsurf_cli_test(NAME fleet_of_a_folder SETUP "mkdir -p november/programs november/logs; cp ${planted} november/programs/part.nc; cp @LOGS@/planted_loops.biip november/logs/part_monday.biip; cp @LOGS@/planted_loops.biip november/logs/other.biip; echo nothing > november/notes.txt"
  ARGS fleet november -o shop.db EXIT 1 STDOUT "2 runs in shop.db: 1 judged.* 1 failed" "other.biip: no program was found for this log")
clsurf_cli_test(NAME fleet_of_a_folder_with_links SETUP "mkdir -p november/monday; cp ${planted} november/monday/part.nc; cp @LOGS@/planted_loops.biip november/monday/part_1.biip; ln -s monday november/latest; ln -s . november/loop"
  ARGS fleet november -o shop.db STDOUT "^1 run in shop.db: 1 judged")
clsurf_cli_test(NAME fleet_limits SETUP "${fleet_runs}; sed -i 's/nowhere/part_1/' runs.toml" ARGS fleet runs.toml -o shop.db --max-depth 1um EXIT 1 STDOUT "3 judged, 3 of them over their limits")
# Two logs of the same content are one run.
clsurf_cli_test(NAME fleet_of_the_same_content_twice SETUP "mkdir -p logs/a logs/b; for k in a b; do cp ${planted} logs/$k/part.nc; cp @LOGS@/planted_loops.biip logs/$k/part_1.biip; echo nothing > logs/$k/part_2.biip; echo other > logs/$k/other.biip; done; $CLSURF fleet logs -o shop.db -q || true; python3 -c \"import sqlite3; assert sqlite3.connect('shop.db').execute('SELECT count(*) FROM runs').fetchone() == (3,)\""
  ARGS fleet logs -o again.db EXIT 1 STDOUT "^3 runs in again.db: 1 judged, .* 2 failed. 3 more have the content of one of these")
clsurf_cli_test(NAME fleet_of_the_same_content_in_json SETUP "cp ${planted} part.nc; for k in 1 2; do cp @LOGS@/planted_loops.biip part_$k.biip; done" ARGS fleet . -o shop.db --json STDOUT "\"runs\": 1,\n *\"repeated\": 1,")
clsurf_cli_test(NAME fleet_one_run SETUP "${fleet_runs}" ARGS fleet --program part.nc --log part_1.biip -o shop.db --param tool=D6 STDOUT "^1 run in shop.db: 1 judged")
clsurf_cli_test(NAME fleet_within_little_memory SETUP "${fleet_runs}" ARGS fleet --program part.nc --log part_1.biip -o shop.db --memory 3M EXIT 1 STDOUT "0 judged.* 1 failed" "failed: part.nc part_1.biip: .*(memory|shared|signal)")
clsurf_cli_test(NAME fleet_within_enough_memory SETUP "${fleet_runs}" ARGS fleet runs.toml -o shop.db --memory 2G --jobs 2 EXIT 1 STDOUT "2 judged")
clsurf_cli_test(NAME fleet_progress SETUP "${fleet_runs}" ARGS fleet runs.toml -o shop.db --progress always EXIT 1 STDERR "of 3 runs, 1 failed")
# The same list as tasks, in another order.
clsurf_cli_test(NAME fleet_tasks
  SETUP "${fleet_runs}; mkdir bin; ln -s $CLSURF bin/clsurf; $CLSURF fleet runs.toml -o shop.db -q || true; $CLSURF fleet runs.toml -o many.db --tasks | tac > tasks; PATH=$PWD/bin:$PATH; while read -r task; do sh -c \"$task\" > /dev/null || true; done < tasks; $CLSURF fleet --merge many.db.parts -o many.db -q; python3 -c \"${rows}\" shop.db > a; python3 -c \"${rows}\" many.db > b; sed -i \"s,$PWD/,,g\" a b; cmp a b"
  ARGS fleet --merge many.db.parts -o many.db STDOUT "^0 runs of 3 databases taken into many.db, which has 3 now")
clsurf_cli_test(NAME fleet_tasks_are_quoted SETUP "cp ${planted} \"it's a part.nc\"; cp @LOGS@/planted_loops.biip a.biip" ARGS fleet --program "it's a part.nc" --log a.biip -o shop.db --tasks STDOUT "--program '/[^\n]*/it'.''s a part.nc'" NO_FILE shop.db)

# ---- refused arguments ----
clsurf_cli_test(NAME fleet_of_nothing ARGS fleet -o shop.db EXIT 2 STDERR "one of RUNS.toml, FOLDER, and --program with --log is needed")
clsurf_cli_test(NAME fleet_without_a_history SETUP "${fleet_runs}" ARGS fleet runs.toml EXIT 2 STDERR "no output file given")
clsurf_cli_test(NAME fleet_missing_list ARGS fleet nowhere.toml -o shop.db EXIT 3 STDERR "nowhere.toml: error: cannot open" NO_FILE shop.db)
clsurf_cli_test(NAME fleet_empty_list SETUP "echo 'tool = \"ball:6\"' > runs.toml" ARGS fleet runs.toml -o shop.db EXIT 3 STDERR "runs.toml: error: lists no runs")
clsurf_cli_test(NAME fleet_run_without_a_log SETUP "printf '[[run]]\nprogram = \"part.nc\"\n' > runs.toml" ARGS fleet runs.toml -o shop.db EXIT 3 STDERR "runs.toml:1:[0-9]+: error: a run needs a log")
clsurf_cli_test(NAME fleet_unknown_key SETUP "printf '[[run]]\nprogram = \"part.nc\"\nlog = \"a.biip\"\ntoool = \"ball:6\"\n' > runs.toml" ARGS fleet runs.toml -o shop.db EXIT 3 STDERR "runs.toml:4:[0-9]+: error: unknown key 'toool'" "did you mean 'tool'")
clsurf_cli_test(NAME fleet_empty_folder SETUP "mkdir november" ARGS fleet november -o shop.db EXIT 3 STDERR "november: error: holds no log" NO_FILE shop.db)
clsurf_cli_test(NAME fleet_into_no_history SETUP "${fleet_runs}; cp part.nc shop.db" ARGS fleet runs.toml -o shop.db EXIT 3 STDERR "shop.db: error: is not a history of clsurf")
clsurf_cli_test(NAME fleet_no_jobs SETUP "${fleet_runs}" ARGS fleet runs.toml -o shop.db --jobs 0 EXIT 2 STDERR "--jobs must be at least 1")
clsurf_cli_test(NAME fleet_memory_without_a_unit SETUP "${fleet_runs}" ARGS fleet runs.toml -o shop.db --memory 8 EXIT 2 STDERR "--memory: '8' is not a size of memory with its unit")
clsurf_cli_test(NAME fleet_merge_what_is_none SETUP "${fleet_runs}" ARGS fleet --merge part.nc -o shop.db EXIT 3 STDERR "part.nc: error: is not a history of clsurf" NO_FILE shop.db)
clsurf_cli_test(NAME fleet_merge_nothing SETUP "mkdir parts" ARGS fleet --merge parts -o shop.db EXIT 2 STDERR "--merge: no database")
