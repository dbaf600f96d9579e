# The command line from a user's view: exit codes, messages, and no files of failed runs.
include(cli/clsurf_cli_test.cmake)

# ---- words of the command line ----
clsurf_cli_test(NAME no_subcommand ARGS EXIT 2 STDERR "usage: clsurf SUBCOMMAND")
clsurf_cli_test(NAME help ARGS --help STDOUT "subcommands:" "render" "exit codes:")
clsurf_cli_test(NAME version ARGS --version STDOUT "^clsurf ${PROJECT_VERSION}")
clsurf_cli_test(NAME help_of_a_subcommand ARGS help moves STDOUT "usage: clsurf moves" "--dialect DIALECT")
clsurf_cli_test(NAME help_fields ARGS help fields STDOUT "speed +Path speed .mm/min.")
clsurf_cli_test(NAME help_channels ARGS help channels STDOUT "line +physical line" "cmd.x.* .mm, deg.")
clsurf_cli_test(NAME help_formats ARGS help formats STDOUT "biip")
clsurf_cli_test(NAME help_dialects_as_json ARGS help dialects --json STDOUT "\"name\": \"heidenhain-iso\"")
clsurf_cli_test(NAME help_colormaps ARGS help colormaps STDOUT "viridis")
clsurf_cli_test(NAME help_on_an_unknown_topic ARGS help dialetcs EXIT 2 STDERR "did you mean 'dialects'")
clsurf_cli_test(NAME help_singular ARGS help colormap STDOUT "viridis")
clsurf_cli_test(NAME unknown_subcommand ARGS rendr EXIT 2 STDERR "unknown subcommand 'rendr'" "did you mean 'render'")
clsurf_cli_test(NAME option_before_subcommand ARGS --view top EXIT 2 STDERR "expected a subcommand, found '--view'")
clsurf_cli_test(NAME unknown_option ARGS moves --dialekt fanuc a.nc EXIT 2 STDERR "unknown option '--dialekt'" "did you mean --dialect")
clsurf_cli_test(NAME option_prefix_is_not_guessed ARGS moves --dial fanuc a.nc EXIT 2 STDERR "unknown option '--dial'")
clsurf_cli_test(NAME value_missing_at_the_end ARGS moves --dialect EXIT 2 STDERR "--dialect needs a value")
clsurf_cli_test(NAME value_missing_before_an_option ARGS moves a.nc --dialect --quiet EXIT 2 STDERR "--dialect needs a value, found '--quiet'")
clsurf_cli_test(NAME value_missing_after_equals ARGS moves a.nc --dialect= EXIT 2 STDERR "--dialect needs a value")
clsurf_cli_test(NAME value_for_a_flag ARGS moves a.nc --quiet=3 EXIT 2 STDERR "--quiet takes no value")
clsurf_cli_test(NAME option_given_twice ARGS moves a.nc --dialect fanuc --dialect siemens EXIT 2 STDERR "--dialect is given more than once")
clsurf_cli_test(NAME number_that_is_none ARGS moves a.nc --threads two EXIT 2 STDERR "--threads: 'two' is not a whole number")
clsurf_cli_test(NAME number_out_of_range ARGS moves a.nc --threads 0 EXIT 2 STDERR "--threads must be at least 1")
clsurf_cli_test(NAME number_that_does_not_fit ARGS moves a.nc --threads 99999999999 EXIT 2 STDERR "--threads: '99999999999'")
clsurf_cli_test(NAME word_not_in_the_list ARGS moves a.nc --progress alway EXIT 2 STDERR "not one of auto, always, never" "did you mean 'always'")
clsurf_cli_test(NAME argument_missing ARGS moves EXIT 2 STDERR "missing argument: PROGRAM")
clsurf_cli_test(NAME argument_too_many ARGS moves a.nc b.nc EXIT 2 STDERR "unexpected argument 'b.nc'" "usage: clsurf moves")
clsurf_cli_test(NAME negative_values_after_a_space
  ARGS render @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip -o map.png --size 160x120
       --range -5,4000 --box -3,-3,-50,3,3,50 --view -30,20 FILE map.png)
clsurf_cli_test(NAME negative_values_after_equals
  ARGS render @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip --output=map.png --size=160x120
       --range=-5,4000 --view=-30,20 FILE map.png)
clsurf_cli_test(NAME file_name_with_a_dash SETUP "echo 'G1 X-1.5 F100' > -part.nc" ARGS moves -- -part.nc
  STDOUT "1,feed,-1.5")
clsurf_cli_test(NAME standard_input SETUP "echo 'G0 X7' > stdin" ARGS moves - STDOUT "1,rapid,7")

# ---- programs that cannot be used ----
clsurf_cli_test(NAME program_missing ARGS moves nowhere.nc EXIT 3 STDERR "nowhere.nc: error: cannot open: No such file")
clsurf_cli_test(NAME program_is_a_folder SETUP "mkdir part" ARGS moves part EXIT 3 STDERR "part: error: is a folder")
clsurf_cli_test(NAME program_is_empty SETUP ": > part.nc" ARGS moves part.nc EXIT 3 STDERR "part.nc: error: .*empty")
clsurf_cli_test(NAME program_is_binary SETUP "head -c 100000 @LOGS@/bottle_uneven.biip > part.nc" ARGS moves part.nc
  EXIT 3 STDERR "part.nc")
clsurf_cli_test(NAME program_in_an_unknown_dialect SETUP "echo 'G0 X7' > part.nc" ARGS moves part.nc --dialect fanuk
  EXIT 2 STDERR "fanuk" "did you mean 'fanuc'")
clsurf_cli_test(NAME program_calls_itself SETUP "printf 'O1\\nM98 P1\\nM30\\n' > part.nc" ARGS moves part.nc EXIT 3
  STDERR "part.nc:2")
clsurf_cli_test(NAME program_never_ends SETUP "printf 'o1 while [1 EQ 1]\\nG1 X1 F100\\no1 endwhile\\nM2\\n' > part.nc"
  ARGS moves part.nc --dialect linuxcnc EXIT 3 STDERR "part.nc:")
clsurf_cli_test(NAME program_with_a_wrong_arc
  SETUP "printf 'G0 X0 Y0\\nG2 X10 Y0 I4 J0 F100\\n' > part.nc" ARGS moves part.nc EXIT 3
  STDERR "part.nc:2:" "4" "6")

# ---- tool tables ----
clsurf_cli_test(NAME tools_of_the_user
  SETUP "printf 'T7 D4 Z10\\n' > part.tbl; printf 'T7 M6\\nG43\\nG0 X1\\nG41 D7\\nG1 X10 F60\\n' > part.ngc"
  ARGS moves part.ngc --dialect linuxcnc --tools part.tbl STDOUT "3,rapid,1,0,-10," "5,feed,10,2,-10,")
clsurf_cli_test(NAME tools_missing SETUP "echo 'G0 X7' > part.nc" ARGS moves part.nc --tools nowhere.tbl EXIT 3
  STDERR "nowhere.tbl: error: cannot open")
clsurf_cli_test(NAME tools_malformed SETUP "echo 'G0 X7' > part.nc; echo 'T1 D' > part.tbl" ARGS info part.nc --tools part.tbl
  EXIT 3 STDERR "part.tbl:1:5: error: expected a number after D")

# ---- logs that cannot be used ----
set(part @DATA@/programs/bottle_uneven.nc)
clsurf_cli_test(NAME log_missing ARGS render ${part} nowhere.biip -o map.png EXIT 3 STDERR "nowhere.biip: error: cannot open")
clsurf_cli_test(NAME log_is_empty SETUP ": > run.biip" ARGS render ${part} run.biip -o map.png EXIT 3 STDERR "run.biip: error: is empty")
clsurf_cli_test(NAME log_is_a_folder SETUP "mkdir run.biip" ARGS render ${part} run.biip -o map.png EXIT 3 STDERR "run.biip: error")
clsurf_cli_test(NAME log_of_no_format SETUP "head -c 5000 @DATA@/../docs/guide/map.png > run.biip"
  ARGS render ${part} run.biip -o map.png EXIT 3 STDERR "not a log in a known format")
