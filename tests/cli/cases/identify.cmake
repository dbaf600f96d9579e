# identify: servo loops from logs of a kernel (LinuxCNC with the gains of data/machines/linuxcnc_logs.toml), from simulated
# ones, and from logs with little information.

set(bottle @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip)
set(dome @DATA@/programs/dome_loops.nc @LOGS@/dome_loops.biip)
clsurf_cli_test(NAME identify_a_kernel ARGS identify ${bottle} ${dome} -o m.toml FILE m.toml
  STDOUT "position_gain +x +(100|99[.]999[0-9]*|100[.]000[0-9]*) 1/s" "position_gain +y +(80|79[.]999[0-9]*|80[.]000[0-9]*) 1/s" "velocity_feedforward +z +0[.](9|900[0-9]*|8999[0-9]*) "
  "velocity_time_constant +z +0[.](004|00400[0-9]*|003999[0-9]*) s"
  "friction +x +0 mm/min +no evidence"
  # The kernel has 200: the criterion takes both as equal, the mean difference of speed does not.
  "not distinguish 150. 200. kept 200 .max_feed_override."
  # Limits: LinuxCNC's are 2000, 2000 and 1500 mm/s² and no jerk. Speeds of the axes x and y stay below theirs.
  "max_acceleration +x +(2000([.]0[0-9]*)?|1999[.]9[0-9]*) mm/s² .*reached. the motion stays at it in [0-9]+ places" "max_acceleration +z +(1500([.]0[0-9]*)?|1499[.]9[0-9]*) mm/s² .*reached"
  "max_jerk +x +0 mm/s³ +no limit seen" "max_speed +x +4[0-9.]+ mm/min +lower bound" "max_speed +z +(9000([.][0-9]*)?|8999[0-9.]*) mm/min .*reached"
  "cross-validation: each run left out of the fit")
# What the keys are does not depend on the runs: a part of the dome, tested on another part of it.
set(two_parts_of_the_dome "(head -n 200 @DATA@/programs/dome_loops.nc; echo M2) > fit.nc; (head -n 9 @DATA@/programs/dome_loops.nc; sed -n 600,800p @DATA@/programs/dome_loops.nc; echo M2) > test.nc; for name in fit test; do $CLSURF simulate $name.nc --machine @DATA@/machines/linuxcnc_kernel.toml -o $name.biip -q; done")
set(json_of_parts identify fit.nc fit.biip -o m.toml --test test.nc test.biip --json)
clsurf_cli_test(NAME identify_json SETUP "${two_parts_of_the_dome}" ARGS ${json_of_parts}
  STDOUT "\"schema_version\"" "\"machine\"" "\"parameters\"" "\"standard_error\"" "\"unidentified\"" "\"runs\"")
# Less than a third of the dome is sufficient, in a fifth of the time.
clsurf_cli_test(NAME identify_friction_and_backlash
  SETUP "(head -n 500 @DATA@/programs/dome_loops.nc; echo M2) > p.nc; printf '[[axis]]\\nname = \"x\"\\n[axis.servo]\\nposition_gain = 70\\nfriction = 90\\n[[axis]]\\nname = \"y\"\\n[axis.servo]\\nbacklash = 0.01\\ndead_time = 0.002\\n' > t.toml; $CLSURF simulate p.nc --machine t.toml -o r.biip"
  ARGS identify p.nc r.biip -o m.toml
  STDOUT "position_gain +x +(70|69[.]9|70[.]0)[0-9]* 1/s" "friction +x +(89[.][89]|90)[0-9.]* mm/min" "backlash +y +0[.]0(1|099|100)[0-9]* mm" "dead_time +y +0[.]00(2|199|200)[0-9]* s")
