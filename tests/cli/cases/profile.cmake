# A tool path from scanned points. tests/scan/scanned_part.py makes the scans and judges the programs; it shares no code with
# the product.

set(scanned "python3 ${PROJECT_SOURCE_DIR}/tests/scan/scanned_part.py")
set(judged "$CLSURF profile scan.csv --x x --z height -o cut.nc --json")
clsurf_cli_test(NAME profile_of_a_scan
  SETUP "${scanned} make .; ${judged} --window 40 > ../r.json; ${scanned} check cut.nc ../r.json; rm cut.nc"
  ARGS profile scan.csv --x x --z height --window 40 --picture fit.png -o cut.nc FILE cut.nc fit.png
  STDOUT "scan.csv: 1500 points, X 0.1 to 149.8 mm" "7 points rejected: .*: X 0, X 10, X 10.1, X 40, X 77.7, X 120, X 149.9"
    "degree 3, windows of 40 points, join c1: residual 0.00[34]" "cut.nc: [0-9]+ lines, within 0.00[0-9]+ mm of the fit")
clsurf_cli_test(NAME profile_of_a_ball
  SETUP "${scanned} make .; ${judged} --window 40 --tool-offset 3 > ../r.json; ${scanned} check cut.nc ../r.json --radius 3; rm cut.nc"
  ARGS profile scan.csv --z 1 --x 0 --window 40 --tool-offset 3 --join blend -o cut.nc STDOUT "path of a ball of radius 3 mm")
clsurf_cli_test(NAME profile_of_two_columns_of_any_name SETUP "awk 'BEGIN { print \"pos;height\"; for (i = 0; i < 100; ++i) printf \"%g;%g\\n\", i / 10, 1 }' > scan.csv" ARGS profile scan.csv -o c.nc FILE c.nc)
clsurf_cli_test(NAME profile_of_distances
  SETUP "${scanned} make .; $CLSURF profile laser.txt --x way --z distance --distance 120 --sensor-offset 35 --window 40 -o cut.nc --json > ../r.json; ${scanned} check cut.nc ../r.json --outliers 0"
  ARGS profile laser.txt --x 1 --z 2 --distance 120 --sensor-offset 35 --window 40 --degree 5 --dialect klartext -o c.h FILE c.h STDOUT "X 0 to 149.9 mm" "0 points rejected")
foreach(dialect linuxcnc siemens klartext fanuc)
  set(blocks lines)
  if(NOT dialect STREQUAL "linuxcnc")
    set(blocks splines)
  endif()
  clsurf_cli_test(NAME profile_simulated_${dialect}
    SETUP "${scanned} make .; $CLSURF profile scan.csv --x x --z height --window 40 --tool-offset 3 --dialect ${dialect} --blocks ${blocks} -o cut.nc"
    ARGS simulate cut.nc --dialect ${dialect} -o run.biip FILE run.biip STDOUT "off the path +0[.]0[01]" "[0-9]+ points, 1[0-9][.]")
endforeach()
# The answer includes a run of the program on a machine; a machine that deviates too far from the fit is a warning.
clsurf_cli_test(NAME profile_is_simulated
  SETUP "${scanned} make .; $CLSURF profile scan.csv --x x --z height --window 40 -o first.nc 2> said.txt && ! grep -q warning said.txt"
  ARGS profile scan.csv --x x --z height --window 40 -o cut.nc --machine @DATA@/machines/three_axis_mill.toml FILE cut.nc
  STDOUT "simulated on .*: within 0[.]0[012][0-9]+ mm of it .tolerance and corners allow 0[.]0[0-9]+ mm., [0-9.]+ s")
clsurf_cli_test(NAME profile_simulation_in_json SETUP "${scanned} make ."
  ARGS profile scan.csv --x x --z height --window 40 -o cut.nc --json STDOUT "\"simulation\": ." "\"deviation_mm\": 0[.]0" "\"allowed_mm\": 0[.]02" "\"time_s\": [0-9]")
# Every fit rounds off a step.
clsurf_cli_test(NAME profile_of_a_step
  SETUP "awk 'BEGIN { print \"x,z\"; for (i = 0; i < 400; ++i) printf \"%g,%g\\n\", i / 10, i < 200 ? 0 : 5 }' > step.csv"
  ARGS profile step.csv --outliers 0 -o c.nc FILE c.nc STDERR "step.csv: warning: the fit is [0-9.]+ mm away from a scanned point, at X (19|20)[0-9.]* mm: [0-9]+ times the tolerance")
clsurf_cli_test(NAME profile_windows_apart SETUP "${scanned} make ."
  ARGS profile scan.csv --x x --z height --join none -o cut.nc STDOUT "it jumps between windows at 149 places: 0.00[0-9]+ mm rms")
clsurf_cli_test(NAME profile_outliers_kept SETUP "${scanned} make ."
  ARGS profile scan.csv --x x --z height --outliers 0 -o cut.nc --json STDOUT "\"rejected\": 0" "\"join\": \"c1\"" "\"window_jumps\": ." "\"chord_error_mm\": 0.0")
clsurf_cli_test(NAME profile_gouged SETUP "${scanned} make ."
  ARGS profile scan.csv --x x --z height --window 60 --tool-offset 30 -o cut.nc EXIT 3 NO_FILE cut.nc
  STDERR "scan.csv: error: a ball of radius 30 mm cuts [0-9.]+ mm below the fit at X [0-9.]+ mm. the tightest concave radius of the fit is [5-7][.]")

