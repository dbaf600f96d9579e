# Runs on five axes are compared by the tool tip.

set(dome @DATA@/programs/dome_five_axis.nc)
set(trunnion --machine @DATA@/machines/five_axis_trunnion.toml)
string(REPLACE ";" " " trunnion_words "${trunnion}")
# The same part clamped elsewhere: its axes move differently, its tip does not.
set(clamped_elsewhere "$CLSURF simulate ${dome} ${trunnion_words} --work-offset 10,20,30 -o here.biip -q && $CLSURF simulate ${dome} ${trunnion_words} --work-offset -40,5,60 -o there.biip -q")
clsurf_cli_test(NAME diff_lays_tips_onto_each_other SETUP "${clamped_elsewhere}"
  ARGS diff here.biip there.biip ${trunnion} STDOUT "(100[.]0|9[0-9][.][0-9]) % of")
set(same_clamped_elsewhere "cp @AFTER@/here.biip @AFTER@/there.biip .")
clsurf_cli_test(NAME diff_lays_a_simulated_program_onto_its_log AFTER diff_lays_tips_onto_each_other SETUP "${same_clamped_elsewhere}"
  ARGS diff ${dome} here.biip ${trunnion} --work-offset 10,20,30 STDOUT "100[.]0 % of")
clsurf_cli_test(NAME diff_warns_of_rotary_axes_without_a_machine AFTER diff_lays_tips_onto_each_other SETUP "${same_clamped_elsewhere}"
  ARGS diff here.biip here.biip STDERR "here.biip: warning: axis a moves by")
clsurf_cli_test(NAME diff_knows_the_lines_of_a_program_on_five_axes AFTER diff_lays_tips_onto_each_other SETUP "${same_clamped_elsewhere}"
  ARGS diff here.biip there.biip ${trunnion} --program ${dome} STDOUT "(100[.]0|9[0-9][.][0-9]) % of")

# Passes of a ball of 6 mm over a plane, 0.4 mm apart: scallops of 3 - sqrt(9 - 0.04) = 6.67 um with an Sa of 4 / (9 sqrt 3)
# of that, 1.71 um; a filter of 0.8 mm leaves 1 - 2^-4 of their first wave. In the other program every second pass is 6 um
# lower: waves of 0.8 mm, of which the filter
# leaves half. NumPy, from the envelope of the circles: Ra 1.73 and Sa 2.79 um. Both runs have the cut-off of the first one.
set(deeper "awk 'BEGIN { for (n = 0; n < 2; ++n) { f = n ? \"deeper.nc\" : \"even.nc\"; print \"G21 G90\\nG0 X0 Y0 Z10\\nG1 Z0 F1000\\nG1 F3000\" > f; for (k = 0; k < 60; ++k) printf \"X%d Y%.1f Z%.3f\\nX%d\\n\", k % 2 * 20, 0.4 * k, n * (k % 2) * -0.006, (1 - k % 2) * 20 > f; print \"G0 Z10\\nM2\" > f } }'")
clsurf_cli_test(NAME diff_roughness SETUP "${deeper}" ARGS diff even.nc deeper.nc --tool ball:6
  STDOUT "roughness Ra .µm.  +1[.]60 +1[.]7[234] " "roughness Sa .µm.  +1[.]7[12] +2[.][78][0-9] ")
clsurf_cli_test(NAME diff_roughness_of_part_of_a_run SETUP "${deeper} && $CLSURF simulate even.nc -o whole.biip -q && $CLSURF export even.nc whole.biip -o whole.csv --columns time,cmd.x,cmd.y,cmd.z && head -n 16000 whole.csv > half.csv"
  ARGS diff whole.biip half.csv --tool ball:6 STDOUT "roughness Ra .µm.  +1[.]60 +1[.]60 +.0[.]0 %" "roughness Sa .µm.  +1[.]7[12] +1[.]7[12] +.0[.][0-9] %")
clsurf_cli_test(NAME diff_without_tool_has_no_roughness SETUP "${deeper}" ARGS diff even.nc deeper.nc --json STDOUT "\"roughness\": null" "\"reference_roughness\": null")
clsurf_cli_test(NAME diff_roughness_json SETUP "${deeper}" ARGS diff even.nc deeper.nc --tool ball:6 --json
  STDOUT "\"roughness\":" "\"ra_um\": 1[.]7[234]" "\"reference_roughness\":" "\"ra_um\": 1[.]60")
clsurf_cli_test(NAME render_before_tells_roughness SETUP "${deeper} && $CLSURF simulate even.nc -o a.biip -q && $CLSURF simulate deeper.nc -o b.biip -q && $CLSURF render even.nc b.biip --before a.biip --tool ball:6 -o map.svg -q && python3 ${CMAKE_CURRENT_LIST_DIR}/../read_svg.py map.svg images 2 'roughness Ra 1.60 to 1.7[234] µm'"
  ARGS --version)
clsurf_cli_test(NAME report_before_tells_roughness SETUP "${deeper} && $CLSURF simulate even.nc -o a.biip -q && $CLSURF simulate deeper.nc -o b.biip -q && $CLSURF report even.nc b.biip --before a.biip --tool ball:6 --fields speed -o r.html -q && grep -q 'roughness Ra .*<td>1.60</td><td>1.7[234]</td>' r.html"
  ARGS --version)

# Options without effect.
foreach(option "dialect fanuc" "tools nofile.tbl" "block-delete on")
  separate_arguments(words UNIX_COMMAND "--${option}")
  string(MAKE_C_IDENTIFIER "${option}" name)
  clsurf_cli_test(NAME diff_of_logs_with_${name} ARGS diff @LOGS@/bottle_uneven.biip @LOGS@/bottle_uneven.biip ${words} EXIT 2 STDERR "error: --[a-z-]* needs a program" "--program FILE")
  clsurf_cli_test(NAME export_of_a_log_with_${name} ARGS export @LOGS@/bottle_uneven.biip ${words} -o run.csv EXIT 2 STDERR "error: --[a-z-]* needs a program" NO_FILE run.csv)
endforeach()
clsurf_cli_test(NAME diff_of_logs_with_a_start ARGS diff @LOGS@/bottle_uneven.biip @LOGS@/bottle_uneven.biip --start 1,2,3 EXIT 2 STDERR "--start needs a program that is simulated")
foreach(option "view top" "bins 5" "style lines" "color lag")
  separate_arguments(words UNIX_COMMAND "--${option}")
  list(GET words 0 name)
  string(REPLACE "--" "" name ${name})
  clsurf_cli_test(NAME diff_without_a_map_with_${name} ARGS diff @LOGS@/bottle_uneven.biip @LOGS@/bottle_uneven.biip ${words} EXIT 2 STDERR "error: --${name} needs a map of the differences" "-o FILE draws it")
endforeach()
