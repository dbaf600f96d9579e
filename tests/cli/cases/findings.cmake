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
  EXIT 5 STDOUT "NOT JUDGED: No pass has another pass beside it" NO_STDOUT "nan" " held")
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
  STDOUT "^ *no .* 1 +3 point_spacing .* 2 +3 point_spacing .* 3 +3 point_spacing .* 4 +[34] point_spacing .* 5 +[34] point_spacing .* 6 +3 lag_step ")
clsurf_cli_test(NAME findings_in_falling_order_in_json
  SETUP "$CLSURF check ${part} ${run} --json | awk '/\"expected\":/ {exit} {print}' > found && grep -oE '\"score\": [0-9.]+' found | cut -d' ' -f2 > scores && test -s scores && sort -rgc scores && grep -oE '\"rank\": [0-9]+' found | cut -d' ' -f2 > ranks && sort -gc ranks && test $(wc -l < scores) = $(tail -1 ranks) && test $(grep -c '\"systematic\": true' found) = 1"
  ARGS --version)