# Drives with a PI controller of the velocity, computed independently (tests/identify/pi_drive.py): without the integral the
# following error of the other part is off by 4.9 of 25.5 µm (95 %).
clsurf_cli_test(NAME identify_pi_velocity_loops
  SETUP "${two_parts_of_the_dome}; for name in fit test; do $CLSURF export $name.nc $name.biip -o $name.csv --columns time,line,cmd.x,cmd.y,cmd.z -q; /usr/bin/python3 ${PROJECT_SOURCE_DIR}/tests/identify/pi_drive.py $name.csv $name.driven.csv; done"
  ARGS identify fit.nc fit.driven.csv -o m.toml --test test.nc test.driven.csv FILE m.toml
  STDOUT "velocity_integral_time +x +0[.]00[89][0-9]* s .*BIC falls by" "velocity_integral_time +z +0[.]01[45][0-9]* s .*BIC falls by" "test.driven.csv: .*following error 95 % 0[.][0-9]+ of [0-9.]+ µm")
# Each turn of a ball screw moves the table to and fro: no servo loop does that, and none is stated.
clsurf_cli_test(NAME identify_axes_of_another_form
  SETUP "$CLSURF export @DATA@/programs/dome_loops.nc @LOGS@/dome_loops.biip -o cmd.csv --columns time,line,cmd.x,cmd.y,cmd.z -q; awk -F, 'NR == 1 { print \"time,line,cmd.x,cmd.y,cmd.z,fb.x,fb.y,fb.z\"; next } { print $0 \",\" $3 + 0.02 * sin(2.1 * $3) \",\" $4 + 0.02 * sin(2.1 * $4) \",\" $5 + 0.02 * sin(2.1 * $5) }' cmd.csv > screw.csv"
  ARGS identify @DATA@/programs/dome_loops.nc screw.csv -o m.toml
  STDOUT "x: the model explains the axis only to 0.01[0-9]* mm rms: its loop has another form" "x: the loop is not identified .velocity_integral_time, friction, backlash, dead_time"
  NO_STDOUT "position_gain +x +[0-9]")
# Five axes: a part of the dome on a trunnion whose rotary axes have loops and limits of their own. Known is the kinematics; the
# values are those of slow.toml, within a few standard errors. The rules that the simulation of five axes has are searched.
set(slow_trunnion "head -n 160 @DATA@/programs/dome_five_axis.nc > p.nc; echo M30 >> p.nc; awk '/kinematics/ { k = 1 } k' @DATA@/machines/five_axis_trunnion.toml > known.toml; awk '/^name = \"a\"/ { s = \"position_gain = 50\\nfriction = 40\" } /^name = \"c\"/ { s = \"position_gain = 40\\nbacklash = 0.01\\ndead_time = 0.004\" } /^max_acceleration = 3000$/ && s ~ /dead/ { $0 = \"max_acceleration = 1200\" } /^type/ { $0 = $0 \"\\naxis_tolerance = 0.2\" } { print } /servo/ && s { print s; s = \"\" }' @DATA@/machines/five_axis_trunnion.toml > slow.toml; $CLSURF simulate p.nc --machine slow.toml -o r.biip -q")
clsurf_cli_test(NAME identify_five_axes SETUP "${slow_trunnion}"
  ARGS identify p.nc r.biip --machine known.toml -o m.toml FILE m.toml
  STDOUT "position_gain +a +(50|49[.]9|50[.]0)[0-9]* 1/s" "friction +a +(39[.]9|40|40[.]0)[0-9]* deg/min" "position_gain +c +(40|39[.]9|40[.]0)[0-9]* 1/s" "velocity_feedforward +c +0[.]9(8|79|80)"
    "backlash +c +0[.]0(1|099|100)[0-9]* deg" "dead_time +c +0[.]00(4|399|400)[0-9]* s" "max_acceleration +c +(1200|119[6-9])[0-9.]* deg/s² .*reached" "max_speed +path +1[0-9.]+ mm/min" "max_acceleration +path +(300|299|298)[0-9.]+ mm/s²"
    "planner +time-optimal, corner arc .* chosen" "planner +time-optimal, corner stop" "axis_tolerance +0[.]2 .* chosen" "not tried: the simulation of five axes knows the whole path at once .lookahead_blocks")
