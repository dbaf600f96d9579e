# How `check` and `report` present findings: verdict, order, numbers, words.

# ---- no verdict if too little could be compared ----
# Forty passes of 0.5 mm consist only of ends: nothing is compared.
set(short_passes "(printf 'G21 G90 G54\\nG0 X0 Y0 Z5\\nG1 Z0 F600\\n' && seq 0 2 38 | awk '{printf \"G1 Y%.1f\\nX0.5\\nY%.1f\\nX0\\n\", $1/5, ($1+1)/5}' && echo M30) > part.nc"
  "$CLSURF simulate part.nc -o run.biip > /dev/null")
set(one_pass "printf 'G21 G90 G54\\nG0 X0 Y0 Z5\\nG1 Z0 F600\\nX30\\nM30\\n' > part.nc" "$CLSURF simulate part.nc -o run.biip > /dev/null")
list(JOIN short_passes " && " short_passes)
list(JOIN one_pass " && " one_pass)
set(depth_budget "echo 'max_depth_um = 5' > budget.toml")

clsurf_cli_test(NAME short_passes_are_not_judged SETUP "${short_passes} && ${depth_budget}" ARGS check part.nc run.biip --budget budget.toml
  EXIT 5 STDOUT "^NOT JUDGED: Only 0[.]0 % of [0-9]+ cutting points" "max_depth_um .* NOT JUDGED" NO_STDOUT "nan" " kept" STDERR "warning: not judged: Only")
clsurf_cli_test(NAME one_pass_is_not_judged SETUP "${one_pass} && ${depth_budget}" ARGS check part.nc run.biip --budget budget.toml
  EXIT 5 STDOUT "NOT JUDGED: No pass has an adjacent pass" NO_STDOUT "nan" " kept")
clsurf_cli_test(NAME not_judged_in_json SETUP "${short_passes}" ARGS check part.nc run.biip --json
  EXIT 5 STDOUT "\"judged\": false" "\"within_budget\": false" "\"coverage_percent\": 0" "\"not_judged_reasons\": .*Only 0[.]0 %" NO_STDOUT "nan" "NaN")
clsurf_cli_test(NAME not_judged_in_sarif SETUP "${short_passes}" ARGS check part.nc run.biip --format sarif
  EXIT 5 STDOUT "\"toolExecutionNotifications\": .*Not judged" "\"ruleId\": \"not_judged\"" NO_STDOUT "nan")
clsurf_cli_test(NAME not_judged_on_the_page
  SETUP "${short_passes} && $CLSURF report part.nc run.biip -o page.html 2> /dev/null && grep -q 'class=.alarm. role=.alert.><b>Not judged' page.html && (! grep -q 'speed nan' page.html)"
  ARGS check part.nc run.biip EXIT 5 FILE page.html)
clsurf_cli_test(NAME not_judged_in_the_picture
  SETUP "${short_passes} && $CLSURF render part.nc run.biip --defects -o map.svg -q && grep -q 'not judged: clsurf check says why' map.svg"
  ARGS render part.nc run.biip --defects -o map.png FILE map.png)
clsurf_cli_test(NAME judged_in_json ARGS check ${part} ${run} --tool none --json STDOUT "\"judged\": true" "\"not_judged_reasons\": ..,")

# ---- order: the most conspicuous finding comes first ----
# The five slow passes of the sample part, and then the lag of all passes as one finding.
clsurf_cli_test(NAME slow_passes_come_first ARGS check ${part} ${run}
  STDOUT "1 distinct point_spacing .* 2 distinct point_spacing .* 3 distinct point_spacing .* 4 [dr][a-z]+ +point_spacing .* 5 [dr][a-z]+ +point_spacing .* 6 distinct lag_step .*±")
