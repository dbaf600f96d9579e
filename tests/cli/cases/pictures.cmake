# The content of pictures, and their comparison.

set(bottle @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip)
set(draw "cp @LOGS@/bottle_uneven.biip renamed.biip; $CLSURF render @DATA@/programs/bottle_uneven.nc renamed.biip -q -o renamed.png --size 640x480; $CLSURF render @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip -q -o map.png --size 640x480")

clsurf_cli_test(NAME compare_sees_another_name SETUP "${draw}" ARGS compare renamed.png map.png EXIT 1 STDOUT "^different: ")
set(drawn "cp @AFTER@/renamed.biip @AFTER@/renamed.png @AFTER@/map.png .")
clsurf_cli_test(NAME compare_ignores_text AFTER compare_sees_another_name SETUP "${drawn}" ARGS compare renamed.png map.png --ignore-text STDOUT "^equal: 0 pixels")
clsurf_cli_test(NAME compare_ignores_no_more_than_text AFTER compare_sees_another_name
  SETUP "${drawn}; $CLSURF render @DATA@/programs/bottle_uneven.nc renamed.biip -q -o other.png --size 640x480 --color height"
  ARGS compare other.png map.png --ignore-text EXIT 1 STDOUT "^different: ")
clsurf_cli_test(NAME compare_ignore_text_needs_to_know_it AFTER compare_sees_another_name
  SETUP "${drawn}; $CLSURF render @DATA@/programs/bottle_uneven.nc renamed.biip -q -o bare.png --size 640x480 --no-legend"
  ARGS compare bare.png map.png --ignore-text EXIT 3 STDERR "bare.png" "does not say where its texts are")
clsurf_cli_test(NAME compare_draws_differences AFTER compare_sees_another_name SETUP "${drawn}" ARGS compare renamed.png map.png --diff difference.png EXIT 1)

# The default field, or the speed if a range of numbers is given.
clsurf_cli_test(NAME render_default_is_the_share_of_the_feed
  SETUP "$CLSURF render @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip -o map.png --size 320x240 -q && grep -q 'feed_share 0 to 100 %' map.png" ARGS --version)
clsurf_cli_test(NAME render_range_in_mm_min
  SETUP "$CLSURF render @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip -o map.png --size 320x240 --range 500,3000 -q && grep -q 'speed 500 to 3000 mm/min' map.png" ARGS --version)
clsurf_cli_test(NAME render_without_feeds_shows_speed
  SETUP "sed 's/F[0-9.]*//' @DATA@/programs/bottle_uneven.nc > nofeed.nc; $CLSURF render nofeed.nc @LOGS@/bottle_uneven.biip -o map.png --size 320x240 --force -q && grep -q ': speed ' map.png" ARGS --version)
clsurf_cli_test(NAME render_feed_share_needs_feeds
  SETUP "sed 's/F[0-9.]*//' @DATA@/programs/bottle_uneven.nc > nofeed.nc"
  ARGS render nofeed.nc @LOGS@/bottle_uneven.biip -o map.png --color feed_share --force EXIT 2 STDERR "needs a program with feeds")

# Names are not numbers.
clsurf_cli_test(NAME render_classes
  SETUP "$CLSURF render @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip -o map.png --size 320x240 --color cause -q && grep -q ': cause' map.png" ARGS --version)
foreach(option "--range;0,3" "--bins;4" "--colormap;viridis")
  list(GET option 0 word)
  string(REPLACE "--" "" name ${word})
  clsurf_cli_test(NAME render_classes_have_no_${name} ARGS render ${bottle} -o map.png --color cause ${option} EXIT 2 STDERR "${word} does not apply to 'cause'")
endforeach()
clsurf_cli_test(NAME render_lines_of_two_logs ARGS render ${bottle} -o map.png --color line --before @LOGS@/bottle_uneven.biip EXIT 2
  STDERR "--before does not apply to 'line'")

# A field that the log cannot have: the message says which logs have it.
clsurf_cli_test(NAME render_limit_of_a_recorded_log ARGS render ${bottle} -o map.png --color limit EXIT 2
  STDERR "unknown field 'limit'" "leave out the log and give --machine FILE" "acceleration_share")
clsurf_cli_test(NAME render_channel_that_is_not_there ARGS render ${bottle} -o map.png --color spindle.load EXIT 2
  STDERR "a channel that this log does not have")

# Why the tool is slow, in words.
clsurf_cli_test(NAME query_says_why_it_is_slow ARGS query ${bottle} --line 1200 STDOUT "slow: [0-9]+ of F3000 mm/min: blocks of 0[.]02 mm")
clsurf_cli_test(NAME query_json_says_why ARGS query ${bottle} --line 1200 --json STDOUT "\"feed_mm_min\": 3000" "\"slow_because\": .*blocks of 0[.]02 mm")
clsurf_cli_test(NAME query_says_that_nothing_explains_it ARGS query @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip --line 2267
  STDOUT "slow: 2[0-9]+ of F[0-9]+ mm/min: nothing in program and log explains it: a ramp, a feed override or a feed hold")
