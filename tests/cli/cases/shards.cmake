# A log in shards: the merged report equals that of the whole log, byte for byte, except for percentiles of the motion.

function(clsurf_shard_test program log count)
  cmake_parse_arguments(PARSE_ARGV 3 RUN "TEXT" "TOOL;LINES" "")
  set(part ${RUN_LINES})
  set(judged ${RUN_LINES})
  if(RUN_TOOL)
    list(APPEND judged --tool ${RUN_TOOL})
  endif()
  string(REPLACE ";" " " judging "${judged}")
  set(run "@DATA@/programs/${program} @LOGS@/${log}.biip")
  set(files)
  foreach(i RANGE 1 ${count})
    list(APPEND files shard${i}.json)
  endforeach()
  # The text of a merged report is tested once: its numbers are those of the JSON.
  set(as_text --version)
  if(RUN_TEXT)
    set(as_text check @DATA@/programs/${program} @LOGS@/${log}.biip --survey run.survey --merge ${files} ${judged} STDOUT "cutting points compared with both neighbours")
  endif()
  clsurf_cli_test(NAME shards_of_${log}
    SETUP "$CLSURF check ${run} ${judging} -o whole.json -q; $CLSURF survey ${run} ${part} -o run.survey -q; for i in $(seq ${count}); do $CLSURF check ${run} --survey run.survey --shard $i/${count} ${judging} -o shard$i.json -q; done; $CLSURF check ${run} --survey run.survey --merge shard*.json ${judging} -o merged.json -q; /usr/bin/python3 ${PROJECT_SOURCE_DIR}/tests/cli/read_merged.py whole.json merged.json; grep -q '\"severity\"' merged.json; $CLSURF check ${run} --survey run.survey --merge shard*.json ${judging} --scratch . -o in_files.json -q; cmp merged.json in_files.json"
    ARGS ${as_text})
endfunction()
# Without the as-machined surface, which takes most of the time and is tested with the tools below.
clsurf_shard_test(petal_zigzag_g64.ngc petal_zigzag_g64 5 TOOL none)
clsurf_shard_test(petal_loops_g64.ngc petal_loops_g64 3 TOOL none)
clsurf_shard_test(planted_loops.nc planted_loops 4 TOOL ball:6 TEXT)
clsurf_shard_test(bottle_uneven.nc bottle_uneven 2 TOOL bull:6,1.5)
# Lines that are found by geometry.
clsurf_shard_test(planted_zigzag.nc planted_zigzag 3 LINES --ignore-lines TEXT)

