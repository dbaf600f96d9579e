# `check --machine`: compares the commanded motion with the limits of its machine.

set(kept @DATA@/programs/micro_segments.ngc @LOGS@/micro_segments.arcs.biip)
set(exceeded @DATA@/programs/tangential_lines.ngc @LOGS@/tangential_lines.parabolic.biip)
string(REPLACE ";" " " exceeded_words "${exceeded}")
# The limits given to the kernel: those of its axes, none of the path.
string(CONCAT axes_only
  "for a in x y z; do printf '[[axis]]\\nname = \"%s\"\\nmax_acceleration = %s\\nmax_speed = %s\\n' $a "
  "$(test $a = z && echo 1500 9000 || echo 2000 15000); done > axes.toml")
set(one "echo 'max_limit_factor = 1' > budget.toml")
set(two "echo 'max_limit_factor = 2' > budget.toml")

# The blend of line 302 has 1.5005 times the limit of y, for 7 ms: a plain second difference of the positions.
clsurf_cli_test(NAME limits_find_the_parabolic_blend SETUP "${axes_only}" ARGS check ${exceeded} --machine axes.toml
  EXIT 5 STDOUT "^LIMITS EXCEEDED in 2 places. Worst: The acceleration of y is 1[.]50[01] ± 0[.]001 times its limit for [78] ms: 300[01] of 2000 mm/s², line 302[.]")
clsurf_cli_test(NAME limits_in_json SETUP "${axes_only}" ARGS check ${exceeded} --machine axes.toml --json EXIT 5
  STDOUT "\"limits\": .*\"quantity\": \"acceleration\",.*\"axis\": \"y\",.*\"factor\": 1[.]500.*\"uncertainty\": 0[.]001,.*\"value\": 300[01].*\"limit\": 2000.*\"unit\": \"mm/s²\",.*\"line\": 302,.*\"text\": \".*\",.*\"time_s\": 8[.]389.*\"duration_s\": 0[.]00[78].*\"point\": 8389,.*\"tip_mm\":"
  NO_STDOUT "path_speed" "nan")
clsurf_cli_test(NAME limits_in_csv SETUP "${axes_only} && ($CLSURF check ${exceeded_words} --machine axes.toml --format csv > report.csv; test $? = 5) && awk -F, 'NR == 1 { n = NF } NF != n { exit 1 }' report.csv && grep -q '^[0-9]*,,limit,,302,302,838[0-9],839[0-9],.*,acceleration,,tool tip,,,,y,1[.]500' report.csv" ARGS --version)
clsurf_cli_test(NAME limits_in_sarif SETUP "${axes_only}" ARGS check ${exceeded} --machine axes.toml --format sarif EXIT 5
  STDOUT "\"ruleId\": \"limit_acceleration\".*\"level\": \"error\".*\"startLine\": 302" "\"clsurfLimit/v1\": \"limit_acceleration/y/302/1\"")
clsurf_cli_test(NAME limits_that_are_kept SETUP "${axes_only}" ARGS check ${kept} --machine axes.toml
  EXIT 5 STDOUT "^The commanded motion keeps all [0-9]+ limits that are stated for it" "\n  acceleration +x .* z 1[.]001")
# A file without [path] has no limits of the path.
clsurf_cli_test(NAME limits_are_those_of_the_file SETUP "printf '[[axis]]\\nname = \"x\"\\nmax_speed = 15000\\n' > x.toml" ARGS check ${exceeded} --machine x.toml --json
  EXIT 5 NO_STDOUT "\"quantity\": \"acceleration\"" "\"axis\": \"y\"" "path_speed" STDOUT "\"quantity\": \"speed\"")

# ---- budgets ----
clsurf_cli_test(NAME limit_factor_not_held SETUP "${axes_only} && ${one}" ARGS check ${exceeded} --machine axes.toml --budget budget.toml
  EXIT 1 STDOUT "budget max_limit_factor +1[.]50[01] of 1 +NOT KEPT")
clsurf_cli_test(NAME limit_factor_held SETUP "${axes_only} && ${two}" ARGS check ${exceeded} --machine axes.toml --budget budget.toml
  STDOUT "budget max_limit_factor +1[.]50[01] of 2 +kept")
clsurf_cli_test(NAME limit_factor_of_a_clean_run SETUP "${axes_only} && ${one}" ARGS check ${kept} --machine axes.toml --budget budget.toml
  STDOUT "budget max_limit_factor +1 of 1 +kept")
clsurf_cli_test(NAME limit_factor_needs_a_machine SETUP "${one}" ARGS check ${kept} --budget budget.toml EXIT 2 STDERR "max_limit_factor in budget.toml needs the limits of the machine")
clsurf_cli_test(NAME following_error_against_the_budget SETUP "echo 'max_following_error_um = 10' > budget.toml" ARGS check ${exceeded} --budget budget.toml --json
  EXIT 1 STDOUT "\"quantity\": \"following_error\",.*\"limit\": 0[.]01,.*\"unit\": \"mm\"")

# ---- fields ----
clsurf_cli_test(NAME limit_share_as_a_colour SETUP "${axes_only}" ARGS render ${exceeded} --machine axes.toml --color acceleration_share -o map.png --size 320x240 FILE map.png)
clsurf_cli_test(NAME limit_share_of_an_axis_in_a_table SETUP "${axes_only} && $CLSURF export ${exceeded_words} --machine axes.toml --columns acceleration_share.y,acceleration_share -o shares.csv > /dev/null && awk -F, 'NR == 8391 { exit !($1 > 1.499 && $1 < 1.502 && $2 == $1) }' shares.csv" ARGS --version)
clsurf_cli_test(NAME limit_share_needs_a_machine ARGS render ${exceeded} --color jerk_share -o map.png EXIT 2 STDERR "jerk_share" "--machine")

# ---- modulo axes ----
# C turns from 350 deg at 20 deg/s and is logged modulo 360.
string(CONCAT turning
  "printf 'G21 G90 G94\\nG1 X0 Y0 Z0 A0 C350 F6000\\nG1 Z20 C390 F600\\nM2\\n' > turning.nc && "
  "printf '[[axis]]\\nname = \"c\"\\nmax_speed = 1500\\nmax_acceleration = 1000\\n[kinematics]\\ntype = \"table-table\"\\n' > c.toml && "
  "awk 'BEGIN { print \"time,cmd.x [mm],cmd.y [mm],cmd.z [mm],cmd.a [deg],cmd.c [deg]\"; "
  "for (i = 0; i < 2000; i++) printf \"%.3f,0,0,%.6f,0,%.4f\\n\", i * 0.001, i * 0.01, (350 + i * 0.02) % 360 }' > turning.csv")
clsurf_cli_test(NAME a_wrap_of_a_modulo_axis_is_no_motion SETUP "${turning}" ARGS check turning.nc turning.csv --machine c.toml
  EXIT 5 STDOUT "^The commanded motion keeps all 2 limits that are stated for it")
clsurf_cli_test(NAME a_modulo_axis_is_noted SETUP "${turning}" ARGS info turning.csv
  STDOUT "axis c counts within one turn and wraps 1 time, first here: its positions are unwrapped")
