# Whether a log belongs to its program: foreign, edited and truncated ones, and lines that run repeatedly.
set(uneven @DATA@/programs/bottle_uneven.nc)
set(zigzag @DATA@/programs/bottle_zigzag.nc)
set(uneven_log @LOGS@/bottle_uneven.biip)

# ---- a log of another program ----
set(foreign_error "bottle_uneven.biip: error: does not belong to .*bottle_zigzag.nc: 100 % of [0-9]+ checked points")
foreach(subcommand "check" "query --point 9" "render -o out.png" "report -o out.html" "plot -o out.png" "export -o out.csv")
  separate_arguments(words UNIX_COMMAND "${subcommand}")
  list(POP_FRONT words name)
  clsurf_cli_test(NAME foreign_log_in_${name} ARGS ${name} ${zigzag} ${uneven_log} ${words} EXIT 3 STDERR "${foreign_error}" "--force")
endforeach()
clsurf_cli_test(NAME foreign_log_in_info ARGS info ${zigzag} ${uneven_log} EXIT 3 STDOUT "error: .*does not belong to .*bottle_zigzag.nc")
clsurf_cli_test(NAME foreign_log_forced ARGS check ${zigzag} ${uneven_log} --tool none --force EXIT 5
  STDOUT "NOT JUDGED: The log does not belong to this program" STDERR "warning: does not belong to")
# A program that lacks most of its lines, with the log of the complete program.
set(cut_off "head -n 1000 ${uneven} > cut.nc; $CLSURF export ${uneven} ${uneven_log} --columns time,line,x,y,z -o run.csv -q")
set(cut_off_error "moving points have line numbers that the program of 1000 lines does not have: 100[1-9] … 371[0-9]")
clsurf_cli_test(NAME log_of_a_program_that_was_cut_off SETUP "${cut_off}" ARGS check cut.nc run.csv EXIT 3
  STDERR "run.csv: error: does not fit cut.nc: [0-9]+ of [0-9]+ ${cut_off_error}" "the program was cut off")
clsurf_cli_test(NAME info_of_a_program_that_was_cut_off SETUP "${cut_off}" ARGS info cut.nc run.csv EXIT 3
  STDOUT "error: .*does not belong to cut.nc: [0-9]+ of [0-9]+ ${cut_off_error}")
clsurf_cli_test(NAME log_of_a_program_that_lacks_its_end
  SETUP "head -n 3000 ${uneven} > cut.nc; $CLSURF export ${uneven} ${uneven_log} --columns time,line,x,y,z -o run.csv -q"
  ARGS check cut.nc run.csv --tool none STDERR "warning: [0-9]+ of [0-9]+ moving points have line numbers that the program of 3000 lines does not have")
clsurf_cli_test(NAME info_of_a_log_without_positions EXIT 3
  SETUP "printf '[log]\\nformat = \"delimited\"\\nperiod_s = 0.001\\n[[column]]\\nfrom = \"a\"\\nname = \"cmd.x\"\\nunit = \"mm\"\\n' > map.toml; (echo a; seq 1 50) > run.csv"
  ARGS info run.csv --mapping map.toml STDOUT "error: .*neither commanded, feedback nor actual positions have all of x, y and z")

# ---- an edited program ----
set(insert_comment "sed '5i (a comment)' ${uneven} > bottle_uneven.nc")
clsurf_cli_test(NAME comment_inserted_after_the_run SETUP "${insert_comment}" ARGS query bottle_uneven.nc ${uneven_log} --at 2.0,-5.6,4.7 --tool none
  STDOUT "^line 569: X2.013" "confidence 0[.]95" STDERR "was edited after the run" "1 line inserted before line [5-7] since the run")
clsurf_cli_test(NAME lines_deleted_after_the_run SETUP "sed '1000,1011d' ${uneven} > bottle_uneven.nc" ARGS query bottle_uneven.nc ${uneven_log} --point 20000 --json
  STDOUT "\"confidence\": 0[.]95" "12 lines deleted before line 101[23]")
clsurf_cli_test(NAME feed_changed_after_the_run SETUP "sed 's/F3000/F2500/' ${uneven} > bottle_uneven.nc" ARGS query bottle_uneven.nc ${uneven_log} --at 2.0,-5.6,4.7 --tool none
  STDOUT "^line 568: X2.013" "confidence 0[.]95" STDERR "lines 1[0-9]-37[0-9][0-9] ran at 30[0-9][0-9] mm/min, the program says F2500")