clsurf_cli_test(NAME log_cut_inside_its_header SETUP "head -c 60 @LOGS@/bottle_uneven.biip > run.biip"
  ARGS render ${part} run.biip -o map.png EXIT 3 STDERR "run.biip")
clsurf_cli_test(NAME log_cut_inside_a_record SETUP "head -c 100000 @LOGS@/bottle_uneven.biip > run.biip"
  ARGS render ${part} run.biip -o map.png --size 160x120 EXIT 0 FILE map.png STDERR "warning")
# record_bytes, channel_count, metadata_bytes and header_bytes of 2^32 − 1 must be rejected.
foreach(field 12 16 20 40)
  clsurf_cli_test(NAME log_with_a_gigantic_number_at_${field}
    SETUP "head -c 100000 @LOGS@/bottle_uneven.biip > run.biip; printf '\\377\\377\\377\\377' | dd of=run.biip bs=1 seek=${field} conv=notrunc status=none"
    ARGS render ${part} run.biip -o map.png EXIT 3 STDERR "run.biip")
endforeach()
clsurf_cli_test(NAME log_with_a_later_major_version
  SETUP "head -c 100000 @LOGS@/bottle_uneven.biip > run.biip; printf '\\002' | dd of=run.biip bs=1 seek=8 conv=notrunc status=none"
  ARGS render ${part} run.biip -o map.png EXIT 3 STDERR "run.biip.*version")

# ---- outputs that cannot be written ----
clsurf_cli_test(NAME output_missing ARGS render ${part} @LOGS@/bottle_uneven.biip EXIT 2 STDERR "output")
clsurf_cli_test(NAME output_in_no_folder ARGS render ${part} @LOGS@/bottle_uneven.biip -o nowhere/map.png EXIT 4 STDERR "nowhere/map.png")
clsurf_cli_test(NAME output_below_a_file SETUP ": > file" ARGS render ${part} @LOGS@/bottle_uneven.biip -o file/map.png EXIT 4 STDERR "file/map.png")
clsurf_cli_test(NAME output_is_a_folder SETUP "mkdir map.png" ARGS render ${part} @LOGS@/bottle_uneven.biip -o map.png --size 160x120 EXIT 4 STDERR "map.png")
clsurf_cli_test(NAME standard_output_is_full SETUP "ln -s /dev/full stdout" ARGS moves @DATA@/programs/bottle_uneven.nc EXIT 4 STDERR "standard output: No space left")
clsurf_cli_test(NAME bad_input_keeps_the_old_picture SETUP "echo old > map.png; echo > run.biip"
  ARGS render ${part} run.biip -o map.png EXIT 3 FILE map.png STDERR "run.biip")

# ---- the test runner itself: what it must detect ----
function(clsurf_runner_test name)
  add_test(NAME cli.runner_finds_${name} COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/cli/run_cli_test
    ${CMAKE_CURRENT_BINARY_DIR}/cli/runner_finds_${name} /bin/bash ${ARGN})
  set_tests_properties(cli.runner_finds_${name} PROPERTIES
    PASS_REGULAR_EXPRESSION "FAILED: " TIMEOUT 20)
endfunction()
clsurf_runner_test(a_wrong_exit_code --exit 3 -- -c "exit 2")
clsurf_runner_test(a_missing_message --stderr bad -- -c "echo good >&2")
clsurf_runner_test(a_file_left_behind --exit 3 -- -c "echo error >&2; echo x > left; exit 3")
clsurf_runner_test(a_file_beside_one_that_is_meant --exit 3 --file one -- -c "echo error >&2; echo x > one; echo x > left; exit 3")
clsurf_runner_test(a_missing_file --file map.png -- -c "exit 0")
clsurf_runner_test(an_empty_file --file map.png -- -c ": > map.png")
clsurf_runner_test(silence --exit 3 -- -c "exit 3")
clsurf_runner_test(nothing_left --left yes -- -c "exit 0")

# ---- answers of the subcommands ----
set(run @LOGS@/bottle_uneven.biip)
clsurf_cli_test(NAME moves_columns ARGS moves @DATA@/programs/mixed.ngc STDOUT "line,kind,x,y,z,a,b,c,ci,cj,ck,turns,plane,feed" "ccw,")
clsurf_cli_test(NAME info_of_both ARGS info ${part} ${run} STDOUT "positions deviate by 0.000[0-9] mm")
# A recorded log is fine: there is one note, about its distance to the program.
foreach(sample bottle_uneven.nc bottle_zigzag.nc dome_loops.nc transition_g61.nc petal_zigzag_g64.ngc petal_zigzag_irregular.ngc petal_loops_g64.ngc)
  string(REGEX REPLACE "[.].*" "" name ${sample})
  clsurf_cli_test(NAME info_of_good_${name} ARGS info @DATA@/programs/${sample} @LOGS@/${name}.biip
    STDOUT "togo.*note: [^:]*: positions deviate by 0.0" NO_STDOUT "log, format.*(warning|error|remark|note:.*note:)")
endforeach()
# Generated logs are fine as well, and reproducible.
set(make_sample $<TARGET_FILE:clsurf_make_sample>)
foreach(pattern zigzag one-way loops)
  clsurf_cli_test(NAME info_of_made_${pattern}
    SETUP "${make_sample} ${pattern} 100000 a.nc a.biip; cp a.nc first.nc; ${make_sample} ${pattern} 100000 a.nc b.biip; cmp a.nc first.nc; cmp a.biip b.biip"
    ARGS info a.nc a.biip STDOUT "100000 records" "positions deviate by 0.0000 mm .median. and 0.0000 mm" NO_STDOUT "log, format.*(warning|error|remark|note:.*note:)")
endforeach()
clsurf_cli_test(NAME render_of_made_one_way SETUP "${make_sample} one-way 200000 a.nc a.biip"
  ARGS render a.nc a.biip -o map.png --size 160x120 -v FILE map.png)
clsurf_cli_test(NAME info_of_good_csv ARGS info @LOGS@/mixed.csv --period 0.001 STDOUT "  OK: a record every 1 ms, no jumps")
clsurf_cli_test(NAME info_of_good_raw ARGS info @LOGS@/petal_spiral.raw --layout @DATA@/logs/petal_spiral.layout.toml STDOUT "  OK: a record every 1 ms, no jumps")
set(own_run @DATA@/programs/bottle_uneven.nc @LOGS@/bottle_uneven.biip)
clsurf_cli_test(NAME info_says_ok ARGS info ${own_run} STDOUT "  OK: a run of the unmodified bottle_uneven.nc, all of it, a record every 1 ms, no jumps")
clsurf_cli_test(NAME info_says_ok_in_json ARGS info ${own_run} --json STDOUT "\"ok\": true" "\"verdict\": \"OK: a run of the unmodified bottle_uneven.nc, all of it")
clsurf_cli_test(NAME info_of_a_part_says_care SETUP "head -c 1000000 @LOGS@/bottle_uneven.biip > cut.biip" ARGS info @DATA@/programs/bottle_uneven.nc cut.biip
  STDOUT "  usable with care: 2 warnings, see below" NO_STDOUT "OK:")
clsurf_cli_test(NAME info_of_another_program_says_no ARGS info @DATA@/programs/bottle_zigzag.nc @LOGS@/bottle_uneven.biip EXIT 3 STDOUT "  not usable as it is: 1 error, see below" NO_STDOUT "OK:")
clsurf_cli_test(NAME info_of_a_lathe_log SETUP "(echo time,x,z; seq 0 99 | awk '{printf \"%.3f,20,%.3f\\n\", $1/1000, -$1/100}') > lathe.csv" ARGS info lathe.csv
  STDOUT "whether x, z are commanded or measured" "this axis is assumed to stay at 0" "cmd.x .mm., cmd.z .mm.")
