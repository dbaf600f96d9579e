# optimize and simulate with the user's own controller, here another simulated machine that is only known from its logs;
# and controllers that fail.

set(other "printf '[path]\\nmax_normal_acceleration = 900\\n[[axis]]\\nname = \"x\"\\nmax_acceleration = 1300\\n' > other.toml")
set(dome @DATA@/programs/dome_loops.nc)
# A part of two and a half seconds, because each run of a repair is simulated many times. Six passes, the fourth of which
# has fifty points in a millimetre.
set(crowded_part "awk 'BEGIN { print \"G21 G90\\nG64 P0.005\\nG0 X0 Y0 Z10\\nG1 Z0 F1000\\nG1 F3000\"; for (k = 0; k < 6; ++k) for (w = 0; w < 9.01; w += k == 3 && w > 3 && w < 4 ? 0.02 : 0.25) { x = k % 2 ? 9 - w : w; printf \"X%.3f Y%.3f Z%.3f\\n\", x, 0.4 * k, 0.5 * sin(0.8 * x) } print \"G0 Z10\\nM2\" }' > part.nc")
# The machine of a machine file, and one with another limit.
set(mill @DATA@/machines/linuxcnc_logs.toml)
set(other_mill "${crowded_part}; sed '0,/max_acceleration = .*/s//max_acceleration = 1300/' ${mill} > other.toml")
clsurf_cli_test(NAME optimize_on_a_controller SETUP "${other}; ${crowded_part}"
  ARGS optimize part.nc --controller "$CLSURF simulate {program} --machine other.toml -o {log} -q" --runs 3 -o better.nc FILE better.nc
  STDOUT "machine: that of clsurf machine --defaults, fitted to the runs of the controller" "run 1, the program: [0-9.]+ s, speed mismatch [0-9.]+ mm/min, [0-9]+ defect" "run [23], candidate [12]: .*. promised .*. accepted" "on the controller +before" "accepted")
# The table has the defects of the runs above it, even if no candidate is accepted.
clsurf_cli_test(NAME optimize_refused_by_a_controller
  SETUP "${other_mill}; sed 's/max_acceleration = .*/max_acceleration = 900/' ${mill} > slow.toml; printf '#!/bin/sh\\ngrep -q optimize \"$1\" && m=slow || m=other\\n\"$CLSURF\" simulate \"$1\" --machine $m.toml -o \"$2\" -q\\n' > controller; chmod +x controller; $CLSURF optimize part.nc --machine ${mill} --machines 0 --controller './controller {program} {log}' --runs 2 -o better.nc > out.txt || test $? -eq 1; grep -q 'refused: on the controller' out.txt && awk '/^run 1/ { a = $11 } /^run 2/ { b = $11 } /^defects / { exit !(a == $2 && b == $3 && a != b) }' out.txt"
  ARGS --version NO_FILE better.nc)
clsurf_cli_test(NAME optimize_controller_json SETUP "${other_mill}"
  ARGS optimize part.nc --machine ${mill} --controller "$CLSURF simulate {program} --machine other.toml -o {log} -q" --runs 2 -o better.nc --json
  STDOUT "\"controller_runs\"" "\"promised\"" "\"proof\": \"controller\"" "\"ensemble\"" "\"worst\"")
# The failure of a candidate is reported; if none runs, nothing is written.
clsurf_cli_test(NAME optimize_controller_fails_on_candidates EXIT 1
  SETUP "${other_mill}; printf '#!/bin/sh\\ngrep -q optimize \"$1\" && { echo no such tool; exit 7; }\\n\"$CLSURF\" simulate \"$1\" --machine other.toml -o \"$2\" -q\\n' > controller; chmod +x controller"
  ARGS optimize part.nc --machine ${mill} --controller "./controller {program} {log}" --runs 2 -o better.nc NO_FILE better.nc
  STDOUT "run 2, candidate 1: failed: it ended with exit code 7 [(]\"no such tool\"[)]" "refused")
# What the report then compares is simulated.
clsurf_cli_test(NAME optimize_controller_json_without_a_run_of_a_candidate EXIT 1
  SETUP "${other_mill}; printf '#!/bin/sh\\ngrep -q optimize \"$1\" && exit 7\\n\"$CLSURF\" simulate \"$1\" --machine other.toml -o \"$2\" -q\\n' > controller; chmod +x controller"
  ARGS optimize part.nc --machine ${mill} --controller "./controller {program} {log}" --runs 2 -o better.nc --json NO_FILE better.nc
  STDOUT "\"reason\": \"it ended with exit code 7" "\"proof\": \"simulation\"")