set(few "printf 'x,z\\n0,1\\n1,2\\n2,3\\n' > m.csv")
clsurf_cli_test(NAME profile_too_few_points SETUP "${few}" ARGS profile m.csv -o c.nc EXIT 3 STDERR "has 3 points of different x: degree 3 needs 4")
clsurf_cli_test(NAME profile_across_a_gap SETUP "printf '0 1\\n0.01 1.5\\n0.02 1\\n0.03 2\\n30 1\\n30.01 3\\n' > m.txt" ARGS profile m.txt -o c.nc EXIT 3 NO_FILE c.nc STDERR "the fit swings [0-9.e+]+ mm beyond all points, at X" "hint: points are missing there")
clsurf_cli_test(NAME profile_bad_number SETUP "printf 'x,z\\n0,1\\n1,oops\\n' > m.csv" ARGS profile m.csv -o c.nc EXIT 3 STDERR "m.csv:3: error: 'oops' in column 'z' is not a number")
clsurf_cli_test(NAME profile_no_column SETUP "${few}" ARGS profile m.csv --z height -o c.nc EXIT 3 STDERR "has no column 'height'" "its columns are: x, z")
clsurf_cli_test(NAME profile_of_space SETUP "printf 'x,y,z\\n0,1,2\\n1,2,3\\n2,3,4\\n3,4,5\\n' > m.csv" ARGS profile m.csv -o c.nc EXIT 3 STDERR "is not a profile: its points do not have one y")
clsurf_cli_test(NAME profile_degree_of_c1 SETUP "${few}" ARGS profile m.csv --degree 1 -o c.nc EXIT 2 STDERR "--degree of --join c1 must be from 2 to 9")
clsurf_cli_test(NAME profile_short_window SETUP "${few}" ARGS profile m.csv --window 3 -o c.nc EXIT 2 STDERR "--window must be at least 4 points for degree 3")
clsurf_cli_test(NAME profile_ball_over_jumps SETUP "${few}" ARGS profile m.csv --join none --tool-offset 2 -o c.nc EXIT 2 STDERR "needs a profile without jumps")
clsurf_cli_test(NAME profile_splines_of_linuxcnc SETUP "${few}" ARGS profile m.csv --blocks splines -o c.nc EXIT 2 STDERR "does not apply to linuxcnc, only to siemens, klartext and fanuc: its G5 lies in the XY plane")
clsurf_cli_test(NAME profile_unknown_dialect SETUP "${few}" ARGS profile m.csv --dialect rs -o c.nc EXIT 2 STDERR "rs")
clsurf_cli_test(NAME profile_over_its_scan SETUP "${few}" ARGS profile m.csv --degree 2 --window 3 -o m.csv EXIT 2)

# Deviations along a finished pass give a corrected pass. NumPy cuts the part by brute force.
set(compensated "/usr/bin/python3 ${PROJECT_SOURCE_DIR}/tests/scan/compensated_part.py")
foreach(radius 0 3)
  clsurf_cli_test(NAME profile_compensates_radius_${radius}
    SETUP "${compensated} make . ${radius}; $CLSURF profile deviations.csv --z dz --compensate pass.ngc --tool-offset ${radius} --tolerance 0.001 -o corrected.ngc -q; ${compensated} check . ${radius}; rm corrected.ngc"
    ARGS profile deviations.csv --z dz --compensate pass.ngc --tool-offset ${radius} --tolerance 0.001 -o corrected.ngc FILE corrected.ngc
    STDOUT "deviations of pass.ngc: corrected by at most 0.04[0-9]+ mm, at X 17")
endforeach()
clsurf_cli_test(NAME profile_compensates_in_a_picture SETUP "${compensated} make . 3; $CLSURF profile deviations.csv --z dz --compensate pass.ngc --tool-offset 3 --tolerance 0.002 -o c.ngc --picture c.svg > c.txt; python3 @DATA@/../tests/cli/read_svg.py c.svg images 0 'Residual 0.[23][0-9]* µm rms' 'Fitted deviation .µm.' 'Measured less fitted' '[0-9]+ deviations measured'"
  ARGS profile deviations.csv --z dz --compensate pass.ngc --tool-offset 3 --tolerance 0.002 -o d.ngc FILE d.ngc STDOUT "residual 0.0003 mm rms, 0.0[0-9]+ mm at most")
clsurf_cli_test(NAME profile_compensates_in_json SETUP "${compensated} make . 3"
  ARGS profile deviations.csv --z dz --compensate pass.ngc --tool-offset 3 --tolerance 0.002 -o c.ngc --json STDOUT "\"compensation\": ." "\"max_mm\": 0.04")
clsurf_cli_test(NAME profile_compensates_no_distances SETUP "${compensated} make . 0"
  ARGS profile deviations.csv --z dz --distance 100 --compensate pass.ngc -o c.ngc EXIT 2 STDERR "--distance does not apply to --compensate")
clsurf_cli_test(NAME profile_compensates_no_gouge SETUP "${compensated} make . 0"
  ARGS profile deviations.csv --z dz --compensate pass.ngc --tool-offset 60 --tolerance 0.001 -o c.ngc EXIT 3 NO_FILE c.ngc STDERR "error: ")
clsurf_cli_test(NAME profile_compensates_where_it_was_measured SETUP "${compensated} make . 0; sed -i '60,$d' deviations.csv"
  ARGS profile deviations.csv --z dz --compensate pass.ngc -o c.ngc EXIT 3 NO_FILE c.ngc STDERR "has deviations from X 4.000 to 32.500 mm: the pass goes from 5.000 to")
