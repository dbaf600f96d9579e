# Repaired programs.

set(uneven @DATA@/programs/bottle_uneven.nc)
# Six passes, the fourth of which has fifty points in a millimetre.
set(crowded "awk 'BEGIN { print \"G21 G90\\nG64 P0.005\\nG0 X0 Y0 Z10\\nG1 Z0 F1000\\nG1 F3000\"; for (k = 0; k < 6; ++k) for (w = 0; w < 9.01; w += k == 3 && w > 3 && w < 4 ? 0.02 : 0.25) { x = k % 2 ? 9 - w : w; printf \"X%.3f Y%.3f Z%.3f\\n\", x, 0.4 * k, 0.5 * sin(0.8 * x) } print \"G0 Z10\\nM2\" }' > part.nc")
clsurf_cli_test(NAME optimize_says_what_it_tries SETUP "${crowded}" ARGS optimize part.nc --machine @DATA@/machines/linuxcnc_logs.toml -o better.nc --progress always
  STDERR "candidate [0-9]+, best: gain [0-9]+ %, [0-9]+ defects, [0-9.]+ s" FILE better.nc)
clsurf_cli_test(NAME optimize_draws_svg SETUP "${crowded} && $CLSURF optimize part.nc --machine @DATA@/machines/linuxcnc_logs.toml -o better.nc --picture better.svg -q && python3 ${CMAKE_CURRENT_LIST_DIR}/../read_svg.py better.svg images 2 'Path speed before and after' 'Speed difference to the adjacent pass' 'after: [0-9.]+ s'" ARGS --version)
clsurf_cli_test(NAME optimize_accepts_what_is_better SETUP "${crowded}" ARGS optimize part.nc --machine @DATA@/machines/linuxcnc_logs.toml --json -o better.nc
  STDOUT "\"accepted\": true" "\"deviation_mm\": 0.00[0-4]" "\"lines_before\": 263" "\"defects_by_quantity\"" "\"defects_left\"" FILE better.nc)
# The promised defects are those that check finds in a simulation of the new program: each run has its own thresholds. (The
# part is small: exit code 5.)
clsurf_cli_test(NAME optimize_counts_defects_as_check_does
  SETUP "${crowded}; $CLSURF optimize part.nc --machine @DATA@/machines/linuxcnc_logs.toml --json -o better.nc > promised.json; for part in part better; do $CLSURF simulate $part.nc --machine @DATA@/machines/linuxcnc_logs.toml -o $part.biip -q; $CLSURF check $part.nc $part.biip --tool none --json > $part.json || test $? = 5; done; python3 -c \"import json; read = lambda name: json.load(open(name + '.json')); promised = read('promised'); assert [promised['defects_before'], promised['defects_after']] == [len(read(part)['defects']) for part in ('part', 'better')], promised\""
  ARGS --version)
clsurf_cli_test(NAME optimize_tells_what_defects_show_in SETUP "${crowded}" ARGS optimize part.nc --machine @DATA@/machines/linuxcnc_logs.toml -o better.nc
  STDOUT "defects +4 +[0-3] " "  of speed +1 +0 " "  of lag +3 +[0-3] " "accepted")
# 0.5 mm apart: at 0.4 mm a filter of 0.8 mm removes most of the roughness of this part of 2 mm.
string(REPLACE "0.4 * k" "0.5 * k" wider "${crowded}")
clsurf_cli_test(NAME optimize_measures_the_roughness SETUP "${wider}" ARGS optimize part.nc --machine @DATA@/machines/linuxcnc_logs.toml --tool ball:6 -o better.nc
  STDOUT "roughness Ra .µm.  *[0-9.]+  *[0-9.]+ " "roughness Rz .µm.  *[0-9.]+  *[0-9.]+ " "  added by the machine, Sq .µm.  *[0-9.]+  *[0-9.]+ " FILE better.nc)
clsurf_cli_test(NAME optimize_roughness_json SETUP "${wider}" ARGS optimize part.nc --machine @DATA@/machines/linuxcnc_logs.toml --tool ball:6 --json -o better.nc
  STDOUT "\"roughness_before\":" "\"roughness_after\":" "\"ra_um\": [0-9.]+" "\"machine_sq_um\": [0-9.]+" FILE better.nc)
clsurf_cli_test(NAME optimize_without_tool_has_no_roughness SETUP "${crowded}" ARGS optimize part.nc --machine @DATA@/machines/linuxcnc_logs.toml --json -o better.nc
  STDOUT "\"roughness_before\": null" FILE better.nc)
clsurf_cli_test(NAME optimize_starts_from_a_log SETUP "${crowded}; $CLSURF simulate part.nc --machine @DATA@/machines/linuxcnc_logs.toml -o run.biip" ARGS optimize part.nc --log run.biip --machine @DATA@/machines/linuxcnc_logs.toml --json -o better.nc
  STDOUT "\"accepted\": true" "\"proof\": \"simulation\"" "\"motions_in_need\": [1-9]" FILE better.nc)