clsurf_cli_test(NAME query_at_the_feed_gives_no_reason ARGS query ${bottle} --point 5200 NO_STDOUT "slow:")
clsurf_cli_test(NAME query_names_the_limit_of_a_simulated_log
  SETUP "$CLSURF simulate @DATA@/programs/bottle_uneven.nc --machine @DATA@/machines/three_axis_mill.toml -o run.biip"
  ARGS query @DATA@/programs/bottle_uneven.nc run.biip --line 1260 STDOUT "limited by: ")

# The card of a defect.
clsurf_cli_test(NAME plot_defect ARGS plot ${bottle} --tool none --defect 1 -o card.png --size 800x380 FILE card.png)
clsurf_cli_test(NAME plot_defect_with_a_tool
  SETUP "$CLSURF plot @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --tool ball:6 --defect 1 -o card.svg -q && python3 ${CMAKE_CURRENT_LIST_DIR}/../read_svg.py card.svg images 1 'contact X' 'formed [0-9.]+ µm (deep|high)' '^feed$' '^[0-9.]+ mm$' '^X$'"
  ARGS plot ${bottle} --tool ball:6 -o curve.png EXIT 2 STDERR "--tool needs --profile or --defect")
clsurf_cli_test(NAME plot_defect_without_a_tool SETUP "$CLSURF plot @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --tool none --defect 1 -o card.svg -q && grep -q 'tool tip X' card.svg" ARGS --version)
clsurf_cli_test(NAME plot_defect_of_a_region ARGS plot ${bottle} --tool none --defect 6 -o card.png --size 800x380 FILE card.png)
# The sentence of a systematic lag is wider than the card: it is complete on two lines.
clsurf_cli_test(NAME plot_defect_wraps_its_sentence
  SETUP "$CLSURF plot @DATA@/programs/bottle_zigzag.nc @LOGS@/bottle_zigzag.biip --defect 1 -o card.svg -q && python3 ${CMAKE_CURRENT_LIST_DIR}/../read_svg.py card.svg images 1 '^Axes lag, forward against backward: .* Z differ .Z trails X by [0-9.]* ms. · contact X' ' · bottle_zigzag.nc · bottle_zigzag.biip$' && ! grep -q '…' card.svg"
  ARGS --version)
clsurf_cli_test(NAME plot_defect_that_is_none ARGS plot ${bottle} --tool none --defect 99 -o card.png EXIT 2 STDERR "there are only 15 defects")
clsurf_cli_test(NAME plot_defect_is_no_curve ARGS plot ${bottle} --defect 1 --fields speed -o card.png EXIT 2 STDERR "--fields does not apply to --defect")
clsurf_cli_test(NAME plot_defect_needs_the_program ARGS plot @LOGS@/bottle_uneven.biip --defect 1 -o card.png EXIT 2 STDERR "--defect needs the program")

# Without a log: the simulation, or the program itself.
set(bottle_nc @DATA@/programs/bottle_uneven.nc)
clsurf_cli_test(NAME render_program_simulates
  SETUP "$CLSURF render @DATA@/programs/bottle_uneven.nc -o map.png --size 320x240 -q && grep -q 'simulated on the default machine: feed_share 0 to 100 %' map.png" ARGS --version)
clsurf_cli_test(NAME render_program_names_the_machine
  SETUP "$CLSURF render @DATA@/programs/bottle_uneven.nc --machine @DATA@/machines/linuxcnc_kernel.toml --color jerk -o map.png --size 320x240 -q && grep -q 'simulated on \"[^\"]*\": jerk' map.png" ARGS --version)
foreach(field block_length turning_angle programmed_curvature programmed_feed)
  clsurf_cli_test(NAME render_program_${field}
    SETUP "$CLSURF render @DATA@/programs/bottle_uneven.nc --color ${field} -o map.png --size 320x240 -q && grep -q 'as programmed: ${field} ' map.png" ARGS --version)
endforeach()
# Passes over a plane, 0.4 mm apart: 3 - sqrt(9 - 0.04) mm under a ball of 6 mm; with one of 0.3 mm, 9 gaps of 0.1 mm by 20 mm
# are not cut.
set(plane_nc "awk 'BEGIN { print \"G21 G90\\nG0 X0 Y0 Z10\\nG1 Z0 F1000\\nG1 F3000\"; for (k = 0; k < 10; ++k) printf \"X%d Y%.1f\\nX%d\\n\", k % 2 * 20, 0.4 * k, (1 - k % 2) * 20; print \"G0 Z10\\nM2\" }' > plane.nc")
clsurf_cli_test(NAME render_program_scallop
  SETUP "${plane_nc} && $CLSURF render plane.nc --color scallop --tool ball:6 -o map.svg -q && python3 ${CMAKE_CURRENT_LIST_DIR}/../read_svg.py map.svg images 1 'scallop 50 % 6.67, 95 % 6.67, at most 6.67 µm; uncut 0 mm²' && $CLSURF render plane.nc --color scallop --tool ball:0.3 -o gaps.svg -q && python3 ${CMAKE_CURRENT_LIST_DIR}/../read_svg.py gaps.svg images 1 'at most 150.00 µm; uncut 1[78][.0-9]* mm²'"
  ARGS --version)