clsurf_cli_test(NAME findings_in_falling_order_in_json
  SETUP "$CLSURF check ${part} ${run} --tool none --json | awk '/\"expected\":/ {exit} {print}' > found && grep -oE '\"score\": [0-9.]+' found | cut -d' ' -f2 > scores && test -s scores && sort -rgc scores && grep -oE '\"rank\": [0-9]+' found | cut -d' ' -f2 > ranks && sort -gc ranks && test $(wc -l < scores) = $(tail -1 ranks) && test $(grep -c '\"systematic\": true' found) = 1"
  ARGS --version)

# ---- words and numbers ----
clsurf_cli_test(NAME verdict_comes_first ARGS check ${part} ${run}
  STDOUT "^[0-9]+ defects: [0-9]+ slower sections .up to -8[0-9] %., systematic axis lag .±[0-9.]+ µm on [0-9]+ % of the part." "Stands out most: Pass [0-9]+ runs 8[0-9] % slower than its neighbours")
clsurf_cli_test(NAME lag_of_a_zigzag_names_its_axes ARGS check ${part} ${run} --json
  STDOUT "Axes lag, forward against backward.*servo gains or feed-forward of X and Z differ .Z trails X by 1[.][0-9]+ ms." "\"axis\": \"z\"")
clsurf_cli_test(NAME clean_recording_has_no_reject ARGS check @DATA@/programs/bottle_zigzag.nc @LOGS@/bottle_zigzag.biip NO_STDOUT "reject" STDOUT "[0-9]+ defects: systematic axis lag")
clsurf_cli_test(NAME clean_loops_have_no_reject ARGS check @DATA@/programs/dome_loops.nc @LOGS@/dome_loops.biip NO_STDOUT "reject")
clsurf_cli_test(NAME table_fits_80_columns SETUP "$CLSURF check ${part} ${run} --tool ball:6 | sed -n '/^rank/,/^$/p' > table && grep -q 'lines 1178-1334$' table && test $(LC_ALL=C.UTF-8 wc -L < table) -le 80" ARGS --version)
# script(1) gives check a terminal of that width.
set(in_a_terminal "script -qec \"stty cols COLUMNS; $CLSURF check ${part} ${run} --tool ball:6 --progress never\" /dev/null < /dev/null | tr -d '\\r' > seen")
string(REPLACE COLUMNS 90 narrow "${in_a_terminal}")
string(REPLACE COLUMNS 160 wide "${in_a_terminal}")
clsurf_cli_test(NAME text_fits_a_narrow_terminal SETUP "${narrow} && grep -q 'lines 1178-1334$' seen && test $(LC_ALL=C.UTF-8 wc -L < seen) -le 90" ARGS --version)
clsurf_cli_test(NAME table_uses_a_wide_terminal SETUP "${wide} && grep -q '^   1 distinct .* 1178-1334$' seen" ARGS --version)
# 2.9999999329447746 is a float printed as a double.
clsurf_cli_test(NAME json_has_as_many_digits_as_mean_something SETUP "$CLSURF check ${part} ${run} --tool ball:6 --json > report.json && (! grep -E '[.][0-9]{6}' report.json) && grep -q '\"speed_percent\": 3.0' report.json" ARGS --version)
clsurf_cli_test(NAME slower_is_negative_everywhere
  SETUP "$CLSURF check ${part} ${run} --tool none --json | grep -E 'speed_jump_(mm_min|percent)' | sed -n 1,2p > first && test $(grep -c ': -[0-9]' first) = 2 && $CLSURF check ${part} ${run} --tool none --format csv | sed -n 2p | cut -d, -f14,19 | grep -qE '^-[0-9.]+,-[0-9.]+$'"
  ARGS --version)
clsurf_cli_test(NAME sarif_speaks_in_sentences ARGS check ${part} ${run} --format sarif
  STDOUT "\"text\": \"Pass [0-9]+ runs 8[0-9] % slower than its neighbours" "\"markdown\"" "\"clsurfDefect/v1\": \"point_spacing/speed/14/" "\"help\"" "\"level\": \"error\"" "\"level\": \"warning\"" "\"ruleId\": \"systematic_lag\"")

