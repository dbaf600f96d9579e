# Measurements of a part from a simple dexel simulator (tests/measured/dexel_part.py) that shares no code with the product:
# pose, roughness and planted marks.

set(dexel "python3 ${PROJECT_SOURCE_DIR}/tests/measured/dexel_part.py")
set(stylus --measured profile.csv --measured-at 7.1,2.9,90)
foreach(part_tool ball=ball:6 tilted_ball=ball:6 bull=bull:8,2)
  string(REPLACE "=" ";" part_tool ${part_tool})
  list(GET part_tool 0 cut_part)
  list(GET part_tool 1 tool)
  clsurf_cli_test(NAME measured_profile_of_${cut_part}
    SETUP "${dexel} make . --part ${cut_part}; $CLSURF check part.nc run.csv --tool ${tool} --measured profile.csv --measured-at 7.1,2.9,90 --json > ../r.json; ${dexel} check . --part ${cut_part} --report ../r.json"
    ARGS check part.nc run.csv --tool ${tool} ${stylus} --picture p.png FILE p.png
    STDOUT "measured profile.csv: profile of 3001 places" "  Ra [0-9.]+ µm measured, [0-9.]+ µm predicted" "marks found: 1 [(]" "correlation (0[.]99|1[.]000)")
endforeach()
clsurf_cli_test(NAME measured_profile_without_the_mark
  SETUP "${dexel} make . --without-mark; $CLSURF check part.nc run.csv --tool ball:6 --measured profile.csv --measured-at 7.1,2.9,90 --json > ../r.json; ${dexel} check . --without-mark --report ../r.json"
  ARGS check part.nc run.csv --tool ball:6 ${stylus} STDOUT "marks missing: 1 [(]0[.]" NO_STDOUT "marks found")
foreach(mark "" "--without-mark")
  clsurf_cli_test(NAME measured_map${mark}
    SETUP "${dexel} make . --measure areal ${mark}; $CLSURF check part.nc run.csv --tool ball:6 --measured map.sdf --measured-at 7.1,4.3,90 --json > ../r.json; ${dexel} check . ${mark} --report ../r.json"
    ARGS align map.sdf part.nc run.csv --tool ball:6 --measured-at 7.1,4.3,90 STDOUT "areal map of 3383 places, 1 more without a height" "its origin is at X 7[.](09|10)[0-9]+ Y 4[.](299|300)")
endforeach()
clsurf_cli_test(NAME align_touched_points
  SETUP "${dexel} make . --measure touch; $CLSURF align cmm.csv part.nc run.csv --tool ball:6 --json > ../r.json; ${dexel} check . --report ../r.json"
  ARGS align cmm.csv part.nc run.csv --tool ball:6 STDOUT "cmm.csv: points of 648 places. 0[.][0-9]+ µm rms" "c [+]0[.]0[0-9]+° ± ")
clsurf_cli_test(NAME align_on_even_passes SETUP "${dexel} make . --part flat_plane --without-mark"
  ARGS align profile.csv part.nc run.csv --tool ball:6 --measured-at 7.1,2.9,90 EXIT 5 STDOUT "not determined: another pose, [0-9.]+ mm away, fits as well")
# Without its angle, the profile is along a pass, which is smooth.
clsurf_cli_test(NAME measured_without_its_angle SETUP "${dexel} make ."
  ARGS check part.nc run.csv --tool ball:6 --measured profile.csv --measured-at 7.1,2.9 EXIT 5 STDOUT "not determined: " NO_STDOUT "marks found")
clsurf_cli_test(NAME align_without_the_angle SETUP "${dexel} make ."
  ARGS align profile.csv part.nc run.csv --tool ball:6 --measured-at 7.1,2.9 EXIT 5 STDOUT "not determined: ")
clsurf_cli_test(NAME align_profile_without_a_start SETUP "${dexel} make ."
  ARGS align profile.csv part.nc run.csv --tool ball:6 EXIT 5 STDOUT "not determined: the profile does not say where on the part it begins")