clsurf_cli_test(NAME feed_raised_after_the_run SETUP "sed 's/F3000/F4000/' ${uneven} > bottle_uneven.nc" ARGS query bottle_uneven.nc ${uneven_log} --at 2.0,-5.6,4.7 --tool none
  STDERR "lines 1[0-9]-37[0-9][0-9] ran at 30[0-9][0-9] mm/min, the program says F4000")
clsurf_cli_test(NAME comment_does_not_change_a_feed SETUP "${insert_comment}" ARGS info bottle_uneven.nc ${uneven_log} STDOUT "inserted" NO_STDOUT "ran at")
clsurf_cli_test(NAME crlf_is_the_same_program SETUP "sed 's/$/\\r/' ${uneven} > bottle_uneven.nc" ARGS info bottle_uneven.nc ${uneven_log}
  STDOUT "positions deviate" NO_STDOUT "edited" "another program")
# A log recorded from a text with mixed line ends, and the text with LF only.
clsurf_cli_test(NAME mixed_line_ends_are_the_same_program
  SETUP "sed '1~2s/$/\\r/' ${uneven} > bottle_uneven.nc && $CLSURF convert ${uneven_log} --program bottle_uneven.nc -o run.biip && cp ${uneven} bottle_uneven.nc"
  ARGS info bottle_uneven.nc run.biip STDOUT "positions deviate" NO_STDOUT "edited" "another program")
# A kernel's line numbers are two records ahead of its axes, in which the tool passes several of the shorter lines.
set(irregular @DATA@/programs/petal_zigzag_irregular.ngc)
clsurf_cli_test(NAME comment_appended_after_the_run SETUP "(cat ${irregular} && echo '(the end)') > petal_zigzag_irregular.ngc"
  ARGS info petal_zigzag_irregular.ngc @LOGS@/petal_zigzag_irregular.biip STDOUT "the edit moved no line" NO_STDOUT "inserted" "deleted")
clsurf_cli_test(NAME lines_edited_where_they_are_short
  SETUP "sed -e '12001i (a comment)' -e '16000,16001d' ${irregular} > petal_zigzag_irregular.ngc"
  ARGS info petal_zigzag_irregular.ngc @LOGS@/petal_zigzag_irregular.biip
  STDOUT "1 line inserted before line 1200[0-3], 2 lines deleted before line 1600[0-4] since")
# Line numbers ahead by three more records: five in all.
set(led "$CLSURF export ${zigzag} @LOGS@/bottle_zigzag.biip --columns line,cmd.x,cmd.y,cmd.z -o all.csv -q"
  "(head -n 1 all.csv && paste -d, <(tail -n +5 all.csv | cut -d, -f1) <(tail -n +2 all.csv | head -n -3 | cut -d, -f2-)) > run.csv")
list(JOIN led " && " led)
clsurf_cli_test(NAME lines_that_lead_are_kept SETUP "${led}" ARGS info ${zigzag} run.csv --period 0.001
  STDOUT "positions deviate" NO_STDOUT "do not fit" "since the run")
# The log of petal_spiral has no hash.
clsurf_cli_test(NAME lines_inserted_without_a_hash SETUP "sed -e '3000i (a)' -e '3000i (b)' @DATA@/programs/petal_spiral.ngc > petal_spiral.ngc"
  ARGS query petal_spiral.ngc @LOGS@/petal_spiral.raw --layout @DATA@/logs/petal_spiral.layout.toml --point 70000
  STDOUT "confidence 0[.]95" STDERR "2 lines inserted before line 300[0-9]")
# Only the last part of the lines is displaced.
clsurf_cli_test(NAME lines_deleted_near_the_end_without_a_hash SETUP "sed '11323,11327d' @DATA@/programs/petal_spiral.ngc > petal_spiral.ngc"
  ARGS query petal_spiral.ngc @LOGS@/petal_spiral.raw --layout @DATA@/logs/petal_spiral.layout.toml --point 83000
  STDOUT "confidence 0[.]95" STDERR "5 lines deleted before line 113[23][0-9]")

# ---- a log that ends early ----
foreach(subcommand "check --tool none" "render -o out.png --size 160x120" "report --tool none -o out.html")
  separate_arguments(words UNIX_COMMAND "${subcommand}")
  list(POP_FRONT words name)
  clsurf_cli_test(NAME truncated_log_in_${name} SETUP "head -c 1000000 @LOGS@/bottle_uneven.biip > run.biip"
    ARGS ${name} ${uneven} run.biip ${words} STDERR "the log ends at line 2035: 45 % of the program's motions are missing after it")