clsurf_cli_test(NAME render_program_scallop_of_no_tool SETUP "${plane_nc}" ARGS render plane.nc --color scallop -o map.png EXIT 2 STDERR "'scallop' needs to know the tool" NO_FILE map.png)
clsurf_cli_test(NAME render_program_scallop_of_a_flat_tool SETUP "${plane_nc}" ARGS render plane.nc --color scallop --tool flat:6 -o map.png EXIT 2 STDERR "scallops are computed for ball-end tools, not for" NO_FILE map.png)
clsurf_cli_test(NAME render_program_formed ARGS render ${bottle_nc} --surface formed --tool ball:6 --size 320x240 -o map.png FILE map.png)
clsurf_cli_test(NAME render_log_alone ARGS render @LOGS@/bottle_uneven.biip --color speed --size 320x240 -o map.png FILE map.png)
clsurf_cli_test(NAME render_program_before ARGS render ${bottle_nc} --before @LOGS@/bottle_uneven.biip -o map.png EXIT 2 STDERR "--before compares logs")
clsurf_cli_test(NAME render_program_has_no_offset ARGS render ${bottle_nc} --work-offset 1,2,3 -o map.png EXIT 2 STDERR "the program's own work offsets count")
clsurf_cli_test(NAME render_program_has_no_offset_on_three_axes
  ARGS render ${bottle_nc} --machine @DATA@/machines/three_axis_mill.toml --work-offset 1,2,3 -o map.png EXIT 2 STDERR "the program's own work offsets count" NO_FILE map.png)
clsurf_cli_test(NAME render_program_field_has_no_offset
  ARGS render ${bottle_nc} --color block_length --work-offset 1,2,3 -o map.png EXIT 2 STDERR "'block_length' is drawn in the coordinates of the program" NO_FILE map.png)
clsurf_cli_test(NAME render_program_without_motions SETUP "echo '(nothing)' > empty.nc" ARGS render empty.nc --color block_length -o map.png EXIT 3 STDERR "empty.nc: error: has no motions to show" NO_FILE map.png)

# The programmed path below a log: one line for each of ten passes and their links, except outside the picture.
clsurf_cli_test(NAME render_programmed
  SETUP "${plane_nc} && $CLSURF simulate plane.nc -o run.biip -q && $CLSURF render plane.nc run.biip -o bare.svg -q && $CLSURF render plane.nc run.biip --programmed -o lines.svg -q && python3 ${CMAKE_CURRENT_LIST_DIR}/../read_svg.py lines.svg images 1 'thin lines: the programmed path' && test $(grep -o '#464646' lines.svg | wc -l) -ge 1 && ! grep -q '#464646' bare.svg"
  ARGS --version)
clsurf_cli_test(NAME render_programmed_from_standard_input
  SETUP "${plane_nc} && $CLSURF simulate plane.nc -o run.biip -q && ! $CLSURF render - run.biip --programmed -o map.png < plane.nc 2> said.txt && grep -q -e '--programmed: the program came from standard input' said.txt"
  ARGS --version)

# A selection of the part.
clsurf_cli_test(NAME render_passes
  SETUP "$CLSURF render @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --passes 3..5 -o map.png --size 320x240 -q" ARGS --version)
clsurf_cli_test(NAME render_points_are_counted
  SETUP "$CLSURF render @DATA@/programs/dome_loops.nc @LOGS@/dome_loops.biip --points 5000..5200 -o map.svg -q && python3 ${CMAKE_CURRENT_LIST_DIR}/../read_svg.py map.svg images 1 ' · 201 of 18531 points, 1 pass' && $CLSURF render @DATA@/programs/dome_loops.nc @LOGS@/dome_loops.biip -o whole.svg -q && python3 ${CMAKE_CURRENT_LIST_DIR}/../read_svg.py whole.svg images 1 ' · 18531 points, '"
  ARGS --version)
clsurf_cli_test(NAME render_lines_and_points ARGS render ${bottle} --lines 1000.. --points ..20000 --size 320x240 -o map.png FILE map.png)
clsurf_cli_test(NAME render_lines_that_cut_nothing ARGS render ${bottle} --lines 1..2 -o map.png EXIT 2 STDERR "no finishing pass lies in lines 1[.][.]2" NO_FILE map.png)
clsurf_cli_test(NAME render_passes_out_of_order ARGS render ${bottle} --passes 5..3 -o map.png EXIT 2 STDERR "--passes: '5[.][.]3' ends before it begins")
clsurf_cli_test(NAME render_passes_count_from_one ARGS render ${bottle} --passes 0..3 -o map.png EXIT 2 STDERR "--passes: they are counted from 1")
clsurf_cli_test(NAME render_points_no_range ARGS render ${bottle} --points a..b -o map.png EXIT 2 STDERR "'a[.][.]b' is not a range of whole numbers")
clsurf_cli_test(NAME render_points_of_defects ARGS render ${bottle} --passes 3..5 --defects -o map.png EXIT 2 STDERR "do not apply to --defects")
