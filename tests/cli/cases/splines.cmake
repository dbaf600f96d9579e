# Programs with splines, from words to statements about their logs.

set(spline_forms trident.ngc trident.g6.ngc trident.nc trident.mpf)
foreach(form IN LISTS spline_forms)
  string(REPLACE "." "_" name ${form})
  # Chords within 0.1 µm: 732 chords are 48.9954 mm long, the curve 48.9956 mm.
  clsurf_cli_test(NAME spline_moves_${name}
    SETUP "$CLSURF moves @DATA@/programs/${form} > moves.csv && awk -F, '$2 == \"spline\" { n++; l += sqrt(($3 - x)^2 + ($4 - y)^2) } { x = $3; y = $4 } END { exit !(n > 400 && n < 1500 && l > 48.995 && l < 48.9957) }' moves.csv"
    ARGS info @DATA@/programs/${form} --json STDOUT "\"spline\": 4" "\"cutting_length_mm\": 48[.]9956")
  clsurf_cli_test(NAME spline_simulated_${name} SETUP "printf '[controller]\\nperiod = 0.001\\n' > machine.toml"
    ARGS simulate @DATA@/programs/${form} --machine machine.toml -o run.biip --json
    STDOUT "\"duration_s\": 1[.]35" "\"limits_ok\": true")
endforeach()

# The tool is on the curve: in the middle of the first span of the trident, x = 16.458333, y = 14.375.
clsurf_cli_test(NAME spline_query SETUP "$CLSURF simulate @DATA@/programs/trident.nc -o run.biip -q"
  ARGS query @DATA@/programs/trident.nc run.biip --at 16.4583,14.375,0 STDOUT "^line 9: K0 X10 Y20 R1" "0[.]0[0-4][0-9]* mm away")
clsurf_cli_test(NAME spline_log_belongs SETUP "$CLSURF simulate @DATA@/programs/butterfly_nurbs.mpf -o run.biip -q"
  ARGS info @DATA@/programs/butterfly_nurbs.mpf run.biip
  STDOUT "48 splines" "positions deviate by 0[.]000. mm .median. and 0[.]00[0-9]* mm" NO_STDOUT "note: .*jumps")
clsurf_cli_test(NAME spline_lint ARGS lint @DATA@/programs/trident.nc STDOUT "chord error 0[.]00 µm")
clsurf_cli_test(NAME spline_by_the_trapezoidal_planner
  SETUP "printf '[controller]\\nperiod = 0.001\\nplanner = \"trapezoidal\"\\n' > machine.toml"
  ARGS simulate @DATA@/programs/trident.ngc --machine machine.toml -o run.biip --json STDOUT "\"limits_ok\": true" "\"path_deviation_mm\": 0")
# On five axes with constant angles.
clsurf_cli_test(NAME spline_on_a_five_axis_machine
  ARGS simulate @DATA@/programs/trident.nc --machine @DATA@/machines/five_axis_trunnion.toml -o run.biip STDOUT "points, 1[.]")

# A cubic whose control polygon crosses itself has a cusp: the axes stop there, and no limit is exceeded.
clsurf_cli_test(NAME spline_with_a_cusp SETUP "printf 'G0 X0 Y0 Z0\\nG64 P0.01\\nG1 X-5 F3000\\nX0\\nG5 I10 J10 P-10 Q10 X10 Y0\\nG1 X15\\nM2\\n' > cusp.ngc"
  ARGS simulate cusp.ngc --dialect linuxcnc -o run.biip --json STDOUT "\"limits_ok\": true")
# On five axes with A and C away from zero.
clsurf_cli_test(NAME spline_with_a_cusp_on_five_axes SETUP "printf 'G43.4 H1\\nG64 P0.01\\nG1 X-5 A-20 C30 F3000\\nX0\\nG5 I10 J10 P-10 Q10 X10 Y0\\nG1 X15\\nM2\\n' > cusp.ngc"
  ARGS simulate cusp.ngc --dialect linuxcnc --machine @DATA@/machines/five_axis_trunnion.toml -o run.biip --json STDOUT "\"limits_ok\": true")