endforeach()
clsurf_cli_test(NAME truncated_log_is_not_judged SETUP "head -c 300000 @LOGS@/bottle_uneven.biip > run.biip" ARGS check ${uneven} run.biip EXIT 5
  STDOUT "NOT JUDGED: The log lacks 88 % of the program's motions")
clsurf_cli_test(NAME lines_of_another_program_are_one_finding ARGS info ${uneven} @LOGS@/bottle_zigzag.biip EXIT 3
  STDOUT "points have a line number that the program of 3716 lines does not have: 3718 … 3938")

# ---- subprograms in separate files ----
set(rib "printf 'G21 G90 G17\\nG0 X0 Y0 Z5\\nG1 Z0 F600\\no<rib> call [1]\\nG1 X0 Y2\\no<rib> call [3]\\nM2\\n' > part.ngc"
  "printf 'o<rib> sub\\nG1 X0 Y[#1] F3000\\nX20 Y[#1]\\nX20 Y[#1+0.5]\\no<rib> endsub\\nM2\\n' > rib.ngc"
  "$CLSURF simulate part.ngc --dialect linuxcnc -o run.biip > /dev/null")
list(JOIN rib " && " rib)
clsurf_cli_test(NAME line_of_a_file_that_is_called SETUP "${rib}" ARGS query part.ngc run.biip --dialect linuxcnc --line rib.ngc:3
  STDOUT "line 4: o<rib> call .1.*in .*rib.ngc line 3: X20 Y.#1.*called by part.ngc line 4: o<rib> call .1.*confidence 1[.]00.*line 6: o<rib> call .3")
clsurf_cli_test(NAME line_that_calls_a_file SETUP "${rib}" ARGS query part.ngc run.biip --dialect linuxcnc --line 6 --json
  STDOUT "\"line\": 6" "\"file\": \"[^\"]*rib.ngc\"" "\"line\": 2")
clsurf_cli_test(NAME line_of_no_file SETUP "${rib}" ARGS query part.ngc run.biip --dialect linuxcnc --line web.ngc:3 EXIT 2 STDERR "no file 'web.ngc'" "rib.ngc")
clsurf_cli_test(NAME line_beyond_a_called_file SETUP "${rib}" ARGS query part.ngc run.biip --dialect linuxcnc --line rib.ngc:30 EXIT 2 STDERR "rib.ngc has lines 1 … 6")
clsurf_cli_test(NAME line_that_is_no_number SETUP "${rib}" ARGS query part.ngc run.biip --dialect linuxcnc --line six EXIT 2 STDERR "'six' is not a whole number")
# A file makes thirty passes, every fifth of which is run at half the feed.
set(slow_passes "(printf 'G21 G90 G17\\nG0 X0 Y0 Z5\\nG1 Z0 F600\\n' && seq 0 29 | awk '{printf \"o<pair> call [%.1f] [%d]\\n\", $1*0.8, $1 % 5 == 2 ? 1500 : 3000}' && echo M2) > part.ngc"
  "printf 'o<pair> sub\\nF3000\\nG1 X0 Y[#1]\\nX20\\nY[#1+0.4]\\nX14\\nF[#2]\\nX6\\nF3000\\nX0\\no<pair> endsub\\nM2\\n' > pair.ngc"
  "$CLSURF simulate part.ngc --dialect linuxcnc -o run.biip > /dev/null")
list(JOIN slow_passes " && " slow_passes)
# The slow section is line 8 of pair.ngc with its ramps, called in line 6, 11 …
clsurf_cli_test(NAME defect_in_a_file_that_is_called SETUP "${slow_passes}" ARGS check part.ngc run.biip --dialect linuxcnc
  STDOUT " 16 .in pair.ngc: 6-10." " 31 .in pair.ngc: 6-10.")
clsurf_cli_test(NAME defect_in_a_file_that_is_called_in_json SETUP "${slow_passes}" ARGS check part.ngc run.biip --dialect linuxcnc --json
  STDOUT "\"subprograms\": .*\"file\": \"pair.ngc\"")