clsurf_cli_test(NAME optimize_controller_fails EXIT 3
  ARGS optimize ${dome} --controller "false {program} {log}" -o better.nc NO_FILE better.nc STDERR "the controller did not run it: it ended with exit code 1")
clsurf_cli_test(NAME optimize_controller_hangs EXIT 3
  ARGS optimize ${dome} --controller "sleep 60 # {program} {log}" --timeout 0.5 -o better.nc NO_FILE better.nc STDERR "took longer than 0.5 s and was stopped")
clsurf_cli_test(NAME optimize_controller_writes_no_log EXIT 3
  ARGS optimize ${dome} --controller "true {program} {log}" -o better.nc STDERR "wrote no log")
clsurf_cli_test(NAME optimize_controller_writes_garbage EXIT 3
  ARGS optimize ${dome} --controller "cp {program} {log}" -o better.nc STDERR "its log cannot be used: is not a log in a known format")
clsurf_cli_test(NAME optimize_controller_runs_another_program EXIT 3
  ARGS optimize ${dome} --controller "cp @LOGS@/bottle_uneven.biip {log} # {program}" -o better.nc STDERR "its log cannot be used: does not belong to")
clsurf_cli_test(NAME optimize_controller_without_log_word EXIT 2
  ARGS optimize ${dome} --controller "run {program}" -o better.nc STDERR "the --controller command lacks .log.")
clsurf_cli_test(NAME optimize_runs_without_controller EXIT 2
  ARGS optimize ${dome} --runs 3 -o better.nc STDERR "--runs needs --controller")
clsurf_cli_test(NAME simulate_on_a_controller SETUP "${other}"
  ARGS simulate ${dome} --controller "$CLSURF simulate {program} --machine other.toml -o {log} -q" -o run.biip FILE run.biip STDOUT "[0-9]+ records, [0-9.]+ s, from the controller")
clsurf_cli_test(NAME simulate_controller_fails EXIT 3
  ARGS simulate ${dome} --controller "false {program} {log}" -o run.biip NO_FILE run.biip STDERR "it ended with exit code 1")
clsurf_cli_test(NAME simulate_controller_runs_another_program EXIT 3
  ARGS simulate ${dome} --controller "cp @LOGS@/bottle_uneven.biip {log} # {program}" -o run.biip NO_FILE run.biip STDERR "run.biip: error: does not belong to")
clsurf_cli_test(NAME simulate_controller_stops_early SETUP "${other}"
  ARGS simulate ${dome} --controller "$CLSURF simulate {program} --machine other.toml -o {log} -q; truncate -s -200000 {log}" -o run.biip FILE run.biip STDERR "run.biip: .*warning: the log ends at line [0-9]+: [0-9]+ % of the program's motions are missing after it")
# A log that never ends is not read.
clsurf_cli_test(NAME simulate_controller_writes_a_device EXIT 3
  ARGS simulate ${dome} --controller "ln -s /dev/zero {log} # {program}" -o run.biip NO_FILE run.biip STDERR "its log is not a file")
clsurf_cli_test(NAME simulate_controller_writes_a_pipe EXIT 3
  ARGS simulate ${dome} --controller "mkfifo {log} # {program}" -o run.biip NO_FILE run.biip STDERR "its log is not a file")
clsurf_cli_test(NAME simulate_controller_prints_without_end EXIT 3
  ARGS simulate ${dome} --controller "yes {program} {log}" -o run.biip NO_FILE run.biip STDERR "it printed more than 100 MB and was stopped")
clsurf_cli_test(NAME optimize_controller_stops_candidates_early EXIT 1
  SETUP "${other_mill}; printf '#!/bin/sh\n\"$CLSURF\" simulate \"$1\" --machine other.toml -o \"$2\" -q\ngrep -q optimize \"$1\" && truncate -s -20000 \"$2\" || true\n' > controller; chmod +x controller"
  ARGS optimize part.nc --machine ${mill} --controller "./controller {program} {log}" --runs 2 -o better.nc NO_FILE better.nc
  STDOUT "run 2, candidate 1: failed: the log lacks [0-9.]+ % of the program" "refused")
