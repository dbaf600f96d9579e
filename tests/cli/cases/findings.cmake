# What `check` and `report` say of findings: verdict, order, numbers, words.

# ---- no verdict where too little could be compared ----
# Forty passes of 0.5 mm: all of them are ends, nothing is compared.
set(short_passes "(printf 'G21 G90 G54\\nG0 X0 Y0 Z5\\nG1 Z0 F600\\n' && seq 0 2 38 | awk '{printf \"G1 Y%.1f\\nX0.5\\nY%.1f\\nX0\\n\", $1/5, ($1+1)/5}' && echo M30) > part.nc"
  "$CLSURF simulate part.nc -o run.biip > /dev/null")
set(one_pass "printf 'G21 G90 G54\\nG0 X0 Y0 Z5\\nG1 Z0 F600\\nX30\\nM30\\n' > part.nc" "$CLSURF simulate part.nc -o run.biip > /dev/null")
list(JOIN short_passes " && " short_passes)
list(JOIN one_pass " && " one_pass)
set(depth_budget "echo 'max_depth_um = 5' > budget.toml")

clsurf_cli_test(NAME short_passes_are_not_judged SETUP "${short_passes} && ${depth_budget}" ARGS check part.nc run.biip --budget budget.toml
  EXIT 5 STDOUT "^NOT JUDGED: Only 0[.]0 % of [0-9]+ cutting points" "max_depth_um .* NOT JUDGED" NO_STDOUT "nan" " held" STDERR "warning: not judged: Only")
clsurf_cli_test(NAME one_pass_is_not_judged SETUP "${one_pass} && ${depth_budget}" ARGS check part.nc run.biip --budget budget.toml
  EXIT 5 STDOUT "NOT JUDGED: No pass has an adjacent pass" NO_STDOUT "nan" " held")
clsurf_cli_test(NAME not_judged_in_json SETUP "${short_passes}" ARGS check part.nc run.biip --json
  EXIT 5 STDOUT "\"judged\": false" "\"within_budget\": false" "\"coverage_percent\": 0" "\"not_judged_reasons\": .*Only 0[.]0 %" NO_STDOUT "nan" "NaN")
clsurf_cli_test(NAME not_judged_in_sarif SETUP "${short_passes}" ARGS check part.nc run.biip --format sarif
  EXIT 5 STDOUT "\"toolExecutionNotifications\": .*Not judged" "\"ruleId\": \"not_judged\"" NO_STDOUT "nan")
clsurf_cli_test(NAME not_judged_on_the_page
  SETUP "${short_passes} && $CLSURF report part.nc run.biip -o page.html 2> /dev/null && grep -q 'class=.not-judged. role=.alert.><b>Not judged' page.html && (! grep -q 'speed nan' page.html)"
  ARGS check part.nc run.biip EXIT 5 FILE page.html)
clsurf_cli_test(NAME judged_in_json ARGS check ${part} ${run} --json STDOUT "\"judged\": true" "\"not_judged_reasons\": ..,")

# ---- order: what stands farthest out comes first ----
# The five slow passes of the sample part, and then the lag of all passes as one finding.
clsurf_cli_test(NAME slow_passes_come_first ARGS check ${part} ${run}
  STDOUT "1 distinct point_spacing .* 2 distinct point_spacing .* 3 distinct point_spacing .* 4 [dr][a-z]+ +point_spacing .* 5 [dr][a-z]+ +point_spacing .* 6 distinct lag_step .*±")
clsurf_cli_test(NAME findings_in_falling_order_in_json
  SETUP "$CLSURF check ${part} ${run} --json | awk '/\"expected\":/ {exit} {print}' > found && grep -oE '\"score\": [0-9.]+' found | cut -d' ' -f2 > scores && test -s scores && sort -rgc scores && grep -oE '\"rank\": [0-9]+' found | cut -d' ' -f2 > ranks && sort -gc ranks && test $(wc -l < scores) = $(tail -1 ranks) && test $(grep -c '\"systematic\": true' found) = 1"
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
# 2.9999999329447746 is a float in a double's clothes.
clsurf_cli_test(NAME json_has_as_many_digits_as_mean_something SETUP "$CLSURF check ${part} ${run} --tool ball:6 --json > report.json && (! grep -E '[.][0-9]{6}' report.json) && grep -q '\"speed_percent\": 3.0' report.json" ARGS --version)
clsurf_cli_test(NAME slower_is_negative_everywhere
  SETUP "$CLSURF check ${part} ${run} --json | grep -E 'speed_jump_(mm_min|percent)' | sed -n 1,2p > first && test $(grep -c ': -[0-9]' first) = 2 && $CLSURF check ${part} ${run} --format csv | sed -n 2p | cut -d, -f14,19 | grep -qE '^-[0-9.]+,-[0-9.]+$'"
  ARGS --version)
clsurf_cli_test(NAME sarif_speaks_in_sentences ARGS check ${part} ${run} --format sarif
  STDOUT "\"text\": \"Pass [0-9]+ runs 8[0-9] % slower than its neighbours" "\"markdown\"" "\"clsurfDefect/v1\": \"point_spacing/speed/14/" "\"help\"" "\"level\": \"error\"" "\"level\": \"warning\"" "\"ruleId\": \"systematic_lag\"")