# ---- accepted defects ----
# A file of accepted defects like that of the page: `accepted RANK… > FILE` takes the fingerprints of a report.
set(accept_two "$CLSURF check ${part} ${run} --tool none --json > all.json && python3 -c \"import json; d = json.load(open('all.json'))['defects']; json.dump({'clsurf_accepted': 1, 'defects': [{'fingerprint': x['fingerprint'], 'severity': x['severity'], 'comment': 'polished by hand'} for x in d[:2]]}, open('ok.json', 'w'))\"")
clsurf_cli_test(NAME accepted_defects_are_listed SETUP "${accept_two}" ARGS check ${part} ${run} --tool none --accepted ok.json
  STDOUT "^1[0-9] defects" "   1 distinct point_spacing" "accepted: 1 .polished by hand., 2 .polished by hand.")
clsurf_cli_test(NAME accepted_defects_in_json SETUP "${accept_two}" ARGS check ${part} ${run} --tool none --accepted ok.json --json
  STDOUT "\"accepted\": 2" "\"state\": \"accepted\"" "\"comment\": \"polished by hand\"")
clsurf_cli_test(NAME accepted_defects_are_suppressed_in_sarif SETUP "${accept_two} && $CLSURF check ${part} ${run} --tool none --accepted ok.json -o part.sarif && python3 -c \"import json; r = json.load(open('part.sarif'))['runs'][0]['results']; assert [i for i, x in enumerate(r) if 'suppressions' in x] == [0, 1]; assert r[0]['suppressions'][0]['justification'] == 'polished by hand'\""
  ARGS --version)
clsurf_cli_test(NAME accepted_defects_in_csv SETUP "${accept_two} && $CLSURF check ${part} ${run} --tool none --accepted ok.json -o part.csv && python3 -c \"import csv; rows = list(csv.DictReader(open('part.csv'))); assert all(None not in x for x in rows); assert {x['id'] for x in rows if x['accepted'] == 'true'} == {'1', '2'}\""
  ARGS --version)
# Only defects that are not accepted count: a budget of all but two is met, a budget of one less is not.
set(all_but "${accept_two} && python3 -c \"import json; print('max_defects =', len(json.load(open('all.json'))['defects']) - COUNT)\" > budget.toml")
string(REPLACE COUNT 2 all_but_two "${all_but}")
string(REPLACE COUNT 3 all_but_three "${all_but}")
clsurf_cli_test(NAME accepted_defects_do_not_count SETUP "${all_but_two}" ARGS check ${part} ${run} --tool none --accepted ok.json --budget budget.toml STDOUT "max_defects .* kept")
clsurf_cli_test(NAME defects_count_unless_accepted SETUP "${all_but_two}" ARGS check ${part} ${run} --tool none --budget budget.toml EXIT 1 STDOUT "max_defects .* NOT KEPT")
clsurf_cli_test(NAME others_count_beside_accepted SETUP "${all_but_three}" ARGS check ${part} ${run} --tool none --accepted ok.json --budget budget.toml EXIT 1 STDOUT "max_defects .* NOT KEPT")
set(accept_all "$CLSURF check ${part} ${run} --tool none --json > all.json && python3 -c \"import json; d = json.load(open('all.json'))['defects']; json.dump({'clsurf_accepted': 1, 'defects': [{'fingerprint': x['fingerprint'], 'severity': SEVERITY} for x in d]}, open('ok.json', 'w'))\"")
string(REPLACE SEVERITY "x['severity']" accept_as_they_are "${accept_all}")
string(REPLACE SEVERITY "max(1, x['severity'] - 1)" accept_as_milder "${accept_all}")
clsurf_cli_test(NAME nothing_fails_where_all_is_accepted SETUP "${accept_as_they_are}" ARGS check ${part} ${run} --tool none --accepted ok.json --fail-on trace STDOUT "accepted: 1, 2, 3")
clsurf_cli_test(NAME what_became_worse_counts_again SETUP "${accept_as_milder}" ARGS check ${part} ${run} --tool none --accepted ok.json --fail-on visible EXIT 1
  STDERR "warning: defect 1 was accepted as visible and is distinct now: it counts")