set(shard_run_args @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip)
list(JOIN shard_run_args " " shard_run)
set(shards_made "$CLSURF survey ${shard_run} -o run.survey -q; for i in 1 2; do $CLSURF check ${shard_run} --survey run.survey --shard $i/2 -o shard$i.json -q; done")
# The shards of the first test, which makes them.
set(same_shards "cp @AFTER@/run.survey @AFTER@/shard1.json @AFTER@/shard2.json .")
set(merge_args check @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip --survey run.survey)
clsurf_cli_test(NAME shards_survey ARGS survey @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip -o run.survey FILE run.survey STDOUT "^44930 points, [0-9]+ of them in 25 passes, 0.491 mm apart")
clsurf_cli_test(NAME shards_say_what_they_read SETUP "${shards_made}" ARGS ${merge_args} --shard 2/2 -o again.json FILE again.json STDOUT "^shard 2/2: [0-9]+ points, [0-9]+ read, [0-9]+ candidates")
clsurf_cli_test(NAME shards_keep_budgets AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${merge_args} --merge shard1.json shard2.json --max-depth 1um EXIT 1 STDOUT "max_depth_um .* NOT KEPT")
clsurf_cli_test(NAME shards_one_is_missing AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${merge_args} --merge shard2.json -o whole.json EXIT 2 STDERR "points 0 … [0-9]+ are in none of the shards")
clsurf_cli_test(NAME shards_one_is_there_twice AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${merge_args} --merge shard1.json shard2.json shard1.json -o whole.json EXIT 2 STDERR "are in two of the shards")
clsurf_cli_test(NAME shards_of_another_tool AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${merge_args} --merge shard1.json shard2.json --tool ball:6 -o whole.json EXIT 3 STDERR "shard1.json: error: was judged with --tool none, not with --tool ball:6")
clsurf_cli_test(NAME shards_that_are_none AFTER shards_say_what_they_read SETUP "${same_shards}; echo '{}' > shard1.json" ARGS ${merge_args} --merge shard1.json shard2.json -o whole.json EXIT 3 STDERR "shard1.json: error: is not what clsurf check --shard writes")
clsurf_cli_test(NAME shards_of_another_log AFTER shards_say_what_they_read SETUP "${same_shards}; cp @LOGS@/planted_loops.biip longer.biip; tail -c 100 longer.biip >> longer.biip" ARGS check @DATA@/programs/planted_loops.nc longer.biip --survey run.survey --shard 1/2 -o shard.json EXIT 3 STDERR "run.survey: error: is the survey of another log")
clsurf_cli_test(NAME shards_with_other_options AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${merge_args} --shard 1/2 --ignore-lines -o shard.json EXIT 3 STDERR "was made with no options, not with --ignore-lines")
clsurf_cli_test(NAME shards_without_a_survey ARGS check @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip --shard 1/2 -o shard.json EXIT 2 STDERR "shards need the survey of the log")
clsurf_cli_test(NAME shards_survey_alone AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${merge_args} EXIT 2 STDERR "--survey needs --shard or --merge")
clsurf_cli_test(NAME shards_scratch_alone ARGS check @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip --scratch . EXIT 2 STDERR "--scratch needs --merge")
clsurf_cli_test(NAME shards_scratch_that_is_not_there AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${merge_args} --merge shard1.json shard2.json --scratch nowhere EXIT 4 STDERR "cannot keep columns in nowhere: No such file or directory")
clsurf_cli_test(NAME shards_wrong_number AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${merge_args} --shard 3/2 -o shard.json EXIT 2 STDERR "--shard: '3/2' is not a shard such as 3/8")
clsurf_cli_test(NAME shards_with_a_budget AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${merge_args} --shard 1/2 --max-depth 1um -o shard.json EXIT 2 STDERR "--max-depth does not apply to --shard")
clsurf_cli_test(NAME shards_with_a_kalman_smoother AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${merge_args} --shard 1/2 --derivative kalman -o shard.json EXIT 2 STDERR "--derivative kalman needs the whole log")
clsurf_cli_test(NAME shards_of_five_axes SETUP "$CLSURF simulate @DATA@/programs/dome_five_axis.nc --machine @DATA@/machines/five_axis_trunnion.toml -o run.biip -q" ARGS survey @DATA@/programs/dome_five_axis.nc run.biip --machine @DATA@/machines/five_axis_trunnion.toml -o run.survey EXIT 2 STDERR "a survey is for machines of three axes")
clsurf_cli_test(NAME shards_of_text SETUP "head -n 2000 @LOGS@/mixed.csv > run.csv" ARGS survey @DATA@/programs/mixed.ngc run.csv -o run.survey EXIT 2 STDERR "run.csv is not a BIIP log: only these can be read in parts")
clsurf_cli_test(NAME shards_damaged_findings AFTER shards_say_what_they_read SETUP "${same_shards}; sed -i s/compared/comparef/ shard2.json" ARGS ${merge_args} --merge shard1.json shard2.json -o whole.json EXIT 3 STDERR "shard2.json: error: is cut or damaged: its checksum differs")
# The last bytes of the file are a section with a checksum, and zeros up to the end of the page.
clsurf_cli_test(NAME shards_damaged_section AFTER shards_say_what_they_read SETUP "${same_shards}; printf x | dd of=run.survey bs=1 seek=$(($(stat -c %s run.survey) - 1)) conv=notrunc status=none" ARGS ${merge_args} --shard 1/2 -o shard.json EXIT 3 STDERR "run.survey: error: is damaged: the checksum of section 13 differs")
clsurf_cli_test(NAME shards_damaged_survey AFTER shards_say_what_they_read SETUP "${same_shards}; head -c 9000 run.survey > cut; mv cut run.survey" ARGS ${merge_args} --shard 1/2 -o shard.json EXIT 3 STDERR "run.survey: error: is cut or damaged")

