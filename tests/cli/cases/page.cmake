# The page of `report`: its controls and its content, read from the file (tests/cli/read_page.py).

set(read_page "python3 @DATA@/../tests/cli/read_page.py")

# ---- the command line on the page reads the same as the report ----
# A text log without time needs --period; a tool table whose name needs quotes, a block that is skipped by default, a work
# offset.
set(report_of_text "printf 'G21 G90\\nG0 X0 Y0 Z0\\n/G1 X2 F600\\nG1 X40 F600\\nY0.5\\nX0\\nM2\\n' > part.nc"
  "$CLSURF simulate part.nc --block-delete off -o run.biip -q"
  "$CLSURF export part.nc run.biip --block-delete off --columns cmd.x,cmd.y,cmd.z -o run.csv"
  "printf 'T1 P1 D6.0 Z0\\n' > 'my tools.tbl'"
  "how='--dialect fanuc --block-delete off --period 0.001 --work-offset 0,0,-5 --ignore-lines --force'"
  "$CLSURF report part.nc run.csv $how --tools 'my tools.tbl' -o page.html"
  "look='--color speed --size 160x120 -o'")
clsurf_cli_test(NAME page_offers_a_command_that_draws_the_same
  SETUP "${report_of_text} && $CLSURF render part.nc run.csv $how --tools 'my tools.tbl' $look typed.png && eval \"$CLSURF render part.nc run.csv $(${read_page} options page.html) $look printed.png\" && cmp typed.png printed.png"
  ARGS --version)

# ---- positions of the other roles are tip positions ----
clsurf_cli_test(NAME page_shows_all_roles_of_five_axes_at_the_tip
  SETUP "$CLSURF simulate @DATA@/programs/dome_five_axis.nc --machine @DATA@/machines/five_axis_trunnion.toml --work-offset 10,20,30 -o run.biip -q && $CLSURF report @DATA@/programs/dome_five_axis.nc run.biip --machine @DATA@/machines/five_axis_trunnion.toml -o page.html && ${read_page} roles page.html | grep -q '^feedback 0[.]'"
  ARGS --version)