clsurf_cli_test(NAME unknown_fingerprint_is_said SETUP "echo '{\"clsurf_accepted\": 1, \"defects\": [{\"fingerprint\": \"feed_drop/speed/99/0/0/0\", \"finding\": \"Pass 99 runs slower\"}]}' > ok.json" ARGS check ${part} ${run} --tool none --accepted ok.json
  STDERR "ok.json: warning: no defect has the fingerprint feed_drop/speed/99/0/0/0 .Pass 99 runs slower.")
set(hint_of_accepted "hint: save it from the page")
set(head_of_accepted "echo '{\"clsurf_accepted\": 1, \"defects\": [")
clsurf_cli_test(NAME accepted_no_json SETUP "echo '{' > ok.json" ARGS check ${part} ${run} --tool none --accepted ok.json EXIT 3 STDERR "ok.json: error: is not valid JSON" "${hint_of_accepted}")
clsurf_cli_test(NAME accepted_no_file_of_ours SETUP "echo '{}' > ok.json" ARGS check ${part} ${run} --tool none --accepted ok.json EXIT 3 STDERR "ok.json: error: is not a file of accepted defects" "${hint_of_accepted}")
clsurf_cli_test(NAME accepted_no_list SETUP "echo '{\"clsurf_accepted\": 1}' > ok.json" ARGS check ${part} ${run} --tool none --accepted ok.json EXIT 3 STDERR "ok.json: error: has no list" "${hint_of_accepted}")
clsurf_cli_test(NAME accepted_another_version SETUP "echo '{\"clsurf_accepted\": 2}' > ok.json" ARGS check ${part} ${run} --tool none --accepted ok.json EXIT 3 STDERR "ok.json: error: .*another version" "${hint_of_accepted}")
clsurf_cli_test(NAME accepted_no_fingerprint SETUP "${head_of_accepted}{}]}' > ok.json" ARGS check ${part} ${run} --tool none --accepted ok.json EXIT 3 STDERR "ok.json: error: defect 1 of the list has no 'fingerprint'" "${hint_of_accepted}")
clsurf_cli_test(NAME accepted_no_number SETUP "${head_of_accepted}{\"fingerprint\": \"a\", \"severity\": \"high\"}]}' > ok.json" ARGS check ${part} ${run} --tool none --accepted ok.json EXIT 3 STDERR "ok.json: error: defect 1 of the list: 'severity' must be a whole number" "${hint_of_accepted}")
clsurf_cli_test(NAME accepted_twice SETUP "${head_of_accepted}{\"fingerprint\": \"a\"}, {\"fingerprint\": \"a\"}]}' > ok.json" ARGS check ${part} ${run} --tool none --accepted ok.json EXIT 3 STDERR "ok.json: error: fingerprint 'a' appears twice" "${hint_of_accepted}")
clsurf_cli_test(NAME accepted_many SETUP "python3 -c 'import json; print(json.dumps({\"clsurf_accepted\": 1, \"defects\": [{\"fingerprint\": str(k), \"accepted\": True, \"severity\": 1, \"comment\": \"\", \"finding\": \"\"} for k in range(3000)]}))' > ok.json" ARGS check ${part} ${run} --tool none --accepted ok.json STDERR "no defect has the fingerprint")
clsurf_cli_test(NAME report_begins_with_accepted SETUP "${accept_two} && $CLSURF report ${part} ${run} --tool none --accepted ok.json -o page.html -q && grep -q '1[0-9], 2 accepted' page.html && grep -q 'accepted: polished by hand' page.html" ARGS --version)
