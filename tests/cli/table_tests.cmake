# Files that are neither a program nor a readable log: the message says so, and what to do.
set(own "printf '%s\\n' 'Timestamp,Xcmd,X_act,PosY_soll,Z Ist (mm),F,Line,Mode' '0,1.0,1.0,2.0,3.0,3000,10,AUTO' '1,1.1,1.0,2.0,3.0,3000,10,AUTO' '2,1.2,1.1,2.0,3.0,3000,11,AUTO' > own.csv")
clsurf_cli_test(NAME table_in_info SETUP "${own}" ARGS info own.csv EXIT 3 STDOUT "own.csv: a table that is not recognised as a log" "3  PosY_soll, such as 2.0" "name = .cmd.y." STDERR "own.csv: error: no column name is that of a position" "hint: .*--suggest-mapping own.csv")
clsurf_cli_test(NAME table_in_info_json SETUP "${own}" ARGS info own.csv --json EXIT 3 STDOUT "\"kind\": \"table\"" "\"suggested_mapping\"" "\"Xcmd\"" STDERR "no column name")
clsurf_cli_test(NAME table_as_a_program SETUP "${own}" ARGS lint own.csv EXIT 3 STDERR "own.csv: error: is a table of 8 columns: Timestamp, Xcmd, .* not an NC program" "clsurf info --suggest-mapping own.csv")
clsurf_cli_test(NAME table_as_a_log SETUP "${own}" ARGS check ${part} own.csv EXIT 3 STDERR "own.csv: error: is a table of 8 columns" "use --mapping FILE")
clsurf_cli_test(NAME table_mapping_can_be_read SETUP "${own}; $CLSURF info --suggest-mapping own.csv -o own.toml; cat own.toml" ARGS info own.csv --mapping own.toml EXIT 3 STDERR "neither commanded, feedback nor actual positions have all of x, y and z"
  STDOUT "3 records every 1 ms" "channels: time .s., cmd.x .mm., act.x .mm., cmd.y .mm., act.z .mm., speed .mm/min., line")
foreach(titles "Time[ms];PosX;PosY;PosZ" "t,ENC_POS1,ENC_POS2,ENC_POS3,DES_POS1,DES_POS2,DES_POS3" "Zeit X_Soll Y_Soll Z_Soll Satz" "a\\\"b,Xcmd,Ycmd,Zcmd")
  string(MAKE_C_IDENTIFIER "${titles}" name)
  string(REPLACE ";" "\\;" titles "${titles}")
  clsurf_cli_test(NAME table_mapping_of_${name} SETUP "printf '%s\\n' '${titles}' > own.csv; printf '%s\\n' '${titles}' | sed 's/[^,; ]\\{1,\\}/1/g' >> own.csv; sed -n 2p own.csv | sed 's/1/2/g' >> own.csv; sed -n 2p own.csv | sed 's/1/3/g' >> own.csv; $CLSURF info --suggest-mapping own.csv -o own.toml"
    ARGS info own.csv --mapping own.toml --period 0.001 STDOUT "3 records")
endforeach()
clsurf_cli_test(NAME table_suggestion_into_the_terminal SETUP "${own}" ARGS info --suggest-mapping own.csv STDOUT "^# How to read own.csv" "name = .time." "Mode., holds words: left out")
clsurf_cli_test(NAME table_suggestion_for_a_program ARGS info --suggest-mapping ${part} EXIT 3 STDERR "is not a table of numbers")
clsurf_cli_test(NAME table_suggestion_of_two ARGS info --suggest-mapping ${part} ${run} EXIT 2 STDERR "--suggest-mapping needs one file")
clsurf_cli_test(NAME table_output_without_suggestion ARGS info ${run} -o a.toml EXIT 2 STDERR "-o needs --suggest-mapping")
clsurf_cli_test(NAME arguments_swapped ARGS query ${run} ${part} --point 5 EXIT 3 STDERR "bottle_uneven.biip: error: is a log .format biip., not an NC program" "the program comes before the log")
clsurf_cli_test(NAME raw_log_as_a_program ARGS info @LOGS@/petal_spiral.raw EXIT 3 STDERR "petal_spiral.raw: error: is binary data, not an NC program" "--layout FILE")
clsurf_cli_test(NAME binary_leaves_the_terminal_alone SETUP "head -c 65536 @LOGS@/petal_spiral.raw > part.nc; $CLSURF moves part.nc 2> ../said || true; ! grep -q '[[:cntrl:]]' ../said" ARGS moves part.nc EXIT 3 STDERR "binary")
clsurf_cli_test(NAME binary_utf16 SETUP "printf 'G1 X5\\n' | iconv -f UTF-8 -t UTF-16 > part.nc" ARGS moves part.nc EXIT 3 STDERR "is UTF-16 text")
clsurf_cli_test(NAME tape_with_leaders SETUP "head -c 4 /dev/zero > part.nc; for i in 1 2 3 4 5 6 7 8 9 10; do printf 'G1 X1 F100\\n'; done >> part.nc" ARGS info part.nc STDOUT "part.nc: program" "10 lines at feed")