# ---- the surface in pieces ----
function(clsurf_pieces_test program log count columns)
  set(run "@DATA@/programs/${program} @LOGS@/${log}.biip")
  set(files)
  foreach(i RANGE 1 ${count})
    list(APPEND files pieces/map${i}.vtp)
  endforeach()
  clsurf_cli_test(NAME shards_pieces_of_${log}
    SETUP "mkdir pieces; $CLSURF export ${run} --columns ${columns} -o whole.vtp; $CLSURF survey ${run} -o run.survey -q; for i in $(seq ${count}); do $CLSURF export ${run} --survey run.survey --shard $i/${count} --columns ${columns} -o pieces/map$i.vtp -q; done; $CLSURF export --merge pieces/map*.vtp -o map.pvtp; /usr/bin/python3 ${PROJECT_SOURCE_DIR}/tests/cli/read_pieces.py whole.vtp map.pvtp"
    ARGS export --merge ${files} -o again.pvtp FILE again.pvtp)
endfunction()
clsurf_pieces_test(petal_zigzag_g64.ngc petal_zigzag_g64 5 point,time,line,pass,confidence,x,speed,acceleration,jerk)
clsurf_pieces_test(petal_loops_g64.ngc petal_loops_g64 3 point,speed,following_error)
clsurf_pieces_test(planted_loops.nc planted_loops 4 point,line,speed)
clsurf_pieces_test(transition_g61.nc transition_g61 3 point,speed)
set(piece_args export @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip --survey run.survey --shard 1/2)
clsurf_cli_test(NAME shards_piece_of_another_kind AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${piece_args} -o map.csv EXIT 2 STDERR "--shard writes a .vtp or a .vtkhdf file")
clsurf_cli_test(NAME shards_piece_with_a_field_of_the_whole AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${piece_args} --columns speed_mismatch -o map.vtp EXIT 2 STDERR "'speed_mismatch' is a field of the whole log, not of a shard")
clsurf_cli_test(NAME shards_pieces_that_differ AFTER shards_say_what_they_read SETUP "${same_shards}; $CLSURF export ${shard_run} --survey run.survey --shard 1/2 -o a.vtp -q; $CLSURF export ${shard_run} --survey run.survey --shard 2/2 --columns point -o b.vtp -q" ARGS export --merge a.vtp b.vtp -o map.pvtp EXIT 3 STDERR "b.vtp: error: has different columns from a.vtp")
clsurf_cli_test(NAME shards_pieces_that_are_none SETUP "echo '<VTKFile/>' > a.vtp" ARGS export --merge a.vtp -o map.pvtp EXIT 3 STDERR "a.vtp: error: is not a piece that clsurf export --shard writes")
clsurf_cli_test(NAME shards_pieces_into_no_pvtp SETUP "echo > a.vtp" ARGS export --merge a.vtp -o map.vtp EXIT 2 STDERR "--merge writes a .pvtp file")
clsurf_cli_test(NAME shards_pieces_with_marks_of_xml_in_their_names AFTER shards_say_what_they_read
  SETUP "${same_shards}; $CLSURF export ${shard_run} --columns point -o whole.vtp -q; $CLSURF export ${shard_run} --survey run.survey --shard 1/2 --columns point -o 'top & <side>.vtp' -q; $CLSURF export ${shard_run} --survey run.survey --shard 2/2 --columns point -o b.vtp -q; $CLSURF export --merge 'top & <side>.vtp' b.vtp -o map.pvtp; /usr/bin/python3 ${PROJECT_SOURCE_DIR}/tests/cli/read_pieces.py whole.vtp map.pvtp"
  ARGS --version)

