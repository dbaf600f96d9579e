# Repaired sections as splines. SciPy evaluates the written splines and measures their distance to the lines in both
# directions.

set(read_splines "/usr/bin/python3 @DATA@/../tests/cli/read_splines.py")
set(mill "--machine @DATA@/machines/three_axis_mill.toml --machines 1 --no-config")
# Six passes over a wave in Z, the fourth of which has fifty points in a millimetre, in each dialect.
set(waves "awk 'BEGIN { print \"G21 G90 G17\\nG64 P0.005\\nG0 X0 Y0 Z10\\nG1 Z0 F1000\\nG1 F3000\"; for (k = 0; k < 6; ++k) for (w = 0; w < 9.01; w += k == 3 && w > 3 && w < 4 ? 0.02 : 0.25) { x = k % 2 ? 9 - w : w; printf \"X%.3f Y%.3f Z%.3f\\n\", x, 0.4 * k, 0.5 * sin(0.8 * x) } print \"G0 Z10\\nM2\" }' > part.nc")
set(as_fanuc "sed -i 's/^G64.*/G05 P10000/; s/^M2/M30/' part.nc")
set(as_siemens "sed -i 's/G21/G71 G94/; s/^G64.*/G642/; s/^M2/M30/' part.nc")
set(as_klartext "awk '/^X/ { print \"L \" $0 } /^G21/ { print \"0 BEGIN PGM A MM\\nL X+0 Y+0 Z+10 R0 FMAX M3\\nL Z+0 F1000\\nL Z+0 F3000\" } END { print \"L Z+10 FMAX M30\\nEND PGM A MM\" }' part.nc > part.h; mv part.h part.nc")
# The wave is in the plane of X and Y instead.
set(as_plane "awk '/^X/ { printf \"%s Y%.3f Z0\\n\", $1, substr($2, 2) + substr($3, 2); next } { print }' part.nc > plane.nc; mv plane.nc part.nc")

foreach(row "fanuc as_fanuc fanuc" "siemens as_siemens siemens" "klartext as_klartext klartext" "linuxcnc as_plane linuxcnc")
  string(REPLACE " " ";" row "${row}")
  list(GET row 0 name)
  list(GET row 1 change)
  list(GET row 2 dialect)
  clsurf_cli_test(NAME optimize_splines_${name}
    SETUP "${waves}; ${${change}}; $CLSURF optimize part.nc --dialect ${dialect} ${mill} --splines -o better.nc -q && ${read_splines} part.nc better.nc 0.005 12"
    ARGS info better.nc --dialect ${dialect} STDOUT "[1-9][0-9]* splines" FILE better.nc)
endforeach()
# Feeds on the blocks of spans, and the programmed feed after the section: for shorter waves smooth points are not sufficient.
string(REPLACE "0.8 * x" "1.2 * x" short_waves "${waves}")
clsurf_cli_test(NAME optimize_splines_feeds_klartext
  SETUP "${short_waves}; ${as_klartext}; $CLSURF optimize part.nc --dialect klartext --machine @DATA@/machines/three_axis_mill.toml --machines 0 --no-config --splines -o better.nc -q && grep -qE '^SPL .* F2[0-9.]+$' better.nc && ${read_splines} part.nc better.nc 0.005 12"
  ARGS info better.nc --dialect klartext STDOUT "[1-9][0-9]* splines" FILE better.nc)
clsurf_cli_test(NAME optimize_splines_feeds_linuxcnc
  SETUP "${waves}; ${as_plane}; $CLSURF optimize part.nc --dialect linuxcnc --machine @DATA@/machines/three_axis_mill.toml --machines 0 --no-config --splines -o better.nc -q && grep -qE '^G5 .* F2[0-9.]+$' better.nc && ${read_splines} part.nc better.nc 0.005 12"
  ARGS info better.nc --dialect linuxcnc STDOUT "[1-9][0-9]* splines" FILE better.nc)
clsurf_cli_test(NAME optimize_splines_text SETUP "${waves}; ${as_fanuc}"
  ARGS optimize part.nc --dialect fanuc --machine @DATA@/machines/three_axis_mill.toml --machines 1 --splines -o better.nc
  STDOUT "lines +263 +1[0-9][0-9] +-[0-9.]+ %" "6 sections .[1-6] as splines., [0-9]+ lines changed. off the programmed path by at most 0[.]00[0-4]" "accepted" FILE better.nc)
clsurf_cli_test(NAME optimize_splines_json SETUP "${waves}; ${as_siemens}"
  ARGS optimize part.nc --dialect siemens --machine @DATA@/machines/three_axis_mill.toml --machines 1 --splines --json -o better.nc
  STDOUT "\"accepted\": true" "\"splines\": [1-6]" "\"lines_before\": 263" "\"lines_after\": [1-9][0-9]," "\"deviation_mm\": 0.00[0-4]" FILE better.nc)
# Without the option nothing changes.
clsurf_cli_test(NAME optimize_lines_json SETUP "${waves}"
  ARGS optimize part.nc --machine @DATA@/machines/three_axis_mill.toml --machines 1 --json -o better.nc STDOUT "\"splines\": 0" FILE better.nc)
# Line numbers are those of the replaced lines.
clsurf_cli_test(NAME optimize_splines_line_numbers
  SETUP "${waves}; ${as_siemens}; awk '{ print \"N\" 10 * NR \" \" $0 }' part.nc > n.nc; $CLSURF optimize n.nc --dialect siemens ${mill} --splines -o better.nc -q && grep -q '^N[0-9]* *BSPLINE SD=3 X' better.nc && grep -q '^N[0-9]* G1$' better.nc && ${read_splines} n.nc better.nc 0.005 12"
  ARGS --version)
# LinuxCNC has no splines in space.
clsurf_cli_test(NAME optimize_splines_in_space_linuxcnc SETUP "${waves}"
  ARGS optimize part.nc --machine @DATA@/machines/three_axis_mill.toml --machines 1 --splines -o better.nc EXIT 1
  STDOUT "refused: no section can be written as a spline: G5 moves only X and Y" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_splines_heidenhain_iso SETUP "${waves}"
  ARGS optimize part.nc --dialect heidenhain-iso --splines -o better.nc EXIT 2 STDERR "--splines: heidenhain-iso has no splines that can be written" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_splines_intervals ARGS optimize ${uneven} --splines --feeds intervals -o better.nc EXIT 2
  STDERR "--feeds intervals writes feeds on lines, not on splines" NO_FILE better.nc)
clsurf_cli_test(NAME optimize_splines_five_axes
  ARGS optimize @DATA@/programs/dome_five_axis.nc --machine @DATA@/machines/five_axis_trunnion.toml --splines -o better.nc EXIT 2
  STDERR "--splines is for programs on three axes" NO_FILE better.nc)