clsurf_cli_test(NAME defect_in_a_file_that_is_called_in_csv SETUP "${slow_passes}" ARGS check part.ngc run.biip --dialect linuxcnc --format csv
  STDOUT "place,file,file_first_line,file_last_line" ",16,16,.*,tool tip,pair.ngc,6,10")
clsurf_cli_test(NAME defect_in_a_file_that_is_called_in_sarif SETUP "${slow_passes}" ARGS check part.ngc run.biip --dialect linuxcnc --format sarif
  STDOUT "\"locations\": .{,120}\"uri\": \"pair.ngc\".{,80}\"startLine\": 6,.{,30}\"endLine\": 10" "\"uri\": \"part.ngc\".{,80}\"startLine\": 16,.{,160}Calls pair.ngc")

# ---- moves that are not finishing passes ----
# Forty passes of 30 mm next to each other, then three levels of a square pocket and two drilled holes.
set(with_pocket "(printf 'G21 G90 G17\\nG0 X0 Y0 Z5\\nG1 Z0 F600\\nF3000\\n' && seq 0 2 38 | awk '{printf \"G1 Y%.1f\\nX30\\nY%.1f\\nX0\\n\", $1/5, ($1+1)/5}'"
  "seq 1 3 | awk '{printf \"G0 Z5\\nG0 X60 Y0\\nG1 Z-%d\\nX75\\nY15\\nX60\\nY0\\n\", $1}'"
  "printf 'G0 Z5\\nG81 X100 Y0 Z-8 R2 F300\\nX110\\nG80\\nM30\\n') > part.nc" "$CLSURF simulate part.nc --dialect fanuc -o run.biip > /dev/null")
list(JOIN with_pocket " && " with_pocket)
clsurf_cli_test(NAME pocket_is_no_finishing_pass SETUP "${with_pocket}" ARGS check part.nc run.biip --dialect fanuc
  STDOUT "on 40 passes" "1[0-9][.][0-9] % of all cutting points belong to pockets, drilling or single contours")
clsurf_cli_test(NAME lint_of_a_pocket_judges_nothing
  SETUP "(printf 'G21 G90 G17\\nG0 X0 Y0 Z5\\nF3000\\n' && seq 1 3 | awk '{printf \"G0 Z5\\nG0 X60 Y0\\nG1 Z-%d\\nX75 F2000\\nY15\\nG3 X60 I-7.5 F3000\\nG1 Y0\\n\", $1}' && echo M30) > part.nc"
  ARGS lint part.nc STDOUT "no finishing passes to judge: 100 % of the cutting" NO_STDOUT "warning")
# Levels of a pocket 0.8 mm apart, with lines so long that a coarse search takes passes 2.27 mm apart for adjacent ones.
clsurf_cli_test(NAME lint_of_long_lines_in_a_pocket_judges_nothing
  ARGS lint @DATA@/programs/mixed.ngc STDOUT "no finishing passes to judge: 99 % of the cutting" NO_STDOUT "warning")
# Eight turns of a helix of 20 mm, 1 mm deep each, enter the material.
set(helix "(printf 'G21 G90 G17\\nG0 X0 Y0 Z5\\nG0 X10 Y0\\nG1 Z0 F1000\\n' && seq 1 8 | awk '{printf \"G3 X10 Y0 Z-%d I-10 J0\\n\", $1}' && printf 'G3 X10 Y0 I-10 J0\\nG1 X0\\nG0 Z5\\nM30\\n') > part.nc"
  "$CLSURF simulate part.nc --dialect linuxcnc -o run.biip > /dev/null")
list(JOIN helix " && " helix)
clsurf_cli_test(NAME helix_into_the_material_is_no_finishing SETUP "${helix}" ARGS check part.nc run.biip --dialect linuxcnc EXIT 5
  STDOUT "NOT JUDGED: [0-9]+ % of the cutting points belong to no finishing passes")
# A square wall of twelve levels, 0.3 mm apart, is a finishing operation.
set(waterlines "(printf 'G21 G90 G17\\nG0 X0 Y0 Z5\\nG1 Z0 F600\\nF3000\\n' && seq 1 12 | awk '{printf \"G1 Z-%.1f\\nX20\\nY20\\nX0\\nY0\\n\", $1*0.3}' && echo M30) > part.nc"
  "$CLSURF simulate part.nc -o run.biip > /dev/null")
list(JOIN waterlines " && " waterlines)
clsurf_cli_test(NAME waterlines_are_finishing_passes SETUP "${waterlines}" ARGS check part.nc run.biip --json STDOUT "\"not_finishing_percent\": 0[.]0," "\"judged\": true")

