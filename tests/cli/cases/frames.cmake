# Work frames and poses of logs on the command line.

set(g55 "printf 'G21 G90\\nG10 L2 P2 X100\\nG54 G0 X0 Y0 Z5\\nG1 X20 F3000\\nG55\\nG1 X0\\nM2\\n' > g55.ngc")
set(g92 "printf 'G21 G90\\nG0 X82 Y10 Z5\\nG92 X0 Y0\\nG1 Z0 F100\\nX10 F1000\\nM2\\n' > g92.ngc")
# From X 20, 80 mm forward; exported positions are in the coordinates of the first cut.
clsurf_cli_test(NAME another_work_system_is_where_its_offset_puts_it
  SETUP "${g55} && $CLSURF simulate g55.ngc --dialect linuxcnc -o run.biip > /dev/null && $CLSURF export g55.ngc run.biip --dialect linuxcnc -o run.csv && tail -n 1 run.csv | grep -q '^[0-9]*,[0-9.]*,6,100,0,5,'"
  ARGS info g55.ngc run.biip --dialect linuxcnc STDOUT "positions deviate by 0.0000 mm .median. and 0.0000 mm" NO_STDOUT "another program")
clsurf_cli_test(NAME moves_stay_in_their_work_system SETUP "${g55}" ARGS moves g55.ngc --dialect linuxcnc STDOUT "6,feed,0,0,5")
# The plunge after G92 is 5 mm at F100, 3 s; without the shift it would be 82 mm, 50 s.
clsurf_cli_test(NAME shifted_position_moves_nothing
  SETUP "${g92} && $CLSURF simulate g92.ngc --dialect linuxcnc -o run.biip > /dev/null && $CLSURF export g92.ngc run.biip --dialect linuxcnc -o run.csv && tail -n 1 run.csv | grep -q ',5,10,0,0,'"
  ARGS info g92.ngc run.biip --dialect linuxcnc STDOUT "4[.]1[0-9]* s" "positions deviate by 0.0000 mm .median. and 0.0000 mm" NO_STDOUT "another program")
clsurf_cli_test(NAME info_layout_is_of_the_log
  ARGS info @DATA@/programs/petal_spiral.ngc @LOGS@/petal_spiral.raw --layout @DATA@/logs/petal_spiral.layout.toml
  STDOUT "petal_spiral.ngc: program, dialect" "petal_spiral.raw: log, format" "positions deviate by 0.0")
clsurf_cli_test(NAME info_mapping_is_of_the_log
  SETUP "printf 'G21 G90\\nG0 X0 Y0 Z0\\nG1 X1 F6000\\nM30\\n' > part.nc; seq 0 10 | awk '{print $1/1000, $1/10, 0, 0, 3}' > run.txt; printf '[log]\\nformat = \"delimited\"\\nseparator = \" \"\\nperiod_s = 0.001\\n' > run.toml; for c in '1 cmd.x mm' '2 cmd.y mm' '3 cmd.z mm' '4 line '; do set -- $c; printf '[[column]]\\nfrom = %s\\nname = \"%s\"\\nunit = \"%s\"\\n' $1 $2 \"$3\" | sed 's/\"\"/\"/g' >> run.toml; done"
  ARGS info part.nc run.txt --mapping run.toml STDOUT "part.nc: program" "run.txt: log")

