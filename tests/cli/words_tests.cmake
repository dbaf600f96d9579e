# Words that users try, in the order in which they try them; and words from a configuration.
clsurf_cli_test(NAME words_version ARGS version STDOUT "^clsurf ${PROJECT_VERSION}")
clsurf_cli_test(NAME words_version_of_all_parts ARGS --version STDOUT "^clsurf ${PROJECT_VERSION}\ncommit    ([0-9a-f]{12}(-dirty)?|unknown)\ncompiler  "
  "VTK 9\\.[0-9]+\\.[0-9]+, OpenImageIO [0-9.]+, Eigen 3\\.[0-9.]+, Boost 1\\.[0-9.]+, TBB [0-9.]+, fmt [0-9.]+, nlohmann-json [0-9.]+, toml\\+\\+ [0-9.]+, HDF5 [0-9.]+, zlib [0-9.]+, Zstandard [0-9.]+, liblzma [0-9.]+, Expat [0-9.]+, OpenSSL [0-9][0-9a-z.]+, SQLite [0-9.]+, libmodbus [0-9.]+\n"
  "OSMesa    OpenGL .*Mesa [0-9]+")
if(EXISTS ${PROJECT_SOURCE_DIR}/.git)
  add_test(NAME cli.words_version_of_an_archive COMMAND bash -euc
    "rm -rf '${CMAKE_CURRENT_BINARY_DIR}/archive'; mkdir '${CMAKE_CURRENT_BINARY_DIR}/archive'; cd '${CMAKE_CURRENT_BINARY_DIR}/archive'; \
     git -C '${PROJECT_SOURCE_DIR}' archive HEAD src/cli | tar -x; \
     '${CMAKE_COMMAND}' -D SOURCE=$PWD -D OUTPUT=$PWD/commit.cpp -P src/cli/write_commit.cmake; \
     grep -F \"\\\"$(git -C '${PROJECT_SOURCE_DIR}' rev-parse HEAD | cut -c1-12)\\\"\" commit.cpp")
endif()
clsurf_cli_test(NAME words_option_first ARGS -v render ${part} ${run} -o map.png --size 160x120 FILE map.png STDERR "stitch the surface")
clsurf_cli_test(NAME words_option_with_a_value_first ARGS --threads 1 info ${run} STDOUT "27517 records")
clsurf_cli_test(NAME words_help_first ARGS --help render STDOUT "usage: clsurf render")
clsurf_cli_test(NAME words_other_names SETUP "$CLSURF render ${part} ${run} -o a.png --size 160x120 --color speed_mismatch --colormap viridis"
  ARGS render ${part} ${run} -o b.png --size 160x120 --field mismatch --cmap=viridis FILE b.png)
clsurf_cli_test(NAME words_other_names_mean_the_same
  SETUP "$CLSURF render ${part} ${run} -o a.png --size 160x120 --color speed_mismatch --colormap viridis; $CLSURF render ${part} ${run} --out b.png --size 160x120 --colour mismatch --cmap=viridis"
  ARGS compare a.png b.png --json STDOUT "\"max_error\": 0.0")
clsurf_cli_test(NAME words_other_fields ARGS export ${part} ${run} -o p.csv --fields accel,lag,mismatch FILE p.csv)
clsurf_cli_test(NAME words_a_channel_keeps_its_name SETUP "printf 'time,cmd.x,cmd.y,cmd.z,lag\\n0,0,0,0,7\\n0.001,1,0,0,7\\n0.002,2,0,0,7\\n' > a.csv; echo 'G1 X2 F60000' > a.nc"
  ARGS export a.nc a.csv -o - --columns lag STDOUT "lag[^a-z]*7")