clsurf_cli_test(NAME export_of_a_log_without_lines SETUP "(echo time,x,z; seq 0 99 | awk '{printf \"%.3f,20,%.3f\\n\", $1/1000, -$1/100}') > lathe.csv" ARGS export lathe.csv -o - --columns point,line,x,y,z
  STDOUT "[^0-9]99,0,20,0,-0.99" NO_STDOUT "4294967295")
# One run in the formats of several controls: lines and positions fit the program in each.
foreach(form halscope.csv twincat.csv trace.xml)
  clsurf_cli_test(NAME info_of_${form} ARGS info @DATA@/programs/dome_loops.nc @LOGS@/dome_loops.${form}
    STDOUT "18531 records every 1 ms" "positions deviate by 0.0" NO_STDOUT "log, format.*(warning|error)")
  clsurf_cli_test(NAME query_of_${form} ARGS query @DATA@/programs/dome_loops.nc @LOGS@/dome_loops.${form} --point 9000 --json STDOUT "\"line\": 863" "\"confidence\": 1.0")
endforeach()
clsurf_cli_test(NAME query_of_events ARGS query @DATA@/programs/dome_loops.nc @LOGS@/dome_loops.signals.csv --mapping @DATA@/logs/dome_loops.events.mapping.toml --point 9000 --json
  STDOUT "\"line\": 863" "\"confidence\": 1.0")
clsurf_cli_test(NAME info_of_edge ARGS info @LOGS@/edge_300.json EXIT 3 STDOUT "log, format edge" "300 records every 2 ms" "cmd.x .mm., .*cmd.b .deg." "DES_POS.3 .deg." "program" "axis .Z1. turns: " "neither commanded, feedback nor actual positions have all of x, y and z" NO_STDOUT "cmd.z" "jumps by [0-9]+[.]")
# Subcommands that need positions say which one the recording lacks.
clsurf_cli_test(NAME check_edge_without_z ARGS check @DATA@/programs/keychain.mpf @LOGS@/edge_300.json EXIT 3 STDERR "no commanded positions: channel .cmd.z. is missing")
clsurf_cli_test(NAME convert_edge SETUP "$CLSURF convert @LOGS@/edge_300.json -o edge.biip" ARGS info edge.biip --json EXIT 3 STDOUT "\"records\": 300" "\"program\"" "DES_POS.3")
clsurf_cli_test(NAME info_of_compressed ARGS info @DATA@/logs/dome_loops.biip.xz STDOUT "18531 records")
clsurf_cli_test(NAME info_of_compressed_program SETUP "gzip -c @DATA@/programs/dome_loops.nc > part.nc" ARGS info part.nc STDOUT "program, dialect")
clsurf_cli_test(NAME compressed_cut SETUP "head -c 1000 @DATA@/logs/dome_loops.biip.xz > run.biip" ARGS info run.biip EXIT 3 STDERR "run.biip: byte 1000: error: the compressed data end here")
clsurf_cli_test(NAME edge_damaged SETUP "sed '20s/:/;/' @LOGS@/edge_300.json > run.json" ARGS info run.json EXIT 3 STDERR "run.json:20:[0-9]*: error: is not valid JSON")
clsurf_cli_test(NAME trace_damaged SETUP "sed '8s/=/ /' @LOGS@/dome_loops.trace.xml > run.xml" ARGS info run.xml EXIT 3 STDERR "run.xml:8:[0-9]*: error: is not valid XML")
# Two runs in one log, a part of a run, a stop: reported, and the lines are right with and without line numbers.
set(one_run "awk 'BEGIN {print \"cmd.x,cmd.y,cmd.z,line\"} {print $2 \",\" $3 \",\" $4 \",\" $8}' @LOGS@/dome_loops.halsampler.txt > one.csv")
set(two_runs "${one_run}; (cat one.csv; tail -n +2 one.csv) > run.csv")
set(part_of_run "${one_run}; (head -n 1 one.csv; sed -n 8002,15001p one.csv) > run.csv")
set(stopped_run "${one_run}; awk 'NR == 9001 {for (i = 0; i < 3000; ++i) print} {print}' one.csv > run.csv")
clsurf_cli_test(NAME two_runs SETUP "${two_runs}" ARGS info @DATA@/programs/dome_loops.nc run.csv --period 0.001 STDOUT "point 18541: the program begins again at line 7: run 2")
clsurf_cli_test(NAME two_runs_without_lines SETUP "${two_runs}" ARGS query @DATA@/programs/dome_loops.nc run.csv --period 0.001 --ignore-lines --point 27530 --json STDOUT "\"line\": 86[23]")
clsurf_cli_test(NAME part_of_run SETUP "${part_of_run}" ARGS info @DATA@/programs/dome_loops.nc run.csv --period 0.001 STDOUT "begins at line 771: 42 % of the program.s motions are missing before it" "ends at line 1451")
clsurf_cli_test(NAME part_of_run_without_lines SETUP "${part_of_run}" ARGS query @DATA@/programs/dome_loops.nc run.csv --period 0.001 --ignore-lines --point 999 --json STDOUT "\"line\": 86[23]")
clsurf_cli_test(NAME stopped_run SETUP "${stopped_run}" ARGS info @DATA@/programs/dome_loops.nc run.csv --period 0.001 STDOUT "stands still for 3.0 s on line 863")
clsurf_cli_test(NAME stopped_run_without_lines SETUP "${stopped_run}" ARGS query @DATA@/programs/dome_loops.nc run.csv --period 0.001 --ignore-lines --point 12010 --json STDOUT "\"line\": 86[34]")
clsurf_cli_test(NAME info_json ARGS info ${run} --json STDOUT "\"records\": 27517" "\"closed\": true")
clsurf_cli_test(NAME info_program_json ARGS info ${part} --json STDOUT "\"feed\": 3704" "\"kind\": \"program\"")
clsurf_cli_test(NAME info_wrong_program ARGS info @DATA@/programs/petal_loops_g64.ngc ${run} EXIT 3 STDOUT "another program")
# A log in machine coordinates: the offset is reported, and passing it as an option helps.
set(displace "$CLSURF export ${part} ${run} -o run.csv --columns time,x,y,z,line --work-offset -312.5,48.125,101.3; sed -i '1s/.*/time,cmd.x,cmd.y,cmd.z,line/' run.csv")
set(displace_without_lines "$CLSURF export ${part} ${run} -o run.csv --columns time,x,y,z --work-offset -312.5,48.125,101.3; sed -i '1s/.*/time,cmd.x,cmd.y,cmd.z/' run.csv")
clsurf_cli_test(NAME work_offset_unknown SETUP "${displace}" ARGS info ${part} run.csv
  STDOUT "displaced by X 312.5 Y -48.125 Z -101.3 mm" "hint: --work-offset 312.5,-48.125,-101.3 aligns them")
clsurf_cli_test(NAME work_offset_unknown_without_lines SETUP "${displace_without_lines}"
  ARGS query ${part} run.csv --point 5000 STDERR "hint: --work-offset 312.5,-48.125,-101.3 aligns them" STDOUT "confidence 0.0")
# The same in inches without a unit in the header: no offset aligns it.
clsurf_cli_test(NAME unit_unknown
  SETUP "$CLSURF export ${part} ${run} -o mm.csv --columns time,x,y,z,line && awk -F, 'NR == 1 { print \"time,cmd.x,cmd.y,cmd.z,line\"; next } { printf \"%s,%.7f,%.7f,%.7f,%s\\n\", $1, $2 / 25.4, $3 / 25.4, $4 / 25.4, $5 }' mm.csv > run.csv"
  ARGS check ${part} run.csv EXIT 3 STDERR "as if they were in inch" "hint: name the unit in the header of the log, as in .x .inch..")
clsurf_cli_test(NAME work_offset_given SETUP "${displace}" ARGS info ${part} run.csv --work-offset 312.5,-48.125,-101.3
  STDOUT "positions deviate by 0.000[0-9] mm" NO_STDOUT "displaced" "another program")
clsurf_cli_test(NAME work_offset_given_without_lines SETUP "${displace_without_lines}"
  ARGS query ${part} run.csv --point 5000 --work-offset 312.5,-48.125,-101.3 STDOUT "^line 63[78]" "confidence 1.0")
