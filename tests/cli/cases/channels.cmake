# Channels of a log: how they are shown.

# Units that are in no table of the program.
clsurf_cli_test(NAME channels_keep_their_units
  SETUP "printf 'cmd.x [mm],cmd.y [mm],cmd.z [mm],coolant [bar],load [Nm],turns [rpm],table [deg/min],drive [mm/s²]\\n' > run.csv && awk 'BEGIN { for (i = 0; i < 400; ++i) printf \"%g,0,0,%g,2,3,4,5\\n\", i / 10, i % 50 }' >> run.csv && $CLSURF export run.csv --period 0.001 -o out.csv --columns coolant,load,turns,table,drive && head -n 1 out.csv > names && cat names && grep -q 'bar.*Nm.*rpm.*deg/min.*mm/s²' names"
  ARGS --version)