# With a log and without a machine file, the machine is fitted to the log.
clsurf_cli_test(NAME optimize_fits_the_machine_to_the_log SETUP "${crowded_part}; $CLSURF simulate part.nc --machine ${mill} -o run.biip -q"
  ARGS optimize part.nc --log run.biip -o better.nc
  STDOUT "machine: fitted to run.biip" "on 4 other machines within the uncertainty of the machine file" "Fidelity of this machine file [(]the fitted runs: 1[)]")
clsurf_cli_test(NAME optimize_without_an_ensemble SETUP "${crowded_part}"
  ARGS optimize part.nc --machine @DATA@/machines/linuxcnc_kernel.toml --machines 0 -o better.nc NO_STDOUT "other machines")
clsurf_cli_test(NAME machine_file_with_uncertainty
  SETUP "printf '[[uncertainty]]\\nkey = \"max_jerk\"\\nof = \"x\"\\nrelative_error = 0.1\\n' > m.toml"
  ARGS machine m.toml STDOUT "can be used")
clsurf_cli_test(NAME machine_file_with_two_uncertainties EXIT 3
  SETUP "printf '[[uncertainty]]\\nkey = \"max_jerk\"\\nof = \"x\"\\nrelative_error = 0.1\\nlower_bound = 5\\n' > m.toml"
  ARGS machine m.toml STDERR "m.toml:1.*one of 'relative_error', 'lower_bound' and 'values'")
clsurf_cli_test(NAME machine_file_with_uncertainty_of_nothing EXIT 3
  SETUP "printf '[[uncertainty]]\\nkey = \"position_gain\"\\nof = \"x\"\\nrelative_error = 0.1\\n' > m.toml"
  ARGS machine m.toml STDERR "no uncertainty is known of 'position_gain' of 'x'")

# A repair that was verified on simulated machines and run on LinuxCNC (docs/experiments/kernel.md): 15 defects before, the
# passes 82 to 87 % slower than their neighbours.
set(repaired @DATA@/programs/bottle_uneven_repaired.nc)
clsurf_cli_test(NAME repaired_on_a_kernel ARGS check ${repaired} @LOGS@/bottle_uneven_repaired.biip
  STDOUT "^10 defects: systematic axis lag .±7[0-9.]+ µm" "slower sections .up to -2[0-9] %.")
clsurf_cli_test(NAME repaired_as_the_kernel_ran_it
  SETUP "$CLSURF simulate ${repaired} --machine @DATA@/machines/linuxcnc_kernel.toml -o simulated.biip -q"
  ARGS diff @LOGS@/bottle_uneven_repaired.biip simulated.biip --program ${repaired}
  STDOUT "aligned, 25[.]9[0-9]+ s and 26[.][0-9]+ s" "speed .mm/min. +-?0[.]0[0-9] +0[.]0[0-9] +-?0[.]0[0-9] +0[.]0[0-9] ")
# Rounds: the machine differs from its file. Each round's log improves the fit, and the result must be better.
set(crowded_rounds "${crowded_part}; $CLSURF simulate part.nc --machine @DATA@/machines/linuxcnc_logs.toml -o run0.biip -q; $CLSURF optimize part.nc --tolerance 0.003 -o one.nc -q; $CLSURF simulate one.nc --machine @DATA@/machines/linuxcnc_logs.toml -o run1.biip -q")
clsurf_cli_test(NAME optimize_learns_from_rounds SETUP "${crowded_rounds}; sed 's/F3000/F2500/' one.nc > slow.nc; $CLSURF simulate slow.nc --machine @DATA@/machines/linuxcnc_logs.toml -o run2.biip -q"
  ARGS optimize part.nc --log run0.biip --round slow.nc run2.biip -o two.nc FILE two.nc
  STDOUT "fitted to 2 logs" "run 1, the program: [0-9.]+ s" "run 2, slow.nc: [0-9.]+ s, .*no better than the program: it would take" "the fitted runs: 2" "accepted")