clsurf_cli_test(NAME words_place_with_blanks ARGS query ${part} ${run} --at "-5.87 0 2.45" --tool none STDOUT "^line 1768")
clsurf_cli_test(NAME words_place_as_words ARGS query ${part} ${run} --at -5.87 0 2.45 --tool none STDOUT "^line 1768")
clsurf_cli_test(NAME words_place_before_the_files ARGS query --at -5.87 0 2.45 ${part} ${run} --tool none STDOUT "^line 1768")
clsurf_cli_test(NAME words_number_without_an_option ARGS query ${part} ${run} -5.6 EXIT 2 STDERR "a value '-5.6' without its option" "--at 2,-5.6,4.7")
clsurf_cli_test(NAME words_machine ARGS machine @DATA@/machines/three_axis_mill.toml STDOUT "can be used")
clsurf_cli_test(NAME words_no_output ARGS render ${part} ${run} EXIT 2 STDERR "no output file given" "hint: add -o FILE")
clsurf_cli_test(NAME words_size_hd ARGS render ${part} ${run} -o map.png --size hd FILE map.png)
clsurf_cli_test(NAME words_size_with_a_comma ARGS render ${part} ${run} -o map.png --size 1920,1080 EXIT 2 STDERR "--size: '1920,1080' is not WIDTHxHEIGHT in whole pixels")
clsurf_cli_test(NAME words_size_8k ARGS render ${part} ${run} -o map.png --size 8k EXIT 2 STDERR "hd or 4k")

# ---- .clsurf.toml ----
set(project "mkdir -p parts/deep; cp @DATA@/programs/bottle_uneven.nc parts/deep/part.nc; cp @DATA@/machines/three_axis_mill.toml parts/mill.toml")
clsurf_cli_test(NAME config_tool SETUP "${project}; echo 'tool = \"ball:6\"' > parts/.clsurf.toml" ARGS check parts/deep/part.nc ${run} -v
  STDOUT "with ball:6" STDERR "options from [^\n]*/parts/.clsurf.toml: tool")
clsurf_cli_test(NAME config_command_line_first SETUP "${project}; echo 'tool = \"ball:6\"' > parts/.clsurf.toml" ARGS check parts/deep/part.nc ${run} --tool ball:8 STDOUT "with ball:8")
clsurf_cli_test(NAME config_not_wanted SETUP "${project}; echo 'tool = \"ball:4\"' > parts/.clsurf.toml" ARGS check parts/deep/part.nc ${run} --no-config NO_STDOUT "ball:4")
clsurf_cli_test(NAME config_nearest SETUP "${project}; echo 'tool = \"ball:6\"' > parts/.clsurf.toml; echo 'tool = \"ball:4\"' > parts/deep/.clsurf.toml" ARGS check parts/deep/part.nc ${run} -v STDERR "options from [^\n]*/parts/deep/.clsurf.toml: tool" "ball:4 of .clsurf.toml is not used")
clsurf_cli_test(NAME config_of_the_working_folder SETUP "echo 'threads = 0' > .clsurf.toml; echo 'G0 X1' > stdin" ARGS moves - EXIT 3 STDERR "[.]clsurf.toml:1:[0-9]+: error: --threads must be at least 1")
clsurf_cli_test(NAME config_relative_paths SETUP "${project}; echo 'machine = \"mill.toml\"' > parts/.clsurf.toml; cd parts/deep; $CLSURF simulate part.nc -o run.biip -v 2>&1 | grep -q 'clsurf.toml: machine'"
  ARGS simulate parts/deep/part.nc -o run.biip FILE run.biip)
clsurf_cli_test(NAME config_missing_machine SETUP "${project}; echo 'machine = \"nowhere.toml\"' > parts/.clsurf.toml" ARGS simulate parts/deep/part.nc -o run.biip EXIT 3 STDERR "parts/nowhere.toml: error: cannot open")
clsurf_cli_test(NAME config_for_others SETUP "${project}; printf 'colormap = \"viridis\"\nwork-offset = [1, 2, 3]\ntool = \"ball:6\"\n' > parts/.clsurf.toml" ARGS moves parts/deep/part.nc STDOUT "line,kind")
clsurf_cli_test(NAME config_does_not_get_in_the_way SETUP "${project}; printf 'work-offset = [1, 2, 3]\ntool = \"ball:6\"\nmapping = \"no.toml\"\nmachine = \"mill.toml\"\n' > parts/.clsurf.toml; $CLSURF moves parts/deep/part.nc > moves.csv"
  ARGS simulate parts/deep/part.nc -o run.biip FILE run.biip)
