# optimize and simulate with a controller of the user's own: here another simulated machine, which nothing but its logs
# shows; and controllers that fail.

set(other "printf '[path]\\nmax_normal_acceleration = 900\\n[[axis]]\\nname = \"x\"\\nmax_acceleration = 1300\\n' > other.toml")
set(dome @DATA@/programs/dome_loops.nc)
clsurf_cli_test(NAME optimize_on_a_controller SETUP "${other}"
  ARGS optimize ${dome} --controller "$CLSURF simulate {program} --machine other.toml -o {log} -q" --runs 2 -o better.nc FILE better.nc
  STDOUT "machine: that of clsurf machine --defaults, fitted to the runs of the controller" "run 1, the program: [0-9.]+ s, speed mismatch [0-9.]+ mm/min, [0-9]+ defects" "run 2, candidate 1: .*. promised .*. accepted" "on the controller +before" "accepted")
clsurf_cli_test(NAME optimize_controller_json SETUP "${other}"
  ARGS optimize ${dome} --controller "$CLSURF simulate {program} --machine other.toml -o {log} -q" --runs 2 -o better.nc --json
  STDOUT "\"controller_runs\"" "\"promised\"" "\"proof\": \"controller\"" "\"ensemble\"" "\"worst\"")
# A candidate's failure is reported; without any that ran, nothing is written.
clsurf_cli_test(NAME optimize_controller_fails_on_candidates EXIT 1
  SETUP "${other}; printf '#!/bin/sh\\ngrep -q optimize \"$1\" && { echo no such tool; exit 7; }\\n\"$CLSURF\" simulate \"$1\" --machine other.toml -o \"$2\" -q\\n' > controller; chmod +x controller"
  ARGS optimize ${dome} --controller "./controller {program} {log}" --runs 2 -o better.nc NO_FILE better.nc
  STDOUT "run 2, candidate 1: failed: it ended with exit code 7 [(]\"no such tool\"[)]" "refused")
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
  ARGS optimize ${dome} --controller "run {program}" -o better.nc STDERR "controller has no .log.")
clsurf_cli_test(NAME optimize_runs_without_controller EXIT 2
  ARGS optimize ${dome} --runs 3 -o better.nc STDERR "--runs is of --controller")
clsurf_cli_test(NAME simulate_on_a_controller SETUP "${other}"
  ARGS simulate ${dome} --controller "$CLSURF simulate {program} --machine other.toml -o {log} -q" -o run.biip FILE run.biip STDOUT "[0-9]+ records, [0-9.]+ s, from the controller")
clsurf_cli_test(NAME simulate_controller_fails EXIT 3
  ARGS simulate ${dome} --controller "false {program} {log}" -o run.biip NO_FILE run.biip STDERR "it ended with exit code 1")
# With a log and without a machine file, the machine is that of the log.
clsurf_cli_test(NAME optimize_fits_the_machine_to_the_log
  ARGS optimize ${dome} --log @LOGS@/dome_loops.biip -o better.nc
  STDOUT "machine: fitted to .*dome_loops.biip" "on 4 other machines that the machine file allows" "Fidelity of this machine file [(]the fitted runs: 1[)]")
clsurf_cli_test(NAME optimize_without_an_ensemble
  ARGS optimize ${dome} --machine @DATA@/machines/linuxcnc_kernel.toml --machines 0 -o better.nc NO_STDOUT "other machines")
clsurf_cli_test(NAME machine_file_with_uncertainty
  SETUP "printf '[[uncertainty]]\\nkey = \"max_jerk\"\\nof = \"x\"\\nrelative_error = 0.1\\n' > m.toml"
  ARGS machine m.toml STDOUT "can be used")
clsurf_cli_test(NAME machine_file_with_two_uncertainties EXIT 3
  SETUP "printf '[[uncertainty]]\\nkey = \"max_jerk\"\\nof = \"x\"\\nrelative_error = 0.1\\nlower_bound = 5\\n' > m.toml"
  ARGS machine m.toml STDERR "m.toml:1.*one of 'relative_error', 'lower_bound' and 'values'")
clsurf_cli_test(NAME machine_file_with_uncertainty_of_nothing EXIT 3
  SETUP "printf '[[uncertainty]]\\nkey = \"position_gain\"\\nof = \"x\"\\nrelative_error = 0.1\\n' > m.toml"
  ARGS machine m.toml STDERR "no uncertainty is known of 'position_gain' of 'x'")

# A repair that was verified on simulated machines, and ran on LinuxCNC (docs/experiments/kernel.md): 15 defects before, the
# passes 82 to 87 % slower than their neighbours.
set(repaired @DATA@/programs/bottle_uneven_repaired.nc)
clsurf_cli_test(NAME repaired_on_a_kernel ARGS check ${repaired} @LOGS@/bottle_uneven_repaired.biip
  STDOUT "^10 defects: systematic axis lag .±7[0-9.]+ µm" "slower stretches .up to -2[0-9] %.")
clsurf_cli_test(NAME repaired_as_the_kernel_ran_it
  SETUP "$CLSURF simulate ${repaired} --machine @DATA@/machines/linuxcnc_kernel.toml -o simulated.biip -q"
  ARGS diff @LOGS@/bottle_uneven_repaired.biip simulated.biip --program ${repaired}
  STDOUT "aligned, 25[.]9[0-9]+ s and 26[.][0-9]+ s" "speed .mm/min. +-?0[.]0[0-9] +0[.]0[0-9] +-?0[.]0[0-9] +0[.]0[0-9] ")