clsurf_cli_test(NAME work_offset_wrong ARGS info ${part} ${run} --work-offset 1,2 EXIT 2 STDERR "--work-offset: '1,2' is not 3 or 4 numbers")
clsurf_cli_test(NAME info_layout ARGS info @LOGS@/petal_spiral.raw --layout @DATA@/logs/petal_spiral.layout.toml STDOUT "84271 records")
clsurf_cli_test(NAME query_at ARGS query ${part} ${run} --tool none --at -5.87,0,2.45 STDOUT "^line 1768")
clsurf_cli_test(NAME query_at_no_place ARGS query ${part} ${run} --tool none --at 1e300,0,0 EXIT 1 STDOUT "no logged point is there" NO_STDOUT "comment")
# Line 14 runs inside O3, called in line 10 of O2, which was called in line 6 for the second time.
set(nested_calls "printf '%s\\n' O1 'G21 G90 G54' 'G0 X0 Y0 Z0' 'M98 P2' 'G0 X0 Y10' 'M98 P2' M30 O2 G91 'M98 P3' G90 M99 O3 'G1 X5 F600' M99 > nested.nc; $CLSURF simulate nested.nc -o run.biip")
clsurf_cli_test(NAME query_of_nested_calls SETUP "${nested_calls}" ARGS query nested.nc run.biip --at 3,10,0
  STDOUT "line 14: G1 X5 F600" "in nested.nc line 14: G1 X5 F600" "called by nested.nc line 10: M98 P3.*called by nested.nc line 6: M98 P2")
clsurf_cli_test(NAME query_of_nested_calls_without_lines SETUP "${nested_calls}" ARGS query nested.nc run.biip --at 3,0,0 --ignore-lines --json
  STDOUT "\"subprogram\": .*\"line\": 14,.*\"calls\": .*\"line\": 4,.*\"line\": 10,")
clsurf_cli_test(NAME query_outside_of_calls SETUP "${nested_calls}" ARGS query nested.nc run.biip --at 0,7,0 --json STDOUT "\"calls\": \\[\\]" "\"subprogram\": null")
# A plane milled by a ball of 6 mm that leans by 20° to alternating sides, with its centre on passes 0.6 mm apart: scallops
# are those of an upright one, 0.6²/(8 · 3) = 15 µm, although the tips of two neighbours are 0.6 ± 2.05 mm apart.
set(trunnion @DATA@/machines/five_axis_trunnion.toml)
set(leaning "awk 'BEGIN { t = 20 * atan2(0, -1) / 180; print \"G21 G90 G54\\nG0 X0 Y0 Z20\\nG43.4 H1\"; for (i = 0; i < 6; ++i) { s = i % 2 ? 1 : -1; printf \"G0 X%g Y%.6f Z5 A%g C0\\nG1 Z%.6f F1200\\nX%g\\nG0 Z5\\n\", i % 2 ? 12 : 0, 0.6 * i + s * 3 * sin(t), s * 20, 3 - 3 * cos(t), i % 2 ? 0 : 12 } print \"M30\" }' > plane.nc; $CLSURF simulate plane.nc --machine ${trunnion} -o run.biip")
clsurf_cli_test(NAME check_of_a_leaning_ball SETUP "${leaning}" ARGS check plane.nc run.biip --machine ${trunnion} --tool ball:6
  EXIT 5  # two of six passes have only one neighbour: not enough for a verdict
  STDOUT "scallop between passes without defects, with ball:6: 15.0" "as-machined surface, .* Rz 1[45][.].. .at most 15")
clsurf_cli_test(NAME check_of_a_leaning_bull SETUP "${leaning}" ARGS check plane.nc run.biip --machine ${trunnion} --tool bull:6,1
  EXIT 5 STDERR "bull:6,1 is tilted: the as-machined surface and its roughness are available for ball-end tools only")
clsurf_cli_test(NAME query_json ARGS query ${part} ${run} --point 5000 --json STDOUT "\"line\": 638" "\"confidence\": 1.0")
clsurf_cli_test(NAME query_time ARGS query ${part} ${run} --time 3.2 STDOUT "point 3200 at 3.200 s")
clsurf_cli_test(NAME query_time_before ARGS query ${part} ${run} --time -5 EXIT 2 STDERR "--time -5: the log lasts from 0 to 27[.]516")
clsurf_cli_test(NAME query_time_after ARGS query ${part} ${run} --time 9999 EXIT 2 STDERR "--time 9999: the log lasts from 0 to 27[.]516")
clsurf_cli_test(NAME query_line ARGS query ${part} ${run} --line 515 STDOUT "X1.053 Z4.590")
clsurf_cli_test(NAME query_by_geometry ARGS query ${part} ${run} --point 5000 --ignore-lines --json STDOUT "\"line\": 63[78]")
clsurf_cli_test(NAME query_nothing_asked ARGS query ${part} ${run} EXIT 2 STDERR "--point N, --at X,Y,Z")
clsurf_cli_test(NAME query_far_point ARGS query ${part} ${run} --point 99999 EXIT 2 STDERR "the log has points 0 … 27516")
clsurf_cli_test(NAME render_through_egl ARGS render ${part} ${run} -o map.png --size 160x120 --gl egl FILE map.png)
clsurf_cli_test(NAME render_marks_outside ARGS render ${part} ${run} -o map.png --size 160x120 --box 0,-4,-10,6,4,10 --mark-point 13462 --mark-line 515 EXIT 0 FILE map.png
  STDERR "point 13462 lies outside the part that is shown" "line 515 lies outside")
clsurf_cli_test(NAME render_nothing_shown ARGS render ${part} ${run} -o map.png --size 160x120 --box 100,100,100,101,101,101 EXIT 2 STDERR "no cutting point lies in the part that is shown")
clsurf_cli_test(NAME output_is_a_device ARGS render ${part} ${run} -o /dev/full --size 160x120 EXIT 4 STDERR "No space left on device")
clsurf_cli_test(NAME render_one_point SETUP "echo 'G1 X1 F60' > a.nc; printf 'time,cmd.x,cmd.y,cmd.z\\n0,1,0,0\\n' > a.csv"
  ARGS render a.nc a.csv --period 0.001 -o map.png EXIT 3 STDERR "no value on any cutting point")
clsurf_cli_test(NAME render_unknown_field ARGS render ${part} ${run} -o map.png --color sped EXIT 2 STDERR "did you mean 'speed'")
clsurf_cli_test(NAME render_missing_role ARGS render ${part} ${run} -o map.png --surface actual EXIT 3 STDERR "channel 'act.x' is missing")
clsurf_cli_test(NAME render_says_its_stages ARGS render ${part} ${run} -o map.png --size 160x120 -v FILE map.png STDERR "stitch the surface +[0-9.]+ s")
clsurf_cli_test(NAME render_shows_progress ARGS render ${part} ${run} -o map.png --size 160x120 --progress always FILE map.png STDERR "stitch the surface")
clsurf_cli_test(NAME plot ARGS plot ${part} ${run} -o c.png --size 320x240 --fields speed,acceleration --line 515 FILE c.png)
clsurf_cli_test(NAME plot_empty_range ARGS plot ${part} ${run} -o c.png --from 5 --to 4 EXIT 2 STDERR "--from must be less")
clsurf_cli_test(NAME export_csv ARGS export ${part} ${run} -o p.csv --columns line,x,speed FILE p.csv)
clsurf_cli_test(NAME export_vtp ARGS export ${part} ${run} -o p.vtp FILE p.vtp)
clsurf_cli_test(NAME export_vtkhdf ARGS export ${part} ${run} -o p.vtkhdf FILE p.vtkhdf)
clsurf_cli_test(NAME export_hdf ARGS export ${part} ${run} -o p.hdf FILE p.hdf)
clsurf_cli_test(NAME export_biip ARGS export ${part} ${run} -o p.biip FILE p.biip)
foreach(ending vtp vtkhdf)
  clsurf_cli_test(NAME export_${ending}_keeps_integers ARGS --version
    SETUP "$CLSURF export ${part} ${run} -o p.${ending} --columns point,line,pass,time,speed -q && /usr/bin/python3 -B ${CMAKE_CURRENT_LIST_DIR}/read_vtk.py p.${ending}")
