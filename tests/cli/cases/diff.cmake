# Runs on five axes are compared by the tip of the tool.

set(dome @DATA@/programs/dome_five_axis.nc)
set(trunnion --machine @DATA@/machines/five_axis_trunnion.toml)
string(REPLACE ";" " " trunnion_words "${trunnion}")
# The same part clamped elsewhere: its axes move otherwise, its tip does not.
set(clamped_elsewhere "$CLSURF simulate ${dome} ${trunnion_words} --work-offset 10,20,30 -o here.biip -q && $CLSURF simulate ${dome} ${trunnion_words} --work-offset -40,5,60 -o there.biip -q")
clsurf_cli_test(NAME diff_lays_tips_onto_each_other SETUP "${clamped_elsewhere}"
  ARGS diff here.biip there.biip ${trunnion} STDOUT "(100[.]0|9[0-9][.][0-9]) % of")
clsurf_cli_test(NAME diff_lays_a_simulated_program_onto_its_log SETUP "${clamped_elsewhere}"
  ARGS diff ${dome} here.biip ${trunnion} --work-offset 10,20,30 STDOUT "100[.]0 % of")
clsurf_cli_test(NAME diff_warns_of_rotary_axes_without_a_machine SETUP "${clamped_elsewhere}"
  ARGS diff here.biip here.biip STDERR "here.biip: warning: axis a moves by")
clsurf_cli_test(NAME diff_knows_the_lines_of_a_program_on_five_axes SETUP "${clamped_elsewhere}"
  ARGS diff here.biip there.biip ${trunnion} --program ${dome} STDOUT "(100[.]0|9[0-9][.][0-9]) % of")