# ---- logs with fewer axes, and without a program ----
set(lathe "printf 'time,cmd.x,cmd.z\\n0,20,0\\n0.001,20,-1\\n0.002,20,-2\\n0.003,21,-3\\n' > turn.csv; printf 'G18\\nG0 X20 Z0\\nG1 Z-2 F60000\\nX21 Z-3\\n' > turn.nc")
clsurf_cli_test(NAME log_of_x_and_z SETUP "${lathe}" ARGS export turn.nc turn.csv -o - --columns x,y,z,speed STDOUT "x .mm.,y .mm.,z .mm.,speed .mm/min.\n20,0,0,.*\n21,0,-3," STDERR "no channel 'cmd.y': this axis is assumed to stay at 0")
clsurf_cli_test(NAME log_of_x_alone SETUP "printf 'time,cmd.x\\n0,20\\n0.001,20\\n' > turn.csv; echo 'G1 X20 F100' > turn.nc" ARGS export turn.nc turn.csv -o - EXIT 3 STDERR "no commanded positions: channel .cmd.y. is missing")
clsurf_cli_test(NAME log_alone_exported SETUP "$CLSURF export ${part} ${run} -o with.csv --columns point,time,x,y,z; $CLSURF export ${run} -o alone.csv --columns point,time,x,y,z; cmp with.csv alone.csv"
  ARGS export ${run} -o - --columns line,cmd.x STDOUT "line,cmd.x .mm.")
clsurf_cli_test(NAME log_alone_plotted ARGS plot ${run} -o curve.png --size 320x240 --fields speed,acceleration FILE curve.png)
clsurf_cli_test(NAME log_alone_has_no_intervals ARGS export ${run} -o a.csv --columns interval EXIT 2 STDERR "needs the program")
clsurf_cli_test(NAME profile_in_numbers ARGS plot ${part} ${run} --profile 0,-3,0,3 --tool ball:6 -o cut.png FILE cut.png STDOUT "^Ra [0-9.]+ µm, Rz [0-9.]+ µm")
clsurf_cli_test(NAME profile_in_json ARGS plot ${part} ${run} --profile 0,-3,0,3 --tool ball:6 -o cut.png --json FILE cut.png STDOUT "\"ra_um\": [0-9.]+" "\"cutoff_mm\"" "\"schema_version\": 2")
clsurf_cli_test(NAME intervals_begin_with_the_first_line SETUP "printf 'G0 X0 Y0 Z0\\nG1 X10 F600\\nX20\\nX20.1 Y5\\nX20 Y10\\nM2\\n' > a.nc" ARGS intervals a.nc --format csv STDOUT "1,2,")
clsurf_cli_test(NAME intervals_have_units ARGS intervals ${part} STDOUT "mm +1/mm +1/mm +mm/min +mm/min +mm/min")

# ---- terminals ----
clsurf_cli_test(NAME colour_forced SETUP "CLICOLOR_FORCE=1 $CLSURF moves nowhere.nc 2> ../said || true; grep -q $'nowhere.nc: \\033.1\\;31merror:\\033.0m cannot open' ../said" ARGS moves nowhere.nc EXIT 3 STDERR "^nowhere.nc: error: cannot open")
clsurf_cli_test(NAME colour_refused SETUP "NO_COLOR=1 CLICOLOR_FORCE=1 $CLSURF moves nowhere.nc 2> ../said || true; ! grep -q $'\\033' ../said" ARGS moves nowhere.nc EXIT 3 STDERR "cannot open")
clsurf_cli_test(NAME terminal_gets_no_binary SETUP "script -qec '$CLSURF convert ${run} -o -' ../typed > /dev/null || test $? -eq 2; grep -q 'biip is binary and would be written to the terminal' ../typed" ARGS convert ${run} -o /dev/null)
clsurf_cli_test(NAME terminal_that_is_narrow SETUP "script -qec 'stty cols 50; $CLSURF machine --help' ../typed > /dev/null; sed 1d ../typed | tr -d '\\r' | awk 'length > 50 && !/Script/ { bad = 1; print } END { exit bad }'" ARGS machine --help STDOUT "usage")
