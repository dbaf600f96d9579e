# --derivative kalman: one estimate from all measurements, with its uncertainty.

clsurf_cli_test(NAME kalman_query ARGS query @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --point 4848 --derivative kalman --json STDOUT "\"acceleration_uncertainty_mm_s2\": [0-9.]+" "\"speed_uncertainty_mm_min\"")
clsurf_cli_test(NAME kalman_renders ARGS render @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --derivative kalman --color acceleration_uncertainty --size 200x150 -o u.png FILE u.png)
clsurf_cli_test(NAME uncertainty_needs_kalman ARGS export @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip -o out.csv --columns speed_uncertainty EXIT 2 STDERR "--derivative kalman")
clsurf_cli_test(NAME kalman_check ARGS check @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --tool none --derivative kalman -v STDOUT "85 % slower" "speed by a Kalman smoother")
clsurf_cli_test(NAME kalman_diff ARGS diff @LOGS@/bottle_uneven.biip @LOGS@/bottle_uneven.biip --tool none --derivative kalman STDOUT "speed .mm/min. +0.00 +0.00 +0.00")
clsurf_cli_test(NAME kalman_report ARGS report @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --tool none --derivative kalman -o page.html FILE page.html)
set(table_of_motors "/usr/bin/python3 -B ${CMAKE_CURRENT_LIST_DIR}/../encoder_and_scale.py")
clsurf_cli_test(NAME encoder_and_scale
  SETUP "${table_of_motors} make @LOGS@/dome_loops.biip run.csv truth.npy && ${table_of_motors} compare $CLSURF @DATA@/programs/dome_loops.nc run.csv truth.npy"
  ARGS query @DATA@/programs/dome_loops.nc run.csv --surface actual --derivative kalman --point 5000
  STDOUT "table X .*known to ±0" "scale ±0.* and encoder ±0.*, 2 records ahead, backlash")
clsurf_cli_test(NAME position_uncertainty_needs_both ARGS export @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip -o out.csv --derivative kalman --columns position_uncertainty.x EXIT 2 STDERR "scale and the encoder of each axis")
clsurf_cli_test(NAME derivative_unknown ARGS query @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --point 1 --derivative kalmann EXIT 2 STDERR "not one of savgol, kalman")