clsurf_cli_test(NAME identify_five_axes_without_kinematics
  SETUP "$CLSURF simulate @DATA@/programs/dome_five_axis.nc --machine @DATA@/machines/five_axis_trunnion.toml -o r.biip"
  ARGS identify @DATA@/programs/dome_five_axis.nc r.biip --force -o m.toml FILE m.toml
  STDOUT "moves rotary axes, and the kinematics are not known" "position_gain +y " STDERR "axis a is not in the machine file")
# Of a kernel whose blocks overlap: each has half of the acceleration.
clsurf_cli_test(NAME identify_overlapping_blocks ARGS identify @DATA@/programs/tangential_lines.ngc @LOGS@/tangential_lines.parabolic.biip -o m.toml
  STDOUT "trapezoidal, parabolic blends +[-0-9.]+ +[0-9.]+  chosen" "max_acceleration +x +2000 mm/s² .*twice what blocks that overlap keep")
# LinuxCNC with MAX_FEED_OVERRIDE = 2: in percent, as in a machine file.
clsurf_cli_test(NAME identify_feed_override_of_a_kernel ARGS identify @DATA@/programs/dome_loops.nc @LOGS@/dome_loops.biip -o m.toml
  STDOUT "max_feed_override +100 +[-0-9.]+ +2[.][0-9]+" "max_feed_override +200 +[-0-9.]+ +1[.]7[0-9] +chosen")
clsurf_cli_test(NAME identify_limits_of_a_simulation
  SETUP "$CLSURF simulate @DATA@/programs/dome_loops.nc --machine @DATA@/machines/three_axis_mill.toml -o r.biip"
  ARGS identify @DATA@/programs/dome_loops.nc r.biip -o m.toml
  STDOUT "max_acceleration +z +199[0-9.]* mm/s² +lower bound" "max_acceleration +path +(199|200)[0-9.]* mm/s² +[0-9.]+ +reached. the motion shows 1996[0-9.]*. simulations with [0-9.]+ explain the runs less well" "max_jerk +path +(49[789]|500)[0-9.]+ mm/s³ .*reached" "max_jerk +z +(79[67][0-9]+|80000) mm/s³ .*reached"
    "max_jerk +x +(79|80)[0-9]+ mm/s³ .*reached. simulations with"
    "planner +time-optimal, corner (arc|spline) .*chosen")
# Both tests simulate many machines, which takes longer than the usual limit on a slow computer with other work.
set_tests_properties(cli.identify_a_kernel cli.identify_limits_of_a_simulation PROPERTIES TIMEOUT 300)
# The axes have 80000 mm/s³, the path 50000: where the path limits the jerk, it is not attributed to the axes.
clsurf_cli_test(NAME identify_limits_of_the_path
  SETUP "$CLSURF simulate @DATA@/programs/transition_g61.nc --machine @DATA@/machines/three_axis_mill.toml -o r.biip"
  ARGS identify @DATA@/programs/transition_g61.nc r.biip -o m.toml
  STDOUT "max_jerk +path +(499|500)[0-9]+ mm/s³ .*reached" "max_jerk +x +499[0-9]+ mm/s³ +lower bound. hardly exceeded. the file has 80000" "max_jerk +z +499[0-9]+ mm/s³ +lower bound")
# Without feedback positions the loops are unknown.
clsurf_cli_test(NAME identify_without_feedback
  SETUP "$CLSURF export @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --columns time,cmd.x,cmd.y,cmd.z -o r.biip"
  ARGS identify @DATA@/programs/bottle_uneven.nc r.biip -o m.toml FILE m.toml STDOUT "max_acceleration +z" "x: no log has fed-back positions of it .position_gain"
  NO_STDOUT "position_gain +x")
clsurf_cli_test(NAME identify_without_commanded
  SETUP "$CLSURF export @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --columns time,fb.x,fb.y,fb.z -o r.biip"
  ARGS identify @DATA@/programs/bottle_uneven.nc r.biip -o m.toml EXIT 3 NO_FILE m.toml STDERR "nothing can be identified: axis x: no log has commanded positions")
