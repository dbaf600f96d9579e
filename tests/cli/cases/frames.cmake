# Work frames and poses of logs, as a user types them.

set(g55 "printf 'G21 G90\\nG10 L2 P2 X100\\nG54 G0 X0 Y0 Z5\\nG1 X20 F3000\\nG55\\nG1 X0\\nM2\\n' > g55.ngc")
set(g92 "printf 'G21 G90\\nG0 X82 Y10 Z5\\nG92 X0 Y0\\nG1 Z0 F100\\nX10 F1000\\nM2\\n' > g92.ngc")
# From X 20 on 80 mm forward; what is exported is in the coordinates of the first cut.
clsurf_cli_test(NAME another_work_system_is_where_its_offset_puts_it
  SETUP "${g55} && $CLSURF simulate g55.ngc --dialect linuxcnc -o run.biip > /dev/null && $CLSURF export g55.ngc run.biip --dialect linuxcnc -o run.csv && tail -n 1 run.csv | grep -q '^[0-9]*,[0-9.]*,6,100,0,5,'"
  ARGS info g55.ngc run.biip --dialect linuxcnc STDOUT "positions lie 0.0000 mm .median. and 0.0000 mm" NO_STDOUT "another program")
clsurf_cli_test(NAME moves_stay_in_their_work_system SETUP "${g55}" ARGS moves g55.ngc --dialect linuxcnc STDOUT "6,feed,0,0,5")
# The plunge after G92 is one: 5 mm down at F100 are 3 s, 82 mm would be 50 s.
clsurf_cli_test(NAME shifted_position_moves_nothing
  SETUP "${g92} && $CLSURF simulate g92.ngc --dialect linuxcnc -o run.biip > /dev/null && $CLSURF export g92.ngc run.biip --dialect linuxcnc -o run.csv && tail -n 1 run.csv | grep -q ',5,10,0,0,'"
  ARGS info g92.ngc run.biip --dialect linuxcnc STDOUT "4[.]1[0-9]* s" "positions lie 0.0000 mm .median. and 0.0000 mm" NO_STDOUT "another program")
clsurf_cli_test(NAME info_layout_is_of_the_log
  ARGS info @DATA@/programs/petal_spiral.ngc @LOGS@/petal_spiral.raw --layout @DATA@/logs/petal_spiral.layout.toml
  STDOUT "petal_spiral.ngc: program, dialect" "petal_spiral.raw: log, format" "positions lie 0.0")
clsurf_cli_test(NAME info_mapping_is_of_the_log
  SETUP "printf 'G21 G90\\nG0 X0 Y0 Z0\\nG1 X1 F6000\\nM30\\n' > part.nc; seq 0 10 | awk '{print $1/1000, $1/10, 0, 0, 3}' > run.txt; printf '[log]\\nformat = \"delimited\"\\nseparator = \" \"\\nperiod_s = 0.001\\n' > run.toml; for c in '1 cmd.x mm' '2 cmd.y mm' '3 cmd.z mm' '4 line '; do set -- $c; printf '[[column]]\\nfrom = %s\\nname = \"%s\"\\nunit = \"%s\"\\n' $1 $2 \"$3\" | sed 's/\"\"/\"/g' >> run.toml; done"
  ARGS info part.nc run.txt --mapping run.toml STDOUT "part.nc: program" "run.txt: log")