# ---- the same as partitions of one file, read by VTK's reader ----
set(partitions_made "for i in 1 2 3; do $CLSURF export ${shard_run} --survey run.survey --shard $i/3 --columns point,line,time,speed -o piece$i.vtkhdf -q; done")
set(same_partitions "cp @AFTER@/piece1.vtkhdf @AFTER@/piece2.vtkhdf @AFTER@/piece3.vtkhdf .")
clsurf_cli_test(NAME shards_partitions AFTER shards_say_what_they_read
  SETUP "cp @AFTER@/run.survey .; $CLSURF export ${shard_run} --columns point,line,time,speed -o whole.vtkhdf; ${partitions_made}; $CLSURF export --merge piece3.vtkhdf piece1.vtkhdf piece2.vtkhdf -o map.vtkhdf; /usr/bin/python3 ${PROJECT_SOURCE_DIR}/tests/cli/read_pieces.py whole.vtkhdf map.vtkhdf 3"
  ARGS export --merge piece1.vtkhdf piece2.vtkhdf piece3.vtkhdf -o again.hdf FILE again.hdf)
function(clsurf_partitions_error_test name setup pieces exit words)
  clsurf_cli_test(NAME shards_partitions_${name} AFTER shards_partitions SETUP "${same_partitions}; ${setup}" ARGS export --merge ${pieces} EXIT ${exit} STDERR "${words}")
endfunction()
clsurf_partitions_error_test(one_is_missing : "piece1.vtkhdf;piece3.vtkhdf;-o;map.vtkhdf" 2 "points [0-9]+ … [0-9]+ are in none of the pieces")
clsurf_partitions_error_test(the_last_is_missing : "piece1.vtkhdf;piece2.vtkhdf;-o;map.vtkhdf" 2 "points [0-9]+ … 44929 are in none of the pieces")
clsurf_partitions_error_test(one_is_there_twice : "piece1.vtkhdf;piece2.vtkhdf;piece3.vtkhdf;piece2.vtkhdf;-o;map.vtkhdf" 2 "points [0-9]+ … [0-9]+ are in two of the pieces")
clsurf_partitions_error_test(one_is_the_output : "piece1.vtkhdf;piece2.vtkhdf;piece3.vtkhdf;-o;piece3.vtkhdf" 2 "'piece3.vtkhdf' is an input: it would be overwritten")
clsurf_partitions_error_test(one_is_no_piece "cp @AFTER@/whole.vtkhdf ." "piece1.vtkhdf;whole.vtkhdf;-o;map.vtkhdf" 3 "whole.vtkhdf: error: is not a .vtkhdf piece that clsurf export --shard writes")
clsurf_partitions_error_test(one_is_cut "head -c 300000 piece2.vtkhdf > cut.vtkhdf" "piece1.vtkhdf;cut.vtkhdf;piece3.vtkhdf;-o;map.vtkhdf" 3 "cut.vtkhdf: error: is not a .vtkhdf piece that clsurf export --shard writes, or is damaged")
clsurf_partitions_error_test(one_is_not_there : "piece1.vtkhdf;nowhere.vtkhdf;-o;map.vtkhdf" 3 "nowhere.vtkhdf.*No such file")
clsurf_cli_test(NAME shards_partitions_that_differ AFTER shards_partitions SETUP "${same_partitions}; $CLSURF export ${shard_run} --survey @AFTER@/run.survey --shard 2/3 --columns point -o other.vtkhdf -q" ARGS export --merge piece1.vtkhdf other.vtkhdf piece3.vtkhdf -o map.vtkhdf EXIT 3 STDERR "other.vtkhdf: error: has different columns from piece1.vtkhdf")

# ---- the map, drawn shard by shard, at once or in pieces: the same picture, byte for byte ----
# With COUNT shards.
function(clsurf_map_of_shards_test name program log count)
  string(REPLACE ";" " " options "${ARGN}")
  set(run "@DATA@/programs/${program} @LOGS@/${log}.biip")
  if(NOT options MATCHES "--size")
    string(APPEND options " --size 800x600")
  endif()
  set(look "${options} -q")
  clsurf_cli_test(NAME shards_map_${name}
    SETUP "$CLSURF render ${run} ${look} -o whole.png; $CLSURF survey ${run} -o run.survey -q; $CLSURF render ${run} --survey run.survey --shards ${count} ${look} -o shards.png; for i in $(seq ${count}); do $CLSURF render ${run} --survey run.survey --shard $i/${count} ${look} -o $i.piece; done; $CLSURF render ${run} --survey run.survey --merge $(seq -f %g.piece ${count} -1 1) ${look} -o merged.png"
    ARGS compare whole.png merged.png STDOUT "^equal: 0 pixels differ" SAME whole.png shards.png merged.png)