endforeach()
clsurf_cli_test(NAME export_lists_columns ARGS export ${part} ${run} --list STDOUT "  line  *Program line.*  speed .*mm/min" "  cmd.x  " NO_STDOUT "orientation_error")
clsurf_cli_test(NAME export_lists_columns_as_json ARGS export ${run} --list --json STDOUT "\"columns\"" "\"unit\": \"mm/min\"")
clsurf_cli_test(NAME export_list_writes_no_file ARGS export ${part} ${run} --list -o p.csv EXIT 2 STDERR "--list writes no file")
clsurf_cli_test(NAME export_json_is_of_the_list ARGS export ${part} ${run} -o p.csv --json EXIT 2 STDERR "--list")
clsurf_cli_test(NAME export_unknown_form ARGS export ${part} ${run} -o p.xls EXIT 2 STDERR "must end in")
clsurf_cli_test(NAME convert ARGS convert @LOGS@/mixed.csv --period 0.001 -o m.biip FILE m.biip)
clsurf_cli_test(NAME convert_names_the_program
  SETUP "cp ${part} part.nc; $CLSURF convert ${run} --program part.nc --program @DATA@/programs/mixed.ngc -o run.biip"
  ARGS info part.nc run.biip STDOUT "positions deviate by 0.000[0-9] mm" NO_STDOUT "SHA-256")
clsurf_cli_test(NAME edited_program_in_info
  SETUP "cp ${part} part.nc; $CLSURF convert ${run} --program part.nc -o run.biip; echo '(edited)' >> part.nc"
  ARGS info part.nc run.biip
  STDOUT "warning: run.biip: part.nc was edited after the run: the log was recorded with part.nc .[0-9]+ bytes, SHA-256 [0-9a-f]+…., this file has")
clsurf_cli_test(NAME edited_program_in_query
  SETUP "cp ${part} part.nc; $CLSURF convert ${run} --program part.nc -o run.biip; echo '(edited)' >> part.nc"
  ARGS query part.nc run.biip --point 5000 STDERR "part.nc was edited after the run" STDOUT "^line 638")
clsurf_cli_test(NAME other_program_in_render
  SETUP "$CLSURF convert ${run} --program @DATA@/programs/mixed.ngc -o run.biip"
  ARGS render ${part} run.biip -o map.png --size 160x120 FILE map.png
  STDERR "bottle_uneven.nc is not the program that ran: the log was recorded with mixed.ngc")
clsurf_cli_test(NAME convert_missing_program ARGS convert ${run} --program nowhere.nc -o m.biip EXIT 3 STDERR "nowhere.nc: error: cannot open")
clsurf_cli_test(NAME convert_without_period ARGS convert @LOGS@/mixed.csv -o m.biip EXIT 3 STDERR "sampling period")
set(shot ${PROJECT_SOURCE_DIR}/tests/snapshots/baseline)
clsurf_cli_test(NAME compare_same ARGS compare ${shot}/speed_iso.png ${shot}/speed_iso.png --json STDOUT "\"equal\": true")
clsurf_cli_test(NAME compare_different ARGS compare ${shot}/speed_iso.png ${shot}/speed_top.png --diff d.png EXIT 1 FILE d.png)
clsurf_cli_test(NAME compare_no_image ARGS compare @DATA@/programs/mixed.ngc @DATA@/programs/mixed.ngc EXIT 3 STDERR "cannot be read as an image")
clsurf_cli_test(NAME compare_updates SETUP "cp ${shot}/speed_iso.png a.png" ARGS compare a.png b.png --update FILE b.png)

# ---- the predictor ----
clsurf_cli_test(NAME check_text ARGS check ${part} ${run} --tool ball:6
  STDOUT "point_spacing .*-83.0 .* 2408-2568" "scallop between passes without defects, with ball:6: 7")
# The planted defects, and no others: data/logs/README.md.
clsurf_cli_test(NAME check_planted_zigzag ARGS check @DATA@/programs/planted_zigzag.nc @LOGS@/planted_zigzag.biip --tool ball:6
  STDOUT "2 distinct lag_step +6[.][0-9] +-0[.][0-9] +9[.][0-9] pit +4[.]2 +9[.][0-9].*lines 747-753, 679-686" "3 visible +lag_step .* 3[.][0-9] bulge .*lines 1785-1792, 1883-1889"
         "1 visible +feed_drop +8[.][0-9] +-24[.]1 +1[.]0 pit .* 1797-1800" "3 defects on 40 passes")
clsurf_cli_test(NAME check_planted_loops ARGS check @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip --tool ball:6
  STDOUT "3 distinct lag_step .* 10[.]0 pit .* 1133-1137, 1303-1308" "2 visible +feed_drop .*-21[.]4 .* 2389-2394, 2656-2660"
         "1 visible +feed_drop .*-23[.]0 .* 2263-2270, 2537-2543" "3 defects on 25 passes")
clsurf_cli_test(NAME check_json ARGS check ${part} ${run} --json
  STDOUT "\"cause\": \"point_spacing\"" "\"quantity\": \"speed\"" "\"within_budget\": true" "\"worst_severity\": 4")
clsurf_cli_test(NAME check_csv ARGS check ${part} ${run} --tool none --format csv -o marks.csv FILE marks.csv)
clsurf_cli_test(NAME check_sarif ARGS check ${part} ${run} --tool none --format sarif
  STDOUT "\"version\": \"2.1.0\"" "\"startLine\": 2408" "\"ruleId\": \"point_spacing\"")
clsurf_cli_test(NAME check_budget_held SETUP "echo 'max_defects = 1000' > part.toml" ARGS check ${part} ${run} --tool none --budget part.toml
  STDOUT "max_defects .* kept")
clsurf_cli_test(NAME check_budget_not_held SETUP "echo 'max_depth_um = 5' > part.toml" ARGS check ${part} ${run} --tool none --budget part.toml -o report.txt
  EXIT 1 FILE report.txt)
clsurf_cli_test(NAME check_budget_unknown_key SETUP "echo 'max_dept_um = 5' > part.toml" ARGS check ${part} ${run} --budget part.toml
  EXIT 3 STDERR "part.toml:1" "unknown key 'max_dept_um'" "did you mean 'max_depth_um'")
clsurf_cli_test(NAME check_budget_negative SETUP "echo 'max_depth_um = -5' > part.toml" ARGS check ${part} ${run} --budget part.toml
  EXIT 3 STDERR "part.toml:1" "must not be negative")
clsurf_cli_test(NAME check_budget_missing ARGS check ${part} ${run} --budget nowhere.toml EXIT 3 STDERR "nowhere.toml: error: cannot open")
clsurf_cli_test(NAME check_roughness ARGS check ${part} ${run} --tool ball:6 --json STDOUT "\"rz_um\": [0-9.]+" "\"ra_um\": [0-9.]+" "\"sa_um\"" "\"sz_um\"" "\"formed_um\"" "\"roughness\": .[^a-z]*\"point\": [0-9]+")
clsurf_cli_test(NAME check_without_a_tool_has_no_roughness ARGS check ${part} ${run} --tool none --json NO_STDOUT "rz_um" "formed_um")
clsurf_cli_test(NAME render_formed ARGS render ${part} ${run} --surface formed --tool ball:6 --size 400x300 -o map.png FILE map.png)
clsurf_cli_test(NAME render_formed_bull_along_the_commanded_path
  ARGS render ${part} ${run} --surface formed --tool bull:6,1 --swept commanded --view top --size 400x300 -o map.png FILE map.png)
