# Fronts of time against surface: each row by itself, the choice by a weight, and the written files.

set(read_tradeoff "/usr/bin/python3 @DATA@/../tests/cli/read_tradeoff.py")
set(mill "@DATA@/machines/three_axis_mill.toml")
# Six passes over a wave in Z, the fourth of which has fifty points in a millimetre.
set(waves "awk 'BEGIN { print \"G21 G90 G17\\nG64 P0.005\\nG0 X0 Y0 Z10\\nG1 Z0 F1000\\nG1 F3000\"; for (k = 0; k < 6; ++k) for (w = 0; w < 9.01; w += k == 3 && w > 3 && w < 4 ? 0.02 : 0.25) { x = k % 2 ? 9 - w : w; printf \"X%.3f Y%.3f Z%.3f\\n\", x, 0.4 * k, 0.5 * sin(0.8 * x) } print \"G0 Z10\\nM2\" }' > part.nc")
set(trade "$CLSURF simulate part.nc --machine ${mill} --no-config --runs 10")

# Each row by itself, from a machine file made here, with simulate and check. The choice and its files, for
# every weight.
foreach(weight 0 0.5 1)
  set(kind choice)
  if(weight EQUAL 0.5)
    set(kind settings)
  endif()
  clsurf_cli_test(NAME tradeoff_${kind}_${weight}
    SETUP "${waves}; ${trade} --tradeoff front.json --weight ${weight} --settings best.toml -o run.biip -q; ${read_tradeoff} ${kind} front.json part.nc ${mill} ${weight}; $CLSURF simulate part.nc --machine best.toml -o again.biip -q; cmp run.biip again.biip"
    ARGS machine best.toml FILE run.biip best.toml)
endforeach()
clsurf_cli_test(NAME tradeoff_threads
  SETUP "${waves}; ${trade} --weight 0.5 --json --threads 1 > one.json; ${trade} --weight 0.5 --json --threads 2 > two.json; cmp one.json two.json" ARGS --version)
clsurf_cli_test(NAME tradeoff_text SETUP "${waves}" ARGS simulate part.nc --machine ${mill} --runs 8 --tradeoff front.csv --weight 0.5
  STDOUT "as the machine file" "are on the front" "chosen by weight 0.5: " FILE front.csv)
foreach(ending png svg pdf csv json)
  clsurf_cli_test(NAME tradeoff_${ending} SETUP "${waves}" ARGS simulate part.nc --machine ${mill} --runs 3 --tradeoff front.${ending} FILE front.${ending})
endforeach()
clsurf_cli_test(NAME tradeoff_of_the_kernel SETUP "${waves}" ARGS simulate part.nc --machine @DATA@/machines/linuxcnc_kernel.toml --runs 6 --weight 1 --settings best.toml
  STDOUT "acceleration 90 %" NO_STDOUT "jerk [0-9]+ %" FILE best.toml)
# The same on five axes.
clsurf_cli_test(NAME tradeoff_five_axes ARGS simulate @DATA@/programs/dome_five_axis.nc --machine @DATA@/machines/five_axis_trunnion.toml --runs 3 --weight 1 --settings best.toml
  STDOUT "as the machine file" "feed 95 %" FILE best.toml)
clsurf_cli_test(NAME tradeoff_output_without_weight ARGS simulate part.nc --tradeoff front.png -o run.biip EXIT 2 STDERR "--output with --tradeoff writes the settings that are chosen" "give --weight" NO_FILE front.png)
clsurf_cli_test(NAME tradeoff_wrong_weight ARGS simulate part.nc --weight 1.5 EXIT 2 STDERR "--weight must be 0 .time alone. to 1 .surface alone.")
clsurf_cli_test(NAME tradeoff_wrong_ending ARGS simulate part.nc --tradeoff front.biip EXIT 2 STDERR "--tradeoff" ".csv")
clsurf_cli_test(NAME tradeoff_to_standard_output ARGS simulate part.nc --tradeoff - EXIT 2 STDERR "--tradeoff writes a file, not standard output")
clsurf_cli_test(NAME tradeoff_settings_alone ARGS simulate part.nc --settings best.toml -o run.biip EXIT 2 STDERR "--settings needs --tradeoff or --weight")
clsurf_cli_test(NAME tradeoff_controller ARGS simulate part.nc --tradeoff f.png --controller "x {program} {log}" EXIT 2 STDERR "cannot be combined with --controller")
clsurf_cli_test(NAME tradeoff_one_pass SETUP "printf 'G21 G90\\nG1 X50 F3000\\nM2\\n' > part.nc" ARGS simulate part.nc --tradeoff front.png EXIT 3 STDERR "has no adjacent passes" NO_FILE front.png)
clsurf_cli_test(NAME tradeoff_overwrites_nothing SETUP "${waves}" ARGS simulate part.nc --weight 0.5 --runs 3 --settings part.nc EXIT 2 NO_FILE run.biip)

# Repairs: judged alone, the written program has the values of the chosen row.
foreach(weight 0 1)
  clsurf_cli_test(NAME tradeoff_repair_${weight}
    SETUP "${waves}; $CLSURF optimize part.nc --machine ${mill} --machines 0 --no-config --more-time 5 --tradeoff front.json --weight ${weight} -o better.nc -q; ${read_tradeoff} repair front.json better.nc ${mill} ${weight}"
    ARGS info better.nc FILE better.nc)
endforeach()
clsurf_cli_test(NAME tradeoff_repair_text SETUP "${waves}" ARGS optimize part.nc --machine ${mill} --machines 0 --tradeoff front.svg -o better.nc
  STDOUT "accepted" "the program" "candidates are on the front" FILE front.svg better.nc)
clsurf_cli_test(NAME tradeoff_repair_controller ARGS optimize part.nc --weight 1 --controller "x {program} {log}" -o better.nc EXIT 2 STDERR "they cannot be combined with --controller")