set(three "printf 'x,z\\n0,1\\n1,2\\n2,3\\n' > m.csv")
set(bottle @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip)
clsurf_cli_test(NAME measured_without_a_tool SETUP "${three}" ARGS check ${bottle} --tool none --measured m.csv --measured-at 0,0 EXIT 2 STDERR "--measured needs to know the tool")
clsurf_cli_test(NAME measured_as_sarif SETUP "${three}" ARGS check ${bottle} --tool ball:6 --measured m.csv --format sarif EXIT 2 STDERR "reported as text and JSON, not as sarif")
clsurf_cli_test(NAME measured_of_two_logs SETUP "${three}" ARGS check ${bottle} @LOGS@/bottle_zigzag.biip --tool ball:6 --measured m.csv EXIT 2 STDERR "--measured accepts one log")
clsurf_cli_test(NAME measured_options_alone ARGS check ${bottle} --picture p.png EXIT 2 NO_FILE p.png STDERR "--picture needs --measured")
clsurf_cli_test(NAME measured_place_alone ARGS check ${bottle} --measured-at 1,2 EXIT 2 STDERR "--measured-at needs --measured")
clsurf_cli_test(NAME measured_free_of_a_profile SETUP "${three}" ARGS align m.csv ${bottle} --tool ball:6 --measured-at 0,0 --measured-free y EXIT 2 STDERR "a profile does not determine y")
clsurf_cli_test(NAME measured_free_unknown SETUP "${three}" ARGS align m.csv ${bottle} --tool ball:6 --measured-free q EXIT 2 STDERR "'q' is none of x, y, z, a, b and c")
clsurf_cli_test(NAME measured_bad_number SETUP "printf 'x,z\\n0,1\\n1,oops\\n' > m.csv" ARGS align m.csv ${bottle} --tool ball:6 EXIT 3 STDERR "m.csv:3: error: 'oops' in column 'z' is not a number")
clsurf_cli_test(NAME measured_program_instead ARGS align ${bottle} ${bottle} --tool ball:6 EXIT 2 STDERR "argument|too many")

# The page has the numbers of `check` and the picture; without an initial pose nothing can be compared.
clsurf_cli_test(NAME report_measured SETUP "${dexel} make . && $CLSURF report part.nc run.csv --tool ball:6 --fields speed -o r.html -q --measured profile.csv --measured-at 7.1,2.9,90 && $CLSURF check part.nc run.csv --tool ball:6 --measured profile.csv --measured-at 7.1,2.9,90 > r.txt; ra=$(sed -n 's/^  Ra \\([0-9.]*\\) µm measured, \\([0-9.]*\\) µm.*/<td>Ra<.td><td>\\1<.td><td>\\2<.td>/p' r.txt) && test -n \"$ra\" && grep -q \"$ra\" r.html && grep -q '1 is found and 0 are missing' r.html && grep -q 'data-defect=.1.><td>1</td><td>found</td>' r.html && grep -q 'alt=.Measured profile. src=.data:image/png' r.html && $CLSURF report part.nc run.csv --tool ball:6 --fields speed -o r.html -q --measured profile.csv && grep -q 'Its place on the part is not determined' r.html && ! grep -q 'Measured profile' r.html"
  ARGS --version)
clsurf_cli_test(NAME report_measured_without_a_tool SETUP "${three}" ARGS report ${bottle} --tool none --measured m.csv --measured-at 0,0 -o r.html EXIT 2 NO_FILE r.html STDERR "--measured needs to know the tool")
clsurf_cli_test(NAME report_measured_place_alone ARGS report ${bottle} --measured-at 1,2 -o r.html EXIT 2 NO_FILE r.html STDERR "--measured-at needs --measured")
clsurf_cli_test(NAME report_measured_and_follow SETUP "${three}" ARGS report ${bottle} --measured m.csv --follow -o r.html EXIT 2 NO_FILE r.html STDERR "--measured does not apply to --follow")