clsurf_cli_test(NAME render_formed_without_a_tool ARGS render ${part} ${run} --tool none --surface formed -o map.png EXIT 2 STDERR "needs to know the tool" "--tool ball:6")
clsurf_cli_test(NAME render_formed_with_a_field ARGS render ${part} ${run} --surface formed --tool ball:6 --color speed -o map.png EXIT 2 STDERR "--color")
clsurf_cli_test(NAME formed_is_no_surface_to_query ARGS check ${part} ${run} --surface formed EXIT 2 STDERR "not one of")
clsurf_cli_test(NAME profile_without_a_tool ARGS plot ${part} ${run} --tool none --profile 0,0,1,1 -o cut.png EXIT 2 STDERR "needs to know the tool")
clsurf_cli_test(NAME profile_and_fields ARGS plot ${part} ${run} --profile 0,0,1,1 --tool ball:6 --fields speed -o cut.png EXIT 2 STDERR "--fields does not apply to --profile")
clsurf_cli_test(NAME profile_where_nothing_was_cut ARGS plot ${part} ${run} --profile 900,900,901,900 --tool ball:6 -o cut.png EXIT 2 STDERR "nothing was cut")
clsurf_cli_test(NAME check_wrong_tool ARGS check ${part} ${run} --tool cone:6 EXIT 2 STDERR "cone:6.*not a ball, bull or flat tool")
clsurf_cli_test(NAME check_two_formats ARGS check ${part} ${run} --json --format csv EXIT 2 STDERR "use either --json or --format")
clsurf_cli_test(NAME check_of_the_commanded_path ARGS check ${part} ${run} --surface commanded STDOUT "no measured positions")

# ---- machine files ----
clsurf_cli_test(NAME machine_defaults ARGS machine --defaults STDOUT "lookahead_blocks = 500" "position_gain = 100")
clsurf_cli_test(NAME machine_defaults_can_be_used SETUP "$CLSURF machine --defaults > m.toml" ARGS machine --check m.toml STDOUT "m.toml: three-axis mill: can be used")
clsurf_cli_test(NAME machine_sample_is_the_default SETUP "$CLSURF machine --defaults | cmp - @DATA@/machines/three_axis_mill.toml"
  ARGS machine --check @DATA@/machines/linuxcnc_logs.toml STDOUT "can be used")
clsurf_cli_test(NAME machine_unknown_key SETUP "printf '[path]\\nmax_sped = 5\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:2" "unknown key 'max_sped'" "did you mean 'max_speed'")
clsurf_cli_test(NAME machine_zero_limit SETUP "printf '[path]\\nmax_jerk = 0\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:2" "'max_jerk' is 0, expected more than 0")
clsurf_cli_test(NAME machine_travel_reversed SETUP "printf '[[axis]]\\nname = \"x\"\\ntravel = [5, -5]\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:3" "travel is reversed")
clsurf_cli_test(NAME machine_axis_twice SETUP "printf '[[axis]]\\nname = \"x\"\\n[[axis]]\\nname = \"x\"\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:4" "axis 'x' is given twice")
clsurf_cli_test(NAME machine_unknown_corner SETUP "printf '[controller]\\ncorner = \"stpo\"\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:2" "'stpo', which is not known" "did you mean 'stop'")
clsurf_cli_test(NAME machine_loop_does_not_settle SETUP "printf '[[axis]]\\nname = \"x\"\\n[axis.servo]\\nposition_gain = 300\\nvelocity_time_constant = 0.004\\n' > m.toml"
  ARGS machine --check m.toml EXIT 3 STDERR "m.toml:3" "does not settle")
clsurf_cli_test(NAME machine_integral_time_below_the_period SETUP "printf '[[axis]]\\nname = \"x\"\\n[axis.servo]\\nvelocity_integral_time = 0.0005\\n' > m.toml"
  ARGS machine --check m.toml EXIT 3 STDERR "m.toml:4" "it must be 0, or at least the period of 0.001 s")
clsurf_cli_test(NAME machine_gain_of_its_own_does_not_settle SETUP "printf '[controller]\\nperiod = 0.05\\n' > m.toml" ARGS machine --check m.toml EXIT 3 STDERR "axis 'x': with a position_gain of 100 1/s and a period of 0.05 s the loop does not settle" "at most 20")
clsurf_cli_test(NAME machine_missing_file ARGS machine --check nowhere.toml EXIT 3 STDERR "nowhere.toml: error: cannot open")
clsurf_cli_test(NAME machine_needs_one ARGS machine EXIT 2 STDERR "one of --defaults and FILE")

clsurf_cli_test(NAME machine_five_axes ARGS machine --check @DATA@/machines/five_axis_trunnion.toml STDOUT "can be used")
clsurf_cli_test(NAME machine_kinematics_type SETUP "printf '[kinematics]\\ntype = \"table-tabel\"\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:2" "did you mean 'table-table'")
clsurf_cli_test(NAME machine_kinematics_pair SETUP "printf '[kinematics]\\ntype = \"head-head\"\\nrotary = [\"c\", \"c\"]\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:3" "same axis twice")
clsurf_cli_test(NAME machine_kinematics_order SETUP "printf '[kinematics]\\ntype = \"head-head\"\\nrotary = [\"c\", \"a\"]\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:1" "c is parallel to the tool" "tilting axis first")
clsurf_cli_test(NAME machine_kinematics_sign SETUP "printf '[kinematics]\\ntype = \"head-head\"\\nsigns = { a = 2 }\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:3" "expected 1 or -1")
clsurf_cli_test(NAME machine_kinematics_offset SETUP "printf '[kinematics]\\ntype = \"head-head\"\\n[kinematics.offsets]\\no = [1, 2, 3]\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:4" "is not an offset of a head-head machine")
clsurf_cli_test(NAME machine_axis_without_kinematics SETUP "printf '[[axis]]\\nname = \"a\"\\n' > m.toml" ARGS machine --check m.toml
  EXIT 3 STDERR "m.toml:2" "'a', which is not known")

# ---- five axes ----
set(trunnion "printf '[kinematics]\\ntype = \"table-table\"\\n' > m.toml")
# A quarter turn of C moves the axes from (10, 0) to (0, −10): the tip does not move.
set(turning "printf 'cmd.x,cmd.y,cmd.z,cmd.a,cmd.c,line\\n10,0,0,0,0,1\\n7.0710678119,-7.0710678119,0,0,45,1\\n0,-10,0,0,90,1\\n0,-10,5,0,90,2\\n' > turn.csv && printf 'G43.4 G1 X10 Y0 Z0 C90 F100\\nZ5\\n' > turn.nc")
clsurf_cli_test(NAME five_axis_positions
  SETUP "${trunnion} && ${turning} && $CLSURF export turn.nc turn.csv --period 0.001 --machine m.toml -o out.csv --columns x,y,z,tool_axis.z -q && tail -n +2 out.csv | awk -F, '($1-10)^2 + $2^2 > 1e-12 || $4 != 1 { exit 1 }'"
  ARGS query turn.nc turn.csv --period 0.001 --machine m.toml --at 10,0,5 STDOUT "line 2: Z5" "point 3 ")
clsurf_cli_test(NAME five_axis_without_the_machine SETUP "${turning}" ARGS query turn.nc turn.csv --period 0.001 --point 2 STDERR "axis c moves by 90.00 deg" "--machine")
clsurf_cli_test(NAME five_axis_query SETUP "${trunnion} && ${turning}" ARGS query turn.nc turn.csv --period 0.001 --machine m.toml --point 2 --json
  STDOUT "\"position_mm\": ?\\[[^0-9]*(9\\.99999|10)")
clsurf_cli_test(NAME five_axis_channel_missing SETUP "${trunnion} && ${turning} && cut -d, -f1-3,6 turn.csv > less.csv" ARGS query turn.nc less.csv --period 0.001 --machine m.toml --point 2
  EXIT 3 STDERR "channel 'cmd.a' is missing")
clsurf_cli_test(NAME tool_axis_needs_the_machine SETUP "${turning}" ARGS export turn.nc turn.csv --period 0.001 -o out.csv --columns tool_axis.x EXIT 2 STDERR "needs the kinematics" "--machine")
clsurf_cli_test(NAME moves_tool_axis SETUP "${trunnion} && printf 'G90 G0 X0 Y0 Z0\\nG43.5 H1\\nG1 X1 I0.6 J0 K0.8 F100\\n' > v.nc" ARGS moves v.nc --machine m.toml
  STDOUT "feed,ti,tj,tk" "0.6,0,0.8")