endfunction()
clsurf_map_of_shards_test(zigzag petal_zigzag_g64.ngc petal_zigzag_g64 5)
clsurf_map_of_shards_test(loops petal_loops_g64.ngc petal_loops_g64 3 --color jerk --range 0,100000 --view top)
clsurf_map_of_shards_test(planted planted_loops.nc planted_loops 7 --zoom 0.2,0.3,0.7,0.8)
clsurf_map_of_shards_test(lines bottle_uneven.nc bottle_uneven 2 --style lines --range 0,3000)
clsurf_map_of_shards_test(steep transition_g61.nc transition_g61 4 --view 200,20)
set(map_args render @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip -o map.png)
clsurf_cli_test(NAME shards_map_without_a_range AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${map_args} --survey run.survey --color speed EXIT 2 STDERR "the range of 'speed' depends on all points of the log.*--range MIN,MAX, in mm/min")
clsurf_cli_test(NAME shards_map_of_a_field_of_the_whole AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${map_args} --survey run.survey --color speed_mismatch EXIT 2 STDERR "'speed_mismatch' is a field of the whole log, not of a shard")
clsurf_cli_test(NAME shards_map_of_classes AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${map_args} --survey run.survey --color line EXIT 2 STDERR "'line' has classes")
clsurf_cli_test(NAME shards_map_with_marks AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${map_args} --survey run.survey --mark-point 7 EXIT 2 STDERR "--mark-point needs the whole log: leave out --survey")
clsurf_cli_test(NAME shards_map_without_a_survey ARGS ${map_args} --shards 3 EXIT 2 STDERR "--shards needs --survey")
# One sample of these two is equally near on a line and on a triangle of the adjacent shard.
clsurf_map_of_shards_test(ties dome_loops.nc dome_loops 5 --size 1600x1200)
set(piece_made "$CLSURF render ${shard_run} --survey run.survey --size 400x300 -q")
clsurf_cli_test(NAME shards_map_piece AFTER shards_say_what_they_read SETUP "${same_shards}; ${piece_made} --shard 1/2 -o a.piece" ARGS render ${shard_run_args} --survey run.survey --size 400x300 --shard 2/2 -o b.piece FILE b.piece)
set(same_pieces "cp @AFTER@/run.survey @AFTER@/a.piece @AFTER@/b.piece .")
function(clsurf_map_piece_error_test name setup arguments exit words)
  clsurf_cli_test(NAME shards_map_piece_${name} AFTER shards_map_piece SETUP "${same_pieces}; ${setup}" ARGS render ${shard_run_args} --survey run.survey --size 400x300 -o map.png ${arguments} EXIT ${exit} STDERR "${words}")
endfunction()
clsurf_map_piece_error_test(is_missing "true" "--merge;b.piece" 2 "piece 1/2 is missing")
clsurf_map_piece_error_test(is_there_twice "true" "--merge;a.piece;b.piece;a.piece" 2 "duplicate piece 1/2")
clsurf_map_piece_error_test(of_others "${piece_made} --shard 2/3 -o c.piece" "--merge;a.piece;c.piece" 2 "c.piece is one of 3 pieces, a.piece is one of 2")
clsurf_map_piece_error_test(of_another_look "true" "--merge;a.piece;b.piece;--view;top" 3 "a.piece: error: was drawn with .*, not with .*--view top")
clsurf_map_piece_error_test(is_cut "head -c -1 b.piece > c.piece" "--merge;a.piece;c.piece" 3 "c.piece: error: is cut or damaged: the checksum of its pixels differs")
clsurf_map_piece_error_test(is_damaged "sed s/settings/settinks/ b.piece > c.piece" "--merge;a.piece;c.piece" 3 "c.piece: error: is cut or damaged: the checksum of its head differs")
clsurf_map_piece_error_test(is_none "cp @AFTER@/run.survey c.piece" "--merge;a.piece;c.piece" 3 "c.piece: error: is not what clsurf render --shard writes")
clsurf_map_piece_error_test(and_shards "true" "--merge;a.piece;b.piece;--shards;2" 2 "--shards cannot be combined with --merge")
clsurf_map_piece_error_test(with_marks "true" "--shard;1/2;--mark-line;7" 2 "--mark-line needs the whole log: leave out --survey")
clsurf_cli_test(NAME shards_map_piece_without_a_survey ARGS ${map_args} --shard 1/3 EXIT 2 STDERR "--shard needs --survey")
clsurf_cli_test(NAME shards_map_of_no_shards AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${map_args} --survey run.survey --shards 0 EXIT 2 STDERR "--shards: 0 is not 1")

