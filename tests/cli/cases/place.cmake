# Positions on the part: contact points in input and output if the tool is known, otherwise tool tips.

# The contact points of check's own report, passed to query.
set(put_back "import json, subprocess, sys"
  "clsurf, tool, files = sys.argv[1], sys.argv[2], sys.argv[3:]"
  "ask = lambda *words: json.loads(subprocess.run([clsurf, *words], stdout=subprocess.PIPE, check=True).stdout)"
  "patches = ask('check', *files, '--tool', tool, '--json')['roughness']"
  "match = lambda place: ask('query', *files, '--tool', tool, '--json', '--at', ','.join(map(str, place)))['matches'][0]"
  "found = [match(p['position_mm'])['point'] == p['point'] for p in patches]"
  "print(len(found), 'asked', sum(found), 'found')")
string(REPLACE ";" "\n" put_back "${put_back}")
foreach(name bottle_uneven planted_loops planted_zigzag)
  clsurf_cli_test(NAME contacts_of_${name}_put_back
    SETUP "cat > put_back.py <<'END'
${put_back}
END
[ \"$(/usr/bin/python3 put_back.py $CLSURF ball:6 @DATA@/programs/${name}.nc @LOGS@/${name}.biip)\" = '24 asked 24 found' ]"
    ARGS --version)
endforeach()

# The metadata of this log name the tool, ball:6.
set(bottle @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip)
clsurf_cli_test(NAME query_by_a_place_on_the_part ARGS query ${bottle} --point 5000 STDOUT "contact X .* tool tip X")
clsurf_cli_test(NAME query_without_a_tool_says_tool_tip ARGS query ${bottle} --tool none --point 5000 STDOUT "tool tip X " NO_STDOUT "contact")
clsurf_cli_test(NAME query_json_has_tip_and_contact ARGS query ${bottle} --tool ball:6 --point 5000 --json
  STDOUT "\"position_mm\"" "\"tip_mm\"" "\"contact_mm\"")
clsurf_cli_test(NAME query_json_without_a_tool ARGS query ${bottle} --tool none --point 5000 --json STDOUT "\"tip_mm\"" NO_STDOUT "contact_mm")
clsurf_cli_test(NAME query_place_with_blanks ARGS query ${bottle} --tool none --at "2 -5.6 4.7" STDOUT "^line 568")
clsurf_cli_test(NAME query_place_with_commas_and_blanks ARGS query ${bottle} --tool none --at "2, -5.6, 4.7" STDOUT "^line 568")
clsurf_cli_test(NAME query_place_of_one_number ARGS query ${bottle} --at 2 EXIT 2 STDERR "'2' is not a place" "--at X,Y,Z")
clsurf_cli_test(NAME query_five_passes ARGS query ${bottle} --tool none --at "2 -5.6 4.7" --nearest 3 --json STDOUT "\"line\": 568.*\"line\": .*\"line\": ")
# A ramp of 30° milled by a ball of 6 mm: the contact point is 1.5 mm from the tip in Y.
set(ramp "awk 'BEGIN { print \"G21 G90 G54\\nG0 X0 Y0 Z20\"; for (i = 0; i < 21; ++i) printf \"G1 X%g Y%.4f Z%.6f F1200\\nX%g\\n\", i % 2 ? 20 : 0, 0.3 * i, 0.3 * i * sin(0.5236) / cos(0.5236), i % 2 ? 0 : 20; print \"M30\" }' > ramp.nc; $CLSURF simulate ramp.nc -o ramp.biip")
foreach(place "10,4.5,2.134" "10,4.5")
  string(MAKE_C_IDENTIFIER "query_on_a_ramp_${place}" name)
  clsurf_cli_test(NAME ${name} SETUP "${ramp}" ARGS query ramp.nc ramp.biip --tool ball:6 --at ${place} STDOUT "tool tip X (9[.]99|10[.]00).* Y 3[.]0000")
endforeach()
clsurf_cli_test(NAME query_on_a_ramp_without_the_tool SETUP "${ramp}" ARGS query ramp.nc ramp.biip --at 10,4.5 STDOUT "tool tip X .* Y 4[.]5000")
# The tool from the table's remark.
clsurf_cli_test(NAME query_by_the_tool_table
  SETUP "${ramp}; sed -i 's/G21/T7 M6 G21/' ramp.nc; echo 'T7 P1 D6 ; ball nose' > tool.tbl"
  ARGS query ramp.nc ramp.biip --tools tool.tbl --at 10,4.5 STDOUT "contact X (9[.]99|10[.]00).* tool tip X (9[.]99|10[.]00).* Y 3[.]0000")
clsurf_cli_test(NAME query_by_a_bad_tool ARGS query ${bottle} --tool cone:6 --point 1 EXIT 2 STDERR "cone:6.*not a ball, bull or flat tool")
# The tip of a ball that leans by 20° to alternating sides is not at its contact point: the Y of the plane identifies the pass.
set(leaning_ball "awk 'BEGIN { t = 20 * atan2(0, -1) / 180; print \"G21 G90 G54\\nG0 X0 Y0 Z20\\nG43.4 H1\"; for (i = 0; i < 6; ++i) { s = i % 2 ? 1 : -1; printf \"G0 X%g Y%.6f Z5 A%g C0\\nG1 Z%.6f F1200\\nX%g\\nG0 Z5\\n\", i % 2 ? 12 : 0, 0.6 * i + s * 3 * sin(t), s * 20, 3 - 3 * cos(t), i % 2 ? 0 : 12 } print \"M30\" }' > plane.nc; $CLSURF simulate plane.nc --machine @DATA@/machines/five_axis_trunnion.toml -o run.biip")
clsurf_cli_test(NAME query_under_a_leaning_ball SETUP "${leaning_ball}" ARGS query plane.nc run.biip --machine @DATA@/machines/five_axis_trunnion.toml --tool ball:6 --at 6,1.2,0 STDOUT "pass 3, contact X .* Y 1[.](199|200)")
clsurf_cli_test(NAME check_says_contact ARGS check ${bottle} --tool ball:6 STDOUT "contact X [-0-9.]+ Y [-0-9.]+ Z [-0-9.]+ mm, lines" NO_STDOUT "tool tip")
clsurf_cli_test(NAME check_says_tool_tip ARGS check ${bottle} --tool none STDOUT "tool tip X [-0-9.]+ Y [-0-9.]+ Z [-0-9.]+ mm, lines" NO_STDOUT "contact")
clsurf_cli_test(NAME check_json_has_tip_and_contact ARGS check ${bottle} --tool ball:6 --json STDOUT "\"tip_mm\"" "\"contact_mm\"")
clsurf_cli_test(NAME sarif_says_contact_point ARGS check ${bottle} --tool ball:6 --format sarif STDOUT "at the contact point X" "\"contact_mm\"")
clsurf_cli_test(NAME sarif_says_tool_tip ARGS check ${bottle} --tool none --format sarif STDOUT "at the tool tip X" NO_STDOUT "contact")

# The ramp in a plane tilted by 30° about Y, with a log without rotary axes: the program gives the tool axis. The contact
# X 10 Y 4.5 Z 2.134 of the plane is X 9.727 Y 4.5 Z -3.152 of the part, its tip X 10 Y 3 Z 1.732 is X 9.526 Y 3 Z -3.5.
set(tilted_ramp "${ramp}; sed 's/G54/G54 G17/; 2i CYCLE800(1,\"T\",0,57,0,0,0,0,30,0,0,0,0,1)' ramp.nc > tilted.mpf; $CLSURF simulate tilted.mpf -o tilted.biip -q")
clsurf_cli_test(NAME query_on_a_tilted_plane SETUP "${tilted_ramp}" ARGS query tilted.mpf tilted.biip --tool ball:6 --at 9.727,4.5,-3.152
  STDOUT "contact X 9[.]72[0-9]+ Y (4[.]50|4[.]49)[0-9]+ Z -3[.]1[45][0-9]+ mm, tool tip X 9[.]52[0-9]+ Y 3[.]000[0-9] Z -3[.](49|50)[0-9]+ mm")
clsurf_cli_test(NAME check_on_a_tilted_plane SETUP "${tilted_ramp}; sed -i '/Y3[.]0000/s/F1200/F600/' tilted.mpf; $CLSURF simulate tilted.mpf -o tilted.biip -q"
  ARGS check tilted.mpf tilted.biip --tool ball:6 STDOUT "contact X [-0-9.]+ Y 4[.]50 Z [-0-9.]+ mm" "as-machined surface, [0-9]+ patch")
clsurf_cli_test(NAME check_shard_on_a_tilted_plane SETUP "${tilted_ramp}; $CLSURF survey tilted.mpf tilted.biip -o run.survey -q" ARGS check tilted.mpf tilted.biip --survey run.survey --shard 1/2 --tool ball:6 -o shard.json EXIT 2 NO_FILE shard.json STDERR "shards are for tools along z: [^\n]*tilted.mpf tilts ball:6")
# Angles determine the tool axis only with the machine's kinematics: every output without contact points says so.
set(turned_ramp "${ramp}; sed 's/Z20/Z20 A30/' ramp.nc > turned.nc; mv ramp.biip turned.biip")
clsurf_cli_test(NAME info_without_the_tool_axis SETUP "${turned_ramp}" ARGS info turned.nc turned.biip STDOUT "rotary axes turn the tool or the part: without the machine's kinematics")
clsurf_cli_test(NAME query_without_the_tool_axis SETUP "${turned_ramp}" ARGS query turned.nc turned.biip --tool ball:6 --point 900 STDOUT "tool tip" NO_STDOUT "contact" STDERR "rotary axes turn the tool or the part")
clsurf_cli_test(NAME check_without_the_tool_axis SETUP "${turned_ramp}" ARGS check turned.nc turned.biip --tool ball:6 STDERR "rotary axes turn the tool or the part" "the axis of ball:6 is not known" NO_STDOUT "contact" "formed")
clsurf_cli_test(NAME report_without_the_tool_axis SETUP "${turned_ramp}" ARGS report turned.nc turned.biip --tool ball:6 -o r.html FILE r.html STDERR "rotary axes turn the tool or the part")

# lint and diff: the same ramp with one slow pass, at Y 3. Its contact is at Y 4.5 and 0.402 mm above the tip.
set(slow_ramp "${ramp}; sed '/Y3[.]0000/s/F1200/F600/' ramp.nc > slow.nc; grep -q F600 slow.nc")
clsurf_cli_test(NAME lint_says_contact SETUP "${slow_ramp}" ARGS lint slow.nc --tool ball:6 EXIT 1
  STDOUT "feed 600 .*, contact X [0-9.]+ Y 4[.]50 Z 2[.]13 mm")
clsurf_cli_test(NAME lint_says_tool_tip SETUP "${slow_ramp}" ARGS lint slow.nc EXIT 1
  STDOUT "feed 600 .*, tool tip X [0-9.]+ Y 3[.]00 Z 1[.]73 mm" "^1 warning on [0-9]+ passes" NO_STDOUT "contact")
clsurf_cli_test(NAME lint_json_has_tip_and_contact SETUP "${slow_ramp}" ARGS lint slow.nc --tool ball:6 --format json EXIT 1
  STDOUT "\"position_mm\"" "\"tip_mm\"" "\"contact_mm\"")
clsurf_cli_test(NAME lint_sarif_has_tip_and_contact SETUP "${slow_ramp}" ARGS lint slow.nc --tool ball:6 --format sarif EXIT 1
  STDOUT "contact X [0-9.]+ Y 4[.]50 Z 2[.]13 mm" "\"contact_mm\"")
clsurf_cli_test(NAME lint_by_the_tool_table
  SETUP "${slow_ramp}; sed -i 's/G21/T7 M6 G21/' slow.nc; echo 'T7 P1 D6 ; ball nose' > tool.tbl"
  ARGS lint slow.nc --tools tool.tbl EXIT 1 STDOUT "contact X [0-9.]+ Y 4[.]50 Z 2[.]13 mm")
clsurf_cli_test(NAME lint_by_the_tool_of_the_config SETUP "${slow_ramp}; echo 'tool = \"ball:6\"' > .clsurf.toml" ARGS lint slow.nc EXIT 1
  STDOUT "contact X [0-9.]+ Y 4[.]50 Z 2[.]13 mm")
clsurf_cli_test(NAME lint_of_a_program_that_turns_the_tool
  SETUP "${slow_ramp}; sed -i 's/F600/F600 A10/' slow.nc" ARGS lint slow.nc --tool ball:6 EXIT 1 STDOUT "tool tip" NO_STDOUT "contact")
set(slow_run "${slow_ramp}; $CLSURF simulate slow.nc -o slow.biip")
clsurf_cli_test(NAME diff_says_contact SETUP "${slow_run}" ARGS diff ramp.biip slow.biip --program ramp.nc --tool ball:6
  STDOUT "contact X Y Z" "speed .*[0-9.]+ 4[.]50 2[.]13 ")
clsurf_cli_test(NAME diff_says_tool_tip SETUP "${slow_run}" ARGS diff ramp.biip slow.biip --program ramp.nc
  STDOUT "tool tip X Y Z" "speed .*[0-9.]+ 3[.]00 1[.]73 ")
clsurf_cli_test(NAME diff_json_has_tip_and_contact SETUP "${slow_run}" ARGS diff ramp.biip slow.biip --program ramp.nc --tool ball:6 --json
  STDOUT "\"position_mm\"" "\"tip_mm\"" "\"contact_mm\"" NO_STDOUT "[0-9][.][0-9]{7}")
clsurf_cli_test(NAME diff_of_programs_by_the_tool_table
  SETUP "${slow_run}; sed -i 's/G21/T7 M6 G21/' ramp.nc slow.nc; echo 'T7 P1 D6 ; ball nose' > tool.tbl"
  ARGS diff ramp.nc slow.nc --tools tool.tbl STDOUT "contact X Y Z" "speed .*[0-9.]+ 4[.]50 2[.]13 ")
# The tool of the log takes precedence over that of the config file.
clsurf_cli_test(NAME tool_of_the_log_before_that_of_the_config
  SETUP "cp @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip .; echo 'tool = \"ball:20\"' > .clsurf.toml"
  ARGS query bottle_uneven.nc bottle_uneven.biip --at 0.94,-5.33,4.86 -v
  STDOUT "contact X" STDERR "the log says tool ball:6: ball:20 of .clsurf.toml is not used")

# Positions that are not on the part.
clsurf_cli_test(NAME query_off_the_part ARGS query ${bottle} --tool ball:6 --at 40,40,3 STDOUT "46[.]0057 mm away"
  STDERR "warning: --at 40,40,3 is not on the part: the nearest contact point is 46[.]006 mm away, 112 step-overs")
# For a single pass there is no step-over.
set(single_pass "printf 'G21 G90 G54\\nG0 X0 Y0 Z5\\nG1 Z0 F600\\nX30\\nM30\\n' > part.nc; $CLSURF simulate part.nc -o run.biip > /dev/null")
clsurf_cli_test(NAME query_off_a_single_pass SETUP "${single_pass}" ARGS query part.nc run.biip --at 500,500,0
  STDERR "warning: --at 500,500,0 is not on the part: the nearest tool tip is 6[0-9]+[.][0-9]+ mm away")
clsurf_cli_test(NAME query_on_a_single_pass SETUP "${single_pass}" ARGS query part.nc run.biip --at 15,2,0 --json STDOUT "\"line\": 4" NO_STDOUT "off-the-part")
clsurf_cli_test(NAME query_off_the_part_json ARGS query ${bottle} --tool ball:6 --at 40,40,3 --json STDOUT "\"distance_mm\": 46[.]0057" "query.off-the-part")
clsurf_cli_test(NAME query_nothing_below ARGS query ${bottle} --tool ball:6 --at 40,40 EXIT 2 STDERR "--at 40,40: nothing was cut there, no cutter reaches there")
clsurf_cli_test(NAME query_nothing_below_the_tip ARGS query ${bottle} --tool none --at 40,40 EXIT 2 STDERR "--at 40,40: nothing was cut there, the nearest pass is 43[.]186 mm away")
# In a groove where the ball touches both walls, the fitted normals of the passes are useless: line 11571 made this place.
clsurf_cli_test(NAME query_in_a_groove ARGS query @DATA@/programs/petal_zigzag_g64.ngc @LOGS@/petal_zigzag_g64.biip --tool ball:6 --at -10.7886,14.3171,-3.3252 STDOUT "^line 11571:")

string(JOIN " " bottle_words ${bottle})
# The page has both: marks on the surface of the tool tips, and on the as-machined one.
clsurf_cli_test(NAME page_has_tips_and_contacts
  SETUP "$CLSURF report ${bottle_words} --tool ball:6 -o r.html --max-size 4; grep -q '\"tip_mm\":' r.html; grep -q '\"contact_mm\":' r.html; grep -q '\"contact_outlines\":' r.html"
  ARGS --version)
clsurf_cli_test(NAME page_without_a_tool_has_tips
  SETUP "$CLSURF report ${bottle_words} --tool none -o r.html --max-size 4; grep -q '\"tip_mm\":' r.html; ! grep -q '\"contact_mm\":' r.html"
  ARGS --version)

# ---- a position read off a map, whose axes show the tool tip ----
clsurf_cli_test(NAME query_at_a_tip ARGS query ${bottle} "--at=tip:1.9,-5.6" STDOUT "^line 564: " "tool tip X 1.8995 Y -5.6000 Z 4.7190 mm, 0.0005 mm away" NO_STDOUT "read off a map")
clsurf_cli_test(NAME query_at_a_tip_with_a_height ARGS query ${bottle} "--at=tip:1.9 -5.6 4.72" STDOUT "^line 564: ")
clsurf_cli_test(NAME query_says_what_a_map_has_there ARGS query ${bottle} --at=1.9,-5.6 STDOUT "^line 673: .*If this place was read off a map, it is a tool tip and belongs to line 564: --at tip:1.9,-5.6")
clsurf_cli_test(NAME query_without_a_tool_has_tips ARGS query ${bottle} --tool none --at=1.9,-5.6 STDOUT "^line 564: " NO_STDOUT "read off a map")
clsurf_cli_test(NAME query_at_half_a_tip ARGS query ${bottle} --at tip:1.9 EXIT 2 STDERR "--at: 'tip:1.9' is not a place.*--at tip:X,Y for the tool tip")

# ---- rotary axes without tool centre point control: axes that were not named are at the start ----
set(wheel "printf '[kinematics]\\ntype = \"table-table\"\\nrotary = [\"a\", \"c\"]\\n' > kin.toml; printf 'G21 G90 G94 G17\\nG0 Z30\\nG0 X0 A0\\nG1 Z19 F500\\nG1 X40 A100 F1000\\nG1 X0 A0\\nG1 X40 A50\\nG0 Z30\\nM2\\n' > wheel.ngc")
clsurf_cli_test(NAME simulate_axes_that_were_not_named SETUP "${wheel}; printf 'G21 G90 G94\\nG1 X20 A40 F1000\\nM30\\n' > a40.nc" ARGS simulate a40.nc --machine kin.toml -o a40.biip STDOUT "1[.]31[0-9] s")
clsurf_cli_test(NAME simulated_axes_that_were_not_named_are_on_their_lines SETUP "${wheel}; $CLSURF simulate wheel.ngc --dialect linuxcnc --machine kin.toml -o w.biip -q" ARGS info wheel.ngc w.biip --dialect linuxcnc --machine kin.toml -v STDOUT "positions deviate by 0[.]00[0-9]+ mm .median. and 0[.]0[0-9]+ mm")