# ---- controller simulation ----
set(simulated @DATA@/programs/bottle_uneven.nc)
clsurf_cli_test(NAME simulate_text ARGS simulate ${simulated} -o run.biip STDOUT "greatest jerk" "off the path +0.00[45]" FILE run.biip)
clsurf_cli_test(NAME simulate_json ARGS simulate ${simulated} --machine @DATA@/machines/linuxcnc_logs.toml -o run.biip --json
  STDOUT "\"limits_ok\": true" "\"points\": [0-9]+" "\"speed_mm_min\"" FILE run.biip)
clsurf_cli_test(NAME simulate_json_limit_share SETUP "$CLSURF simulate ${simulated} -o run.biip --json > report.json; python3 -c \"import json; r = json.load(open('report.json')); share = r['limit_share']; assert set(share) == set(r['points_ruled_by']) and all(abs(share[k] - 100 * n / r['points']) < 0.001 for k, n in r['points_ruled_by'].items()); assert abs(sum(share.values()) - 100) < 0.01\"" ARGS --version)
clsurf_cli_test(NAME simulate_log_is_trusted SETUP "$CLSURF simulate ${simulated} -o run.biip" ARGS info ${simulated} run.biip
  NO_STDOUT "warning" STDOUT "limit")
clsurf_cli_test(NAME simulate_log_renders SETUP "$CLSURF simulate ${simulated} -o run.biip"
  ARGS render ${simulated} run.biip -o why.png --size 160x120 --color limit FILE why.png)
clsurf_cli_test(NAME simulate_without_output ARGS simulate ${simulated} EXIT 2 STDERR "output")
foreach(dialect linuxcnc fanuc)
  clsurf_cli_test(NAME simulate_starts_where_the_axes_stand_${dialect}
    SETUP "printf 'G21 G90\\nG1 X40 F600\\nM2\\n' > a.nc && $CLSURF simulate a.nc --dialect ${dialect} --start 30,20,10 -o a.biip -q && $CLSURF export a.biip --columns x,y,z -o a.csv && sed -n 2p a.csv | grep -q '^30[.0-9]*,20,10$' && tail -n 1 a.csv | grep -q '^40,20,10$'"
    ARGS --version)
endforeach()
# LinuxCNC knows the position of the axes: incremental words count from it.
clsurf_cli_test(NAME simulate_goes_on_from_where_the_axes_stand
  SETUP "printf 'G21 G91\\nG1 X10 Z-2 F600\\nM2\\n' > a.ngc && $CLSURF simulate a.ngc --dialect linuxcnc --start 30,20,10 -o a.biip -q && $CLSURF export a.biip --columns x,y,z -o a.csv && tail -n 1 a.csv | grep -q '^40,20,8$'"
  ARGS --version)
clsurf_cli_test(NAME simulate_wrong_start ARGS simulate ${simulated} -o run.biip --start 1,2 EXIT 2 STDERR "--start")
clsurf_cli_test(NAME simulate_bad_machine SETUP "printf '[path]\\nmax_speed = -1\\n' > m.toml" ARGS simulate ${simulated} --machine m.toml -o run.biip
  EXIT 3 STDERR "m.toml:2" "'max_speed' is -1" NO_FILE run.biip)
clsurf_cli_test(NAME simulate_bad_servo SETUP "printf '[[axis]]\\nname = \"x\"\\n[axis.servo]\\nbacklash = -1\\n' > m.toml" ARGS simulate ${simulated} --machine m.toml -o run.biip
  EXIT 3 STDERR "m.toml:4" "'backlash' is -1" NO_FILE run.biip)
clsurf_cli_test(NAME simulate_bad_block_time SETUP "printf '[controller]\\nblock_time = 2\\n' > m.toml" ARGS simulate ${simulated} --machine m.toml -o run.biip
  EXIT 3 STDERR "m.toml:2" "at most 1" NO_FILE run.biip)
clsurf_cli_test(NAME simulate_rotary_axis SETUP "printf 'G1 X1 F100\\nG1 X2 A5\\n' > a.nc" ARGS simulate a.nc -o run.biip
  EXIT 3 STDERR "a.nc:2" "a rotary axis moves" NO_FILE run.biip)
clsurf_cli_test(NAME simulate_five_axes SETUP "printf 'G90\\nG43.4 H1\\nG1 X10 F2000\\nX20 A-20 C90\\nX30\\n' > a.nc"
  ARGS simulate a.nc --machine @DATA@/machines/five_axis_trunnion.toml --work-offset 10,0,100 -o run.biip --json STDOUT "\"limits_ok\": true" "\"orientation_error_deg\"" "\"c\":" FILE run.biip)
clsurf_cli_test(NAME simulate_five_axes_and_back
  SETUP "printf 'G90\\nG43.4 H1\\nG1 X10 F2000\\nX20 A-20 C90\\nX30\\n' > a.nc && $CLSURF simulate a.nc --machine @DATA@/machines/five_axis_trunnion.toml --work-offset 10,0,100 -o run.biip -q"
  ARGS query a.nc run.biip --machine @DATA@/machines/five_axis_trunnion.toml --at 15,0,0 --ignore-lines STDOUT "line 4: X20 A-20 C90" "Y -?0.000")
clsurf_cli_test(NAME simulate_work_offset_of_three_axes ARGS simulate ${simulated} --work-offset 1,2,3 -o run.biip EXIT 2 STDERR "rotary axes" NO_FILE run.biip)
clsurf_cli_test(NAME simulate_feed_of_zero SETUP "printf 'G1 X1 F100\\nG1 X2 F0\\n' > a.nc" ARGS simulate a.nc -o run.biip
  EXIT 3 STDERR "a.nc:2" "without a feed" NO_FILE run.biip)
clsurf_cli_test(NAME simulate_outside_the_travel SETUP "printf 'G1 X1000 F9000\\n' > a.nc" ARGS simulate a.nc -o run.biip
  STDERR "a.nc:1: warning: x leaves its travel" FILE run.biip)

# ---- comparison of runs ----
set(as_recorded "$CLSURF convert @LOGS@/mixed.csv --period 0.001 -o a.biip; cp a.biip again.biip; $CLSURF convert @LOGS@/mixed.csv --period 0.002 -o slow.biip")
clsurf_cli_test(NAME diff_of_equal_runs ARGS diff ${run} ${run} --tool none --program ${part}
  STDOUT "100.0 % of" "speed .mm/min. +0.00 +0.00 +0.00 +0.00 +0.00 +0.00 +0.0 +0" "height .µm. +0.00 +0.00 +0.00 +0.00 +0.00 +0.00 +0.0 +0")
clsurf_cli_test(NAME diff_of_another_format ARGS diff @LOGS@/dome_loops.biip @LOGS@/dome_loops.twincat.csv --tool none --json
  STDOUT "\"aligned_percent\": 100.0" "\"differences\": .." "\"within_budget\": true")
clsurf_cli_test(NAME diff_of_half_the_speed SETUP "${as_recorded}" ARGS diff a.biip slow.biip --program @DATA@/programs/mixed.ngc
  STDOUT "100.0 % of" "speed +-(49.9|50.0) % +-49.9 %")
clsurf_cli_test(NAME diff_lists_three_of_each_quantity ARGS diff @LOGS@/bottle_uneven.biip @LOGS@/bottle_uneven_repaired.biip --tool none --program @DATA@/programs/bottle_uneven.nc
  STDOUT "4 speed" "9 lag" "17 height" "[0-9]+ acceleration" "and [0-9]+ more: --json")
clsurf_cli_test(NAME diff_budget_not_held SETUP "${as_recorded}; echo 'max_speed_difference_percent = 10' > runs.toml"
  ARGS diff a.biip slow.biip --budget runs.toml --json EXIT 1 STDOUT "\"within_budget\": false" "\"max_speed_difference_percent\"")