# Points have the lines of the simulation, also with only every twentieth record, and from the middle on.
set(simulated_lines "$CLSURF simulate @DATA@/programs/planted_zigzag.nc -o run.biip -q; $CLSURF export @DATA@/programs/planted_zigzag.nc run.biip --columns line,cmd.x,cmd.y,cmd.z -o all.csv -q")
set(lines_differ "$CLSURF export @DATA@/programs/planted_zigzag.nc part.csv --period 0.001 --ignore-lines --columns line -o found.csv -q; cut -d, -f1 part.csv | paste -d, - found.csv | awk -F, 'NR > 1 && $1 != $2 { n++ } END { print n + 0, NR; exit !(n < 0.002 * NR) }'")
clsurf_cli_test(NAME lines_by_geometry_are_those_of_the_simulation SETUP "${simulated_lines} && mv all.csv part.csv && ${lines_differ}" ARGS --version)
clsurf_cli_test(NAME lines_by_geometry_of_few_records SETUP "${simulated_lines} && awk 'NR == 1 || NR % 20 == 0' all.csv > part.csv && ${lines_differ}" ARGS --version)
clsurf_cli_test(NAME lines_by_geometry_from_the_middle_on SETUP "${simulated_lines} && awk 'NR == 1 || NR > 9000' all.csv > part.csv && ${lines_differ}" ARGS --version)
# ---- several runs in one log ----
# A plane of 14 passes, 0.3 mm apart, in lines of 1 mm at 40 mm/s, with a record every 4 ms. The second run has half the speed
# between X8 and X12 of the seventh pass. Or the run is stopped inside pass 9 and restarted from pass 6.
string(CONCAT some_runs "awk -v stop=STOP -v runs=RUNS 'BEGIN { print \"G21 G90 F2400\\nG0 X0 Y0 Z0\" > \"part.nc\"; "
  "for (k = 0; k < 14; ++k) { print \"G1 Y\" k * 0.3 > \"part.nc\"; for (i = 1; i <= 20; ++i) print \"X\" (k % 2 ? 20 - i : i) > \"part.nc\" } "
  "print \"M2\" > \"part.nc\"; print \"time [s],cmd.x [mm],cmd.y [mm],cmd.z [mm],line\"; "
  "for (r = 0; r < runs; ++r) { for (k = stop && r ? 5 : 0; k < 14; ++k) for (s = 0; s < 20; s += !stop && r && k == 6 && s > 8 && s < 12 ? 0.08 : 0.16) { "
  "if (stop && !r && (k > 8 || k == 8 && s > 10)) break; printf \"%.4f,%.4f,%.4f,0,%d\\n\", 0.004 * n++, k % 2 ? 20 - s : s, k * 0.3, 4 + 21 * k + int(s) } "
  "if (stop && !r) for (i = 1; i <= 30; ++i) printf \"%.4f,%.4f,%.4f,5,182\\n\", 0.004 * n++, 10 + i / 3, 2.4 - 0.03 * i } }' > run.csv")
string(REPLACE "STOP" "0" two_runs "${some_runs}")
string(REPLACE "RUNS" "2" two_runs "${two_runs}")
string(REPLACE "STOP" "1" restarted "${some_runs}")
string(REPLACE "RUNS" "2" restarted "${restarted}")
string(REPLACE "STOP" "0" one_run "${some_runs}")
string(REPLACE "RUNS" "1" one_run "${one_run}")
clsurf_cli_test(NAME each_of_two_runs_is_judged SETUP "${two_runs}" ARGS check part.nc run.csv
  STDOUT "^1 defect" "lines 13[78]-14[23]" "on 28 passes, 0.3 mm apart" STDERR "point 1750: warning: the program begins again at line [34]: run 2 in this log")
clsurf_cli_test(NAME a_restarted_run_is_no_other_program SETUP "${restarted}" ARGS info part.nc run.csv
  STDOUT "leaves the path on line 182 at point 1063, and the run goes on from line 109: lines 109-182 ran twice" NO_STDOUT "another program")
clsurf_cli_test(NAME diff_says_what_it_leaves_out SETUP "${two_runs} && mv run.csv two.csv && ${one_run}" ARGS diff run.csv two.csv
  STDERR "two.csv: warning: .* mm are not compared: run.csv has no such path, or has it only once. Longest part: points 17[0-9][0-9]–")