clsurf_cli_test(NAME identify_another_program ARGS identify @DATA@/programs/dome_loops.nc @LOGS@/bottle_uneven.biip -o m.toml EXIT 3 NO_FILE m.toml STDERR "another program|does not belong")
# With --force, loops and limits are found; no rule explains speeds that are not compared, so none is chosen.
clsurf_cli_test(NAME identify_another_program_by_force ARGS identify @DATA@/programs/dome_loops.nc @LOGS@/bottle_uneven.biip --force -o m.toml FILE m.toml
  STDOUT "position_gain +y +(80|79[.]999[0-9]*|80[.]000[0-9]*) 1/s" "no run follows its program .planner" "does not follow its program anywhere .fidelity" NO_STDOUT "chosen" STDERR "does not belong")
clsurf_cli_test(NAME identify_without_a_log ARGS identify ${bottle} @DATA@/programs/dome_loops.nc -o m.toml EXIT 2 STDERR "dome_loops.nc' has no log")
clsurf_cli_test(NAME identify_without_output ARGS identify ${bottle} EXIT 2 STDERR "output")
clsurf_cli_test(NAME identify_does_not_replace_its_log SETUP "cp @LOGS@/bottle_uneven.biip r.biip" ARGS identify @DATA@/programs/bottle_uneven.nc r.biip -o r.biip EXIT 2 STDERR "is an input|input")
clsurf_cli_test(NAME machine_dead_time_too_long SETUP "printf '[[axis]]\\nname = \"x\"\\n[axis.servo]\\ndead_time = 0.2\\n' > m.toml" ARGS machine m.toml EXIT 3 STDERR "'dead_time' is 0.2, expected 0 or more, at most 0.1")

# One line at constant speed, without its ends: accelerations are unknown, and the time is that of the piece.
clsurf_cli_test(NAME identify_constant_speed_throughout
  SETUP "printf 'G21 G90\\nG0 X0 Y0 Z0\\nG1 X200 F3000\\nM2\\n' > p.nc; $CLSURF simulate p.nc --machine @DATA@/machines/three_axis_mill.toml -o r.biip -q; $CLSURF export p.nc r.biip --columns time,cmd.x,cmd.y,cmd.z,fb.x,fb.y,fb.z -o r.csv -q; sed -n '1p;200,3800p' r.csv > c.csv"
  ARGS identify p.nc c.csv -o m.toml FILE m.toml
  STDOUT "lag +x +0[.]000(4|39|40)[0-9]* s" "x: constant speed throughout .max_acceleration" "x: constant speed throughout .max_jerk" "simulated 3[.][0-9]+ s"
  NO_STDOUT "max_acceleration +x +[0-9]")
clsurf_cli_test(NAME identify_too_short
  SETUP "printf 'G21 G90\\nG0 X0 Y0 Z0\\nG1 X50 F3000\\nM2\\n' > p.nc; $CLSURF simulate p.nc --machine @DATA@/machines/three_axis_mill.toml -o r.biip -q; $CLSURF export p.nc r.biip --columns time,cmd.x,cmd.y,cmd.z,fb.x,fb.y,fb.z -o r.csv -q; sed -n '1,40p' r.csv > c.csv"
  ARGS identify p.nc c.csv -o m.toml STDOUT "x: too few records .position_gain" "c.csv: time 0[.]0[0-9]+ s, simulated 0[.]0[0-9]+ s")
# The axis Z1 of this recording is rotary: it is called A here, and the spindle, which does not move, Z.
set(gear_cutting "xzcat @DATA@/logs/edge_300.json.xz | sed 's/\"Axis\": \"Z1\"/\"Axis\": \"A1\"/; s/\"Axis\": \"SP1\"/\"Axis\": \"Z1\"/' > gear.json")
clsurf_cli_test(NAME identify_keeps_the_fit_where_a_run_cannot_be_tested
  SETUP "printf 'G21 G90\\nG0 X0 Y0 Z0\\nG1 X50 F3000\\nM2\\n' > p.nc; $CLSURF simulate p.nc --machine @DATA@/machines/three_axis_mill.toml -o r.biip -q; ${gear_cutting}"
  ARGS identify p.nc r.biip -o m.toml --test @DATA@/programs/keychain.mpf gear.json FILE m.toml
  STDOUT "not tested: .*gear.* moves rotary axes, and the kinematics are not known" "r.biip: time" NO_STDOUT "test runs")