# ---- the pose of a log ----
# A run in a rotated work system that its program does not set: `info` finds it and names the option.
set(wavy "(printf 'G21 G90 G61\\n(offset)\\nG54 G0 Z10\\nG0 X0 Y0\\nG1 Z0 F600\\n' && awk 'BEGIN{for(k=0;k<8;++k)for(i=0;i<=60;++i){x=k%2?30-i/2:i/2;y=0.4*k;printf \"G1 X%.3f Y%.3f Z%.4f F2400\\n\",x,y,-1+0.8*sin(x/4)+0.02*y}}' && printf 'G0 Z10\\nM2\\n') > part.ngc")
set(turned_run "${wavy} && sed 's/^.offset.$/G10 L2 P1 X35.5 Y-22.25 Z-14 R17.5/' part.ngc > turned.ngc && $CLSURF simulate turned.ngc --dialect linuxcnc -o run.biip > /dev/null")
clsurf_cli_test(NAME pose_of_a_turned_log SETUP "${turned_run}" ARGS info part.ngc run.biip --dialect linuxcnc
  STDOUT "turned by 17[.]5 deg about Z, and displaced by X 35[.]5 Y -22[.]25 Z -14 mm" "--work-offset 35[.]5,-22[.]25,-14,17[.]5 aligns them")
clsurf_cli_test(NAME work_offset_with_a_rotation SETUP "${turned_run}" ARGS info part.ngc run.biip --dialect linuxcnc --work-offset 35.5,-22.25,-14,17.5
  STDOUT "positions deviate by 0.0000 mm .median. and 0.000" NO_STDOUT "displaced" "map.disagreement")
clsurf_cli_test(NAME report_with_a_work_offset
  SETUP "${turned_run} && $CLSURF report part.ngc run.biip --dialect linuxcnc --work-offset 35.5,-22.25,-14,17.5 -o page.html 2> said.txt && ! grep -E 'displaced|does not belong|farther' said.txt"
  ARGS report part.ngc run.biip --dialect linuxcnc --work-offset G54:35.5,-22.25,-14,17.5 -o again.html FILE again.html)
clsurf_cli_test(NAME report_without_its_work_offset_is_told_it SETUP "${turned_run}" ARGS report part.ngc run.biip --dialect linuxcnc -o page.html
  STDERR "--work-offset 35[.]5,-22[.]25,-14,17[.]5 aligns them")
clsurf_cli_test(NAME work_offset_of_the_program_itself SETUP "${turned_run}" ARGS info turned.ngc run.biip --dialect linuxcnc
  STDOUT "positions deviate by 0.0000 mm .median. and 0.000" NO_STDOUT "displaced" "map.disagreement")
# The same log from a control that records the work system.
clsurf_cli_test(NAME positions_of_the_work_system
  SETUP "${turned_run} && $CLSURF simulate part.ngc --dialect linuxcnc -o run.biip > /dev/null"
  ARGS info turned.ngc run.biip --dialect linuxcnc STDOUT "read as those of the work system, without the offset 35[.]5,-22[.]25,-14,17[.]5" "positions deviate by 0.0000 mm .median. and 0.000")
# Two systems, neither set by the program: each has its own pose.
set(two_systems "${wavy} && (sed 's/^M2$/G55/' part.ngc && sed -n '4,$p' part.ngc) > two.ngc && sed 's/^G21 G90 G61$/G21 G90 G61 G10 L2 P1 X35.5 Y-22.25 Z-14/; s/^.offset.$/G10 L2 P2 X135 Y7 Z-3 R90/' two.ngc > moved.ngc && $CLSURF simulate moved.ngc --dialect linuxcnc -o run.biip > /dev/null")
clsurf_cli_test(NAME poses_of_two_systems
  SETUP "${two_systems}"
  ARGS info two.ngc run.biip --dialect linuxcnc
  STDOUT "cuts in G54 and G55, and sets none of them" "--work-offset 35[.]5,-22[.]25,-14 --work-offset G55:135,7,-3,90 aligns them")
clsurf_cli_test(NAME work_offset_of_two_systems
  SETUP "${two_systems}"
  ARGS info two.ngc run.biip --dialect linuxcnc --work-offset 35.5,-22.25,-14 --work-offset G55:135,7,-3,90
  STDOUT "positions deviate by 0.0000 mm .median. and 0.000" NO_STDOUT "displaced" "sets none")
clsurf_cli_test(NAME work_offset_of_an_unknown_system ARGS info ${part} ${run} --work-offset G53:1,2,3 EXIT 2 STDERR "'G53' is not a work system")
