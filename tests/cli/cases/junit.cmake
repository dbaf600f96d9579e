# JUnit and baselines: the report for a build server agrees with the exit code.

set(planted @DATA@/programs/planted_loops.nc)
set(planted_log @LOGS@/planted_loops.biip)
set(junit "python3 @DATA@/../tests/cli/read_junit.py")
clsurf_cli_test(NAME junit_limits SETUP "$CLSURF check ${planted} ${planted_log} --max-depth 1um --fail-on reject -o a.xml || true; ${junit} a.xml 1 1 0"
  ARGS check ${planted} ${planted_log} --max-depth 1um --format junit EXIT 1 STDOUT "<testcase classname=\"[^\"]*planted_loops.nc\" name=\"max_depth_um 1\">" "<failure type=\"limit\" message=\"max_depth_um is")
clsurf_cli_test(NAME junit_defects_without_a_limit_fail_nothing SETUP "$CLSURF check ${planted} ${planted_log} -o a.xml; ${junit} a.xml 1 0 0" ARGS check ${planted} ${planted_log} -o b.xml FILE b.xml)
clsurf_cli_test(NAME junit_not_judged SETUP "head -c 100000 ${planted_log} > a.biip; $CLSURF check ${planted} a.biip --fail-on reject -o a.xml || true; ${junit} a.xml 1 0 1" ARGS check ${planted} a.biip --format junit EXIT 5 STDOUT "<error type=\"not judged\"")
clsurf_cli_test(NAME junit_several_logs SETUP "cp ${planted_log} 'a&b.biip'; $CLSURF check ${planted} ${planted_log} 'a&b.biip' --max-depth 1um -o a.xml || true; ${junit} a.xml 2 2 0" ARGS check ${planted} a&b.biip --format junit STDOUT "a&amp.b[.]biip")
clsurf_cli_test(NAME junit_compare SETUP "cp ${shot}/speed_iso.png a.png; cp ${shot}/speed_top.png b.png; $CLSURF compare a.png b.png -o a.xml || true; ${junit} a.xml 1 1 0; $CLSURF compare a.png a.png -o b.xml; ${junit} b.xml 1 0 0" ARGS compare a.png b.png --format junit EXIT 1 STDOUT "name=\"equals b.png\"" "message=\"(different|sizes differ)")

# ---- baselines ----
set(baselines "$CLSURF check ${planted} ${planted_log} -o old.json; $CLSURF check ${planted} ${planted_log} -o old.sarif")
# The earlier run had one defect less, and another one was less severe.
set(milder "python3 -c \"import json; r = json.load(open('old.json')); d = r['logs'][0]['defects']; d.pop(0); d[0]['severity'] = 1; json.dump(r, open('old.json', 'w')); s = json.load(open('old.sarif')); e = s['runs'][0]['results']; e.pop(0); e[0]['properties']['severity'] = 1; json.dump(s, open('old.sarif', 'w'))\"")
foreach(form json sarif)
  clsurf_cli_test(NAME baseline_same_${form} SETUP "${baselines}" ARGS check ${planted} ${planted_log} --baseline old.${form} STDOUT "against the baseline: 0 new defects, 0 worse, 0 gone, 3 as before")
  clsurf_cli_test(NAME baseline_new_${form} SETUP "${baselines}; ${milder}" ARGS check ${planted} ${planted_log} --baseline old.${form} EXIT 1 STDOUT "against the baseline: 1 new defects, 1 worse, 0 gone, 1 as before\nnew: 1\nworse: 2")
endforeach()
clsurf_cli_test(NAME baseline_states_in_sarif
  SETUP "${baselines}; ${milder}; $CLSURF check ${planted} ${planted_log} --baseline old.sarif -o new.sarif || true; python3 -c \"import json; r = json.load(open('new.sarif'))['runs'][0]['results']; assert [x['baselineState'] for x in r] == ['new', 'updated', 'unchanged'], r\""
  ARGS check ${planted} ${planted_log} --baseline old.sarif --format json EXIT 1 STDOUT "\"baseline\": \"new\"" "\"new_defects\": 1" "\"worse_defects\": 1")
clsurf_cli_test(NAME baseline_in_junit SETUP "${baselines}; ${milder}; $CLSURF check ${planted} ${planted_log} --baseline old.json -o a.xml || true; ${junit} a.xml 1 1 0" ARGS check ${planted} ${planted_log} --baseline old.json --format junit EXIT 1 STDOUT "name=\"no new defects\"")
clsurf_cli_test(NAME baseline_gone SETUP "$CLSURF check ${planted} ${planted_log} -o old.json; head -c 1900000 ${planted_log} > a.biip" ARGS check ${planted} a.biip --baseline old.json STDOUT "[0-9] gone")
clsurf_cli_test(NAME baseline_missing ARGS check ${planted} ${planted_log} --baseline nowhere.json EXIT 3 STDERR "nowhere.json: error: cannot open")
clsurf_cli_test(NAME baseline_is_none SETUP "echo '{\"runs\": [{}]}' > old.sarif" ARGS check ${planted} ${planted_log} --baseline old.sarif EXIT 3 STDERR "old.sarif: error: is not a report of clsurf check")
clsurf_cli_test(NAME baseline_of_lint SETUP "$CLSURF lint ${planted} -o old.json || true" ARGS check ${planted} ${planted_log} --baseline old.json EXIT 3 STDERR "old.json: error: is not a report of clsurf check")