set(two_periods "${two_parts_of_the_dome}; sed 's/^period.*/period = 0.002/' @DATA@/machines/linuxcnc_kernel.toml > 2ms.toml; $CLSURF simulate test.nc --machine 2ms.toml -o test.biip -q")
clsurf_cli_test(NAME identify_two_periods SETUP "${two_periods}"
  ARGS identify test.nc test.biip fit.nc fit.biip -o m.toml -v FILE m.toml
  STDOUT "period +controller +0[.]001 s +of the records of fit.biip" "position_gain +x +(100|99[.]9[0-9]*|100[.]0[0-9]*) 1/s"
  STDERR "test.biip: note: has a period of 0.002 s, and fit.biip has 0.001 s")
# A recording of a SINUMERIK: 0.6 s of a gear-cutting cycle. A counter restarts at its end, which is not a motion.
clsurf_cli_test(NAME identify_a_short_recording SETUP "${gear_cutting}" ARGS identify @DATA@/programs/keychain.mpf gear.json -o m.toml
  STDOUT "x: the axis does not move" "b: constant speed throughout .max_acceleration" "moves rotary axes, and the kinematics are not known"
  NO_STDOUT "max_speed +a +[0-9]+[0-9][0-9][0-9][0-9][0-9][0-9][0-9] deg/min" "0[.]00 %")

# The planner's rules, from a kernel's log, and the fidelity of the machine on a run that the fit has not used.
set(bottle_and_test identify ${bottle} -o m.toml --test ${dome} --picture residual.png)
clsurf_cli_test(NAME identify_selects_the_rules_of_a_kernel ARGS ${bottle_and_test} FILE m.toml
  STDOUT "planner +trapezoidal, arc blends .*chosen" "fitted runs" "the runs do not distinguish .*lookahead_blocks")
clsurf_cli_test(NAME identify_writes_a_machine_file AFTER identify_selects_the_rules_of_a_kernel
  SETUP "grep -q 'position_gain = 80.* # ± ' @AFTER@/m.toml" ARGS machine @AFTER@/m.toml STDOUT "can be used")
clsurf_cli_test(NAME identify_tests_another_run ARGS ${bottle_and_test}
  STDOUT "test runs, not used for the fit" "dome_loops.biip: time 18.206 s, simulated 18.20[0-9]+ s" "recall 1.00, precision 1.00")
clsurf_cli_test(NAME identify_draws_the_residual ARGS ${bottle_and_test} FILE residual.png)
clsurf_cli_test(NAME identify_picture_of_what_cannot_be_simulated
  SETUP "$CLSURF simulate @DATA@/programs/dome_five_axis.nc --machine @DATA@/machines/five_axis_trunnion.toml -o r.biip"
  ARGS identify @DATA@/programs/dome_five_axis.nc r.biip --force -o m.toml --picture residual.png EXIT 3
  FILE m.toml NO_FILE residual.png STDOUT "position_gain +y " STDERR "r.biip: error: cannot be compared with a simulation: no picture")
clsurf_cli_test(NAME identify_json_of_rules_and_tests SETUP "${two_parts_of_the_dome}" ARGS ${json_of_parts}
  STDOUT "\"rules\"" "\"chosen\": true" "\"fit\"" "\"time_error_percent\"" "\"speed_error_p95_mm_min\"" "\"following_error_p95_um\"" "\"defects_recall\"" "\"tests\"")
clsurf_cli_test(NAME identify_test_without_a_log ARGS identify ${bottle} -o m.toml --test @DATA@/programs/dome_loops.nc EXIT 2 STDERR "--test .*dome_loops.nc' has no log")
clsurf_cli_test(NAME simulate_quotes_the_fidelity AFTER identify_selects_the_rules_of_a_kernel
  ARGS simulate @DATA@/programs/bottle_uneven.nc --machine @AFTER@/m.toml -o r.biip STDOUT "Fidelity of this machine file .runs not used for the fit: 1.")