# The same part, made by hand without the crowded points, on a machine with better servo loops: no candidate of the search
# promises more.
string(REPLACE "k == 3 && w > 3 && w < 4 ? 0.02 : 0.25" "0.25" even_part "${crowded_part}")
string(REPLACE "part.nc" "even.nc" even_part "${even_part}")
clsurf_cli_test(NAME optimize_keeps_the_round_that_is_as_good EXIT 1 AFTER optimize_learns_from_rounds
  SETUP "cp @AFTER@/part.nc @AFTER@/one.nc @AFTER@/run0.biip @AFTER@/run1.biip .; ${even_part}; sed 's/feedforward = .*/feedforward = 1/; s/position_gain = .*/position_gain = 100/; s/time_constant = .*/time_constant = 0.001/' @DATA@/machines/linuxcnc_logs.toml > servo.toml; $CLSURF simulate even.nc --machine servo.toml -o even.biip -q"
  ARGS optimize part.nc --log run0.biip --round one.nc run1.biip even.nc even.biip -o two.nc --json NO_FILE two.nc
  STDOUT "\"program\": \"even.nc\"" "\"reason\": \"even.nc gained [0-9.]+ % on the machine, and the best candidate promises [0-9.]+ %: keep even.nc\"" "\"proof\": \"simulation\"")
clsurf_cli_test(NAME optimize_round_of_another_program EXIT 3
  ARGS optimize ${dome} --log @LOGS@/dome_loops.biip --round ${dome} @LOGS@/bottle_uneven.biip -o better.nc NO_FILE better.nc STDERR "is not a run of dome_loops.nc: the log does not belong to the program")
clsurf_cli_test(NAME optimize_half_a_round EXIT 2
  ARGS optimize ${dome} --log @LOGS@/dome_loops.biip --round ${dome} -o better.nc STDERR "--round takes two files")
clsurf_cli_test(NAME optimize_rounds_without_the_log EXIT 2
  ARGS optimize ${dome} --round ${dome} @LOGS@/dome_loops.biip -o better.nc STDERR "--round needs the log of the program itself")

# Arcs in corners if axes have jerk limits.
clsurf_cli_test(NAME machine_arc_steps_within_a_period SETUP "printf '[controller]\\nperiod = 0.002\\narc_step_time = 0.001\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:3:17: error: 'arc_step_time' is 0.001, expected 0 or at least the period, 0.002")
clsurf_cli_test(NAME machine_arc_steps_of_splines SETUP "printf '[controller]\\ncorner = \"spline\"\\narc_step_time = 0.001\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:3:17: error: 'arc_step_time' has no effect with corner = \"spline\".*hint: remove the line")
clsurf_cli_test(NAME machine_arc_steps_of_five_axes SETUP "printf '[controller]\\narc_step_time = 0.001\\n[kinematics]\\ntype = \"table-table\"\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "arc_step_time is for three axes")
# Merging of short lines: Q of G64 belongs to the trapezoidal planner, and with five axes nothing is merged.
clsurf_cli_test(NAME machine_merging SETUP "printf '[controller]\\nplanner = \"trapezoidal\"\\nmerging_tolerance = \"program\"\\n' > m.toml" ARGS machine --check m.toml STDOUT "can be used")
clsurf_cli_test(NAME machine_merging_of_no_program SETUP "printf '[controller]\\nmerging_tolerance = \"program\"\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:2:21: error: 'merging_tolerance'")
clsurf_cli_test(NAME machine_merging_below_zero SETUP "printf '[controller]\\nmerging_tolerance = -0.01\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "'merging_tolerance' is -0.01, expected 0 or more")
clsurf_cli_test(NAME machine_merging_without_rounding SETUP "printf '[controller]\\ncorner = \"stop\"\\nmerging_tolerance = 0.01\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "'merging_tolerance' has no effect with corner")
clsurf_cli_test(NAME machine_merging_of_five_axes SETUP "printf '[controller]\\nmerging_tolerance = 0.01\\n[kinematics]\\ntype = \"table-table\"\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "merging_tolerance is for three axes")
# On three_axis_mill, 90° with a tolerance of 0.01 mm: r = 24.142 µm, v = √(80000 r · 0.001) = 1.38974 mm/s (arc_steps_test.cpp: 1.1328 s).
clsurf_cli_test(NAME simulate_arcs_with_jerk_limits
  SETUP "sed 's/^arc_step_time = 0 /arc_step_time = 0.001 /' @DATA@/machines/three_axis_mill.toml > m.toml && printf 'G21 G90 G64\\nG1 X10 F3000\\nY10\\nX0\\nY0\\nM2\\n' > square.nc"
  ARGS simulate square.nc --machine m.toml --json -o run.biip STDOUT "\"duration_s\": 1.133" "\"limits_ok\": true")