clsurf_cli_test(NAME diff_budget_held SETUP "${as_recorded}; printf 'max_height_difference_um = 1\\nmin_aligned_percent = 99\\n' > runs.toml"
  ARGS diff a.biip slow.biip --budget runs.toml STDOUT "max_height_difference_um .* kept")
clsurf_cli_test(NAME diff_budget_unknown_key SETUP "echo 'max_depth_um = 1' > runs.toml" ARGS diff ${run} ${run} --budget runs.toml
  EXIT 3 STDERR "runs.toml:1" "unknown key 'max_depth_um'")
clsurf_cli_test(NAME diff_names_the_run_that_drifted SETUP "${as_recorded}" ARGS diff a.biip slow.biip again.biip STDOUT "slow.biip drifted: speed")
clsurf_cli_test(NAME diff_two_runs_name_none SETUP "${as_recorded}" ARGS diff a.biip slow.biip --json NO_STDOUT "drifted")
clsurf_cli_test(NAME diff_map ARGS diff ${part} ${run} --machine @DATA@/machines/linuxcnc_logs.toml -o map.png --size 320x240 --color height
  FILE map.png STDOUT "lag .µm.")
clsurf_cli_test(NAME diff_of_another_part ARGS diff @LOGS@/dome_loops.biip ${run} -o map.png EXIT 3 STDERR "shares no path with")
clsurf_cli_test(NAME diff_map_of_a_lag_that_nobody_knows SETUP "${as_recorded}; $CLSURF export @DATA@/programs/mixed.ngc a.biip -o a.csv --columns cmd.x,cmd.y,cmd.z"
  ARGS diff a.csv a.csv --period 0.001 -o map.png --color lag EXIT 2 STDERR "--color lag: the runs do not have measured positions")
clsurf_cli_test(NAME diff_unknown_quantity ARGS diff ${run} ${run} --color hight EXIT 2 STDERR "hight.* is not" "did you mean 'height'")
clsurf_cli_test(NAME diff_needs_two ARGS diff ${run} EXIT 2 STDERR "missing argument: B")
clsurf_cli_test(NAME diff_missing_file ARGS diff ${run} nowhere.biip EXIT 3 STDERR "nowhere.biip: error: cannot open")

# ---- killed, on a full disk, with inputs that change ----
foreach(mode kill full inputs)
  add_test(NAME hostile.${mode} COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/cli/hostile_test
    ${PROJECT_BINARY_DIR}/tests/hostile_${mode} $<TARGET_FILE:clsurf> ${PROJECT_SOURCE_DIR}/data ${PROJECT_BINARY_DIR}/samples ${mode})
  set_tests_properties(hostile.${mode} PROPERTIES TIMEOUT 300)
endforeach()

# ---- problems in a program, and its repair ----
set(uneven @DATA@/programs/bottle_uneven.nc)
clsurf_cli_test(NAME lint_finds_crowded_points ARGS lint @DATA@/programs/petal_zigzag_irregular.ngc EXIT 1 STDOUT "points 0.040 mm apart on pass 7, 0.990 mm" "point-spacing" "^[0-9]+ warnings( and [0-9]+ notes?)? on 121 passes")
clsurf_cli_test(NAME lint_json ARGS lint ${uneven} --json EXIT 1 STDOUT "\"by_rule\"" "\"step_over_mm\": 0.4" "\"tolerance_um\": 5" "\"programs\"")
clsurf_cli_test(NAME lint_sarif ARGS lint ${uneven} --format sarif -o part.sarif EXIT 1 FILE part.sarif)
clsurf_cli_test(NAME lint_of_a_clean_program SETUP "printf 'G0 X0 Y0 Z0\nG1 X10 F600\nX20\n' > a.nc" ARGS lint a.nc STDOUT "nothing found" "no adjacent passes")
clsurf_cli_test(NAME lint_wrong_tolerance ARGS lint ${uneven} --tolerance 0 EXIT 2 STDERR "--tolerance must be above 0 mm")
clsurf_cli_test(NAME lint_format_twice ARGS lint ${uneven} --json --format text EXIT 2 STDERR "use either --json or --format")
clsurf_cli_test(NAME lint_summary_first ARGS lint ${uneven} EXIT 1 STDOUT "^[0-9]+ warnings( and [0-9]+ notes?)? on [0-9]+ passes, 0[.]4[0-9]* mm apart.*point-spacing [0-9]+.*:[0-9]+-[0-9]+: warning")
set(two_programs "cp ${uneven} b.nc; printf 'G0 X0 Y0 Z0\nG1 X10 F600\nX20\n' > a.nc")
clsurf_cli_test(NAME lint_several SETUP "${two_programs}" ARGS lint a.nc b.nc EXIT 1
  STDOUT "^2 programs: 1 with warnings" "program[[:space:]]+[0-9]+ +[0-9]+ +[0-9]+  b.nc[[:space:]]+0 +0 +1  a.nc  .no adjacent passes." "b.nc: [0-9]+ warnings" "b.nc:[0-9]+-[0-9]+: warning")
clsurf_cli_test(NAME lint_several_clean SETUP "${two_programs}; cp a.nc c.nc" ARGS lint a.nc c.nc STDOUT "^2 programs: 0 with warnings")
clsurf_cli_test(NAME lint_several_json SETUP "${two_programs}" ARGS lint a.nc b.nc --json EXIT 1
  STDOUT "\"program\": \"a.nc\"" "\"program\": \"b.nc\"" "\"programs\"" "\"rule\": \"point-spacing\"")
clsurf_cli_test(NAME lint_several_sarif
  SETUP "${two_programs}; cp b.nc c.nc; $CLSURF lint a.nc b.nc c.nc -o all.sarif || test $? = 1; test $(grep -c '\"id\": \"point-spacing\"' all.sarif) = 1 && grep -q '\"uri\": \"b.nc\"' all.sarif && grep -q '\"uri\": \"c.nc\"' all.sarif"
  ARGS --version FILE all.sarif)
clsurf_cli_test(NAME lint_several_one_missing SETUP "${two_programs}" ARGS lint a.nc nowhere.nc EXIT 3 STDERR "nowhere.nc: error")
clsurf_cli_test(NAME lint_missing_program ARGS lint nowhere.nc EXIT 3 STDERR "nowhere.nc: error")

# ---- the linked page (its behaviour in a browser: tests/page) ----
clsurf_cli_test(NAME report_writes_one_file SETUP "$CLSURF report ${part} ${run} --tool none -o r.html -q && grep -q '<p>Slow: [0-9]* of F3000 mm/min: blocks of 0.02' r.html"
  ARGS --version)
clsurf_cli_test(NAME report_of_chosen_fields ARGS report ${part} ${run} -o r.html --fields speed,jerk --color jerk --tool none --max-size 4 FILE r.html)
clsurf_cli_test(NAME report_without_output ARGS report ${part} ${run} EXIT 2 STDERR "output")
clsurf_cli_test(NAME report_unknown_field ARGS report ${part} ${run} -o r.html --tool none --fields sped EXIT 2 STDERR "did you mean 'speed'")
clsurf_cli_test(NAME report_colours_what_it_does_not_have ARGS report ${part} ${run} -o r.html --tool none --fields speed,jerk --color height EXIT 2 STDERR "height")
clsurf_cli_test(NAME report_size_that_is_none ARGS report ${part} ${run} -o r.html --max-size 0.1 EXIT 2 STDERR "--max-size must be 2")
clsurf_cli_test(NAME report_before_that_is_missing ARGS report ${part} ${run} -o r.html --tool none --before nowhere.biip EXIT 3 STDERR "nowhere.biip: error: cannot open")
clsurf_cli_test(NAME report_into_no_folder ARGS report ${part} ${run} -o nowhere/r.html EXIT 4 STDERR "nowhere")
clsurf_cli_test(NAME report_of_a_single_pass SETUP "printf 'G1 X0 Y0 F600\\nX20\\n' > a.nc; $CLSURF simulate a.nc -o a.biip" ARGS report a.nc a.biip -o r.html FILE r.html)