clsurf_cli_test(NAME check_quotes_the_simulation SETUP "$CLSURF simulate @DATA@/programs/dome_loops.nc --machine @DATA@/machines/linuxcnc_kernel.toml -o r.biip -q"
  ARGS check @DATA@/programs/dome_loops.nc r.biip STDOUT "This log was simulated for the machine .LinuxCNC 2.9, three axes.[.]" "Fidelity of this machine file: not measured")
clsurf_cli_test(NAME check_quotes_nothing_of_a_recorded_run ARGS check @DATA@/programs/dome_loops.nc @LOGS@/dome_loops.biip NO_STDOUT "simulated")
# Z moves at the start only, so that its loop is not identified: the gain of the default machine, 100 1/s, would not settle with a
# period of 12 ms, and the file could not be read.
set(slow_period "awk 'BEGIN { print \"G21 G90 G17 G94\\nG0 X0 Y0 Z5\\nG1 Z0 F1000\"; for (i = 0; i < 1200; ++i) printf \"G1 X%.3f Y%.3f F3000\\n\", i % 200 < 100 ? i % 100 : 100 - i % 100, 2 * sin(i / 5); print \"M30\" }' > p.nc; printf '[controller]\\nperiod = 0.012\\n' > m12.toml; for a in x y z; do printf '[[axis]]\\nname = \"%s\"\\n[axis.servo]\\nposition_gain = 30\\nvelocity_time_constant = 0.01\\n' $a; done >> m12.toml; $CLSURF simulate p.nc --machine m12.toml -o r.biip -q")
clsurf_cli_test(NAME identify_at_a_long_period SETUP "${slow_period}" ARGS identify p.nc r.biip -o m.toml -v FILE m.toml
  STDOUT "position_gain +x +(30|29[.]9|30[.]0)[0-9]* 1/s" "period +controller +0[.]012 s" "z: .*[(].*quantum, noise"
  STDERR "axis z: position_gain = 100 is too large for a period of 0.012 s: the file has 41.67")
clsurf_cli_test(NAME identify_at_a_long_period_writes_what_is_read SETUP "${slow_period}; $CLSURF identify p.nc r.biip -o m.toml -q" ARGS machine m.toml STDOUT "can be used")
# Positions that were 32-bit floats: differences over more records show the jerk all the same.
clsurf_cli_test(NAME identify_limits_from_floats
  SETUP "awk 'BEGIN { print \"G21 G90 G17 G94 G61\\nG0 X0 Y0 Z0\"; s = 7; for (i = 0; i < 40; ++i) { for (k = 0; k < 3; ++k) { s = (s * 16807) % 2147483647; p[k] = s / 2147483647 }; printf \"G1 X%.3f Y%.3f Z%.3f F%d\\n\", 250 * p[0], 250 * p[1], 40 * p[2] - 20, i % 3 ? 12000 : 4000 }; print \"M30\" }' > q.nc; $CLSURF simulate q.nc -o q.biip -q; $CLSURF export q.nc q.biip -o q.csv --columns time,line,cmd.x,cmd.y,cmd.z,fb.x,fb.y,fb.z -q; /usr/bin/python3 -c \"import struct; rows = open('q.csv').read().splitlines(); f = lambda v: '%.9g' % struct.unpack('f', struct.pack('f', float(v)))[0]; open('f.csv', 'w').write('\\n'.join([rows[0]] + [','.join(r.split(',')[:2] + [f(v) for v in r.split(',')[2:]]) for r in rows[1:]]) + '\\n')\""
  ARGS identify q.nc f.csv -o m.toml STDOUT "max_jerk +path +(50000|499[0-9][0-9]|500[0-9][0-9])[.0-9]* mm/s³ .*reached"
  NO_STDOUT "constant speed throughout .max_jerk")