# The same passes with a rotating tool axis, on a five-axis machine whose planning is fast.
set(crowded5 "sed 's/max_jerk = .*/max_jerk = 1e7/; s/^period.*/&\\nblock_time = 0.003/' @DATA@/machines/five_axis_trunnion.toml > m.toml && awk 'BEGIN { print \"G21 G90\\nG64 P0.005\\nG43.4 H1\\nG0 X0 Y0 Z10 A-15 C90\\nG1 Z0 F1000\\nG1 F3000\"; for (k = 0; k < 5; ++k) for (w = 0; w < 6.01; w += k == 2 && w > 2 && w < 3 ? 0.02 : 0.25) { x = k % 2 ? 6 - w : w; printf \"X%.3f Y%.3f Z%.3f A%.3f C%.3f\\n\", x, 0.4 * k, 0.2 * sin(0.8 * x), -15 - 0.2 * x, 90 + 0.5 * x } print \"G49\\nG0 Z10\\nM2\" }' > part.nc")
clsurf_cli_test(NAME optimize_five_axes SETUP "${crowded5}" ARGS optimize part.nc --machine m.toml --work-offset 5,0,10 --json -o better.nc
  STDOUT "\"accepted\": true" "\"deviation_mm\": 0.00[0-4]" "\"defects_before\": [1-9]" "\"defects_after\": 0" "\"tool_axis_deviation_deg\": 0.00" FILE better.nc)
# Rapids, codes and comments are kept, every line has its angles, and the last one is at the end of the passes.
clsurf_cli_test(NAME optimize_five_axes_keeps_the_rest
  SETUP "${crowded5} && $CLSURF optimize part.nc --machine m.toml -o better.nc | grep -q 'tool axis deviates from the programmed one by at most 0.00[0-9]* deg' && grep -v '^X' part.nc > kept && grep -v '^X\\|clsurf' better.nc | sed 's/^F[0-9.]*$//; /^$/d' | cmp - kept && test $(grep -c '^X.* A.* C' better.nc) -eq $(grep -c '^X' better.nc)"
  ARGS moves better.nc --machine m.toml STDOUT "feed,6,0,-0.199,-16.2,0,93,")
clsurf_cli_test(NAME optimize_five_axes_from_a_log SETUP "${crowded5} && $CLSURF simulate part.nc --machine m.toml --work-offset 5,0,10 -o run.biip -q"
  ARGS optimize part.nc --log run.biip --machine m.toml --json -o better.nc STDOUT "\"accepted\": true" "\"motions_in_need\": [1-9]" FILE better.nc)
clsurf_cli_test(NAME check_five_axes_without_the_machine SETUP "${crowded5} && $CLSURF simulate part.nc --machine m.toml --work-offset 5,0,10 -o run.biip -q"
  ARGS check part.nc run.biip EXIT 3 STDERR "% of its points lie off their lines" "hint: --machine FILE gives the kinematics")
clsurf_cli_test(NAME optimize_five_axes_refuses SETUP "${crowded5}; sed -i 's/^X.*/& (KEEP)/' part.nc" ARGS optimize part.nc --machine m.toml -o better.nc
  EXIT 1 STDOUT "refused: no section of the program can be rewritten" "tool axis deviates from the programmed one by at most 0.0000 deg" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_five_axes_on_three SETUP "${crowded5}" ARGS optimize part.nc --machine @DATA@/machines/three_axis_mill.toml -o better.nc
  EXIT 3 STDERR "part.nc:4: error: a rotary axis moves" "hint: --machine FILE with rotary axes" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_work_offset_of_three_axes ARGS optimize ${uneven} --work-offset 1,2,3 -o better.nc EXIT 2 STDERR "--work-offset needs --log, or a program that moves rotary axes" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_log_options_without_a_log ARGS optimize ${uneven} --period 0.001 -o better.nc EXIT 2 STDERR "--period needs --log" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_wrong_time ARGS optimize ${uneven} --more-time -3 -o better.nc EXIT 2 STDERR "--more-time must be 0 to 100 %" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_wrong_decimals ARGS optimize ${uneven} --decimals 12 -o better.nc EXIT 2 STDERR "--decimals must be 0 to 9" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_refuses_what_is_not SETUP "printf 'G21 G90\nG0 X0 Y0 Z0\nG1 X10 F600 (A)\nY0.3 (B)\nX0 (C)\nY0.6 (D)\nX10 (E)\nY0.9 (F)\nX0 (G)\nM2\n' > a.nc"
  ARGS optimize a.nc -o better.nc EXIT 1 STDOUT "refused: no section" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_single_pass SETUP "printf 'G0 X0 Y0 Z0\nG1 X10 F600\nX20\nM2\n' > a.nc" ARGS optimize a.nc -o better.nc EXIT 3 STDERR "no adjacent passes" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_without_output ARGS optimize ${uneven} EXIT 2 STDERR "output")
clsurf_cli_test(NAME optimize_wrong_tolerance ARGS optimize ${uneven} -o better.nc --tolerance -1 EXIT 2 STDERR "--tolerance must be above 0 mm" NO_FILE better.nc)