# ---- the page: the same, byte for byte ----
# Findings of `check --shard` and `report --shard`, which are equal, and the as-machined surface.
clsurf_cli_test(NAME shards_page_of_findings AFTER shards_say_what_they_read
  SETUP "cp @AFTER@/run.survey .; $CLSURF report ${shard_run} --tool ball:6 -o whole.html; for i in 1 2; do $CLSURF check ${shard_run} --survey run.survey --shard $i/2 --tool ball:6 -o checked$i.json -q; $CLSURF report ${shard_run} --survey run.survey --shard $i/2 --tool ball:6 -o shard$i.json -q; cmp checked$i.json shard$i.json; done; grep -q 'id=.defect-list' whole.html"
  ARGS report ${shard_run_args} --tool ball:6 --survey run.survey --merge shard1.json shard2.json --shards 4 -o shards.html SAME whole.html shards.html)
# Shards that are judged for the page, with points omitted.
set(page_of "$CLSURF report ${shard_run} --color jerk --max-size 2")
clsurf_cli_test(NAME shards_page AFTER shards_say_what_they_read
  SETUP "cp @AFTER@/run.survey .; mkdir files; ${page_of} -o whole.html; grep -q 'of 44[^0-9]*930 points are in this page' whole.html; ${page_of} --survey run.survey --shards 1 --scratch files -o one.html"
  ARGS report ${shard_run_args} --color jerk --max-size 2 --survey run.survey -o shards.html SAME whole.html one.html shards.html)
set(page_args report @DATA@/programs/planted_loops.nc @LOGS@/planted_loops.biip -o page.html)
clsurf_cli_test(NAME shards_page_before AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${page_args} --survey run.survey --before @LOGS@/planted_loops.biip EXIT 2 STDERR "--before needs the whole log: leave out --survey")
clsurf_cli_test(NAME shards_page_shard_with_fields AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS report ${shard_run_args} --survey run.survey --shard 1/2 --fields speed -o shard.json EXIT 2 STDERR "--fields does not apply to --shard, only to the whole log")
clsurf_cli_test(NAME shards_page_without_a_survey ARGS ${page_args} --shards 3 EXIT 2 STDERR "--shards needs --survey")
clsurf_cli_test(NAME shards_page_with_one_missing AFTER shards_say_what_they_read SETUP "${same_shards}" ARGS ${page_args} --survey run.survey --merge shard2.json EXIT 2 STDERR "points 0 … [0-9]+ are in none of the shards")

# ---- generated logs of any length ----
set(make_sample $<TARGET_FILE:clsurf_make_sample>)
# A flat part and one lag for all axes: the only defects are the slow places.
foreach(pattern zigzag one-way)
  clsurf_cli_test(NAME check_of_made_slow_${pattern}
    SETUP "${make_sample} ${pattern} 200000 a.nc a.biip --line 8 --wave 500 --height 2 --lag 4 --slow 2 > slow; test $(wc -l < slow) = 2"
    ARGS check a.nc a.biip STDOUT "^2 defects: 2 slower sections .up to -50 %")
endforeach()
foreach(arguments "spiral 100 a.nc a.biip" "zigzag 100 a.nc a.biip --slow" "zigzag 100 a.nc a.biip --slow many" "zigzag 100 a.nc a.biip --line 0")
  string(MAKE_C_IDENTIFIER "${arguments}" name)
  separate_arguments(words UNIX_COMMAND "${arguments}")
  add_test(NAME make_sample_usage_${name} COMMAND clsurf_make_sample ${words})
  set_tests_properties(make_sample_usage_${name} PROPERTIES PASS_REGULAR_EXPRESSION "usage: clsurf_make_sample zigzag")
endforeach()