clsurf_cli_test(NAME config_tool_for_a_plain_map SETUP "${project}; echo 'tool = \"ball:6\"' > parts/.clsurf.toml; $CLSURF plot parts/deep/part.nc ${run} -o curve.png" ARGS render parts/deep/part.nc ${run} -o map.png --size 160x120 FILE map.png)
clsurf_cli_test(NAME config_list SETUP "printf 'G0 X0\nG1 X10 F600\nM2\n' > a.nc; $CLSURF simulate a.nc -o a.biip; echo 'work-offset = [0, 0, -5]' > .clsurf.toml" ARGS query a.nc a.biip --point 5 STDOUT "Z 5.0000")
clsurf_cli_test(NAME config_unknown_key SETUP "${project}; printf '# mine\ntoool = \"ball:6\"\n' > parts/.clsurf.toml" ARGS check parts/deep/part.nc ${run} EXIT 3 STDERR "parts/.clsurf.toml:2:[0-9]+: error: unknown key 'toool'" "did you mean 'tool'")
clsurf_cli_test(NAME config_wrong_value SETUP "${project}; printf 'threads = \"many\"\n' > parts/.clsurf.toml" ARGS check parts/deep/part.nc ${run} EXIT 3 STDERR "parts/.clsurf.toml:1:[0-9]+: error: --threads: 'many' is not a whole number")
clsurf_cli_test(NAME config_wrong_word SETUP "${project}; printf 'gl = \"vulkan\"\n' > parts/.clsurf.toml" ARGS render parts/deep/part.nc ${run} -o map.png EXIT 3 STDERR "parts/.clsurf.toml:1:[0-9]+: error: --gl: 'vulkan' is not one of osmesa, egl")
clsurf_cli_test(NAME config_wrong_tool SETUP "${project}; printf '# mine\ntool = \"cone:6\"\n' > parts/.clsurf.toml" ARGS check parts/deep/part.nc ${run} EXIT 3 STDERR "parts/.clsurf.toml:2:[0-9]+: error: --tool: tool 'cone:6'")
clsurf_cli_test(NAME config_wrong_work_offset SETUP "${project}; printf 'work-offset = [1, 2]\n' > parts/.clsurf.toml" ARGS check parts/deep/part.nc ${run} EXIT 3 STDERR "parts/.clsurf.toml:1:[0-9]+: error: --work-offset: '1,2' is not 3 or 4 numbers")
# If the log states the program's zero, the configuration does not change it.
set(trunnion @DATA@/machines/five_axis_trunnion.toml)
clsurf_cli_test(NAME config_after_the_work_offset_of_the_log
  SETUP "printf 'G21 G90 G54\nG43.4 H1\nG0 X0 Y0 Z5 A10 C0\nG1 X10 F600\nM2\n' > a.nc; $CLSURF simulate a.nc --machine ${trunnion} --work-offset 1,2,3 -o a.biip; echo 'work-offset = [7, 7, 7]' > .clsurf.toml"
  ARGS query a.nc a.biip --machine ${trunnion} --line 4 -v STDOUT "tool tip X 0[.]00.. Y -?0[.]0000 Z 4[.]99" STDERR "the log states work-offset 1,2,3: the default 7,7,7 is not used")
clsurf_cli_test(NAME config_flag_with_a_value SETUP "${project}; printf 'quiet = 1\n' > parts/.clsurf.toml" ARGS check parts/deep/part.nc ${run} EXIT 3 STDERR "parts/.clsurf.toml:1:[0-9]+: error: 'quiet' is true or false")
clsurf_cli_test(NAME config_malformed SETUP "${project}; printf 'tool = ball\n' > parts/.clsurf.toml" ARGS check parts/deep/part.nc ${run} EXIT 3 STDERR "parts/.clsurf.toml:1")
clsurf_cli_test(NAME config_flag SETUP "${project}; printf 'quiet = true\n' > parts/.clsurf.toml" ARGS info parts/deep/part.nc NO_STDOUT ".")
clsurf_cli_test(NAME config_is_an_input SETUP "${project}; printf 'quiet = true\n' > parts/.clsurf.toml; ln parts/.clsurf.toml parts/c.csv" ARGS moves parts/deep/part.nc -o parts/c.csv EXIT 2 STDERR "the output 'parts/c.csv' is the input")

clsurf_cli_test(NAME words_csv_is_of_export ARGS convert ${run} -o run.csv EXIT 2 STDERR "'run.csv' must end in .biip" "clsurf export. writes CSV")
clsurf_cli_test(NAME words_intervals_of_one_line SETUP "printf 'G0 X0 Y0 Z0\\nG1 X10 F600\\nM2\\n' > a.nc" ARGS intervals a.nc STDOUT "0 intervals on 0 passes" "no finishing pass has two cutting motions in a row: .* has others next to it")
