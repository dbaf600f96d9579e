# Constant-speed intervals: the list, a controller that follows them, a repair with their feeds.

set(uneven @DATA@/programs/bottle_uneven.nc)
clsurf_cli_test(NAME intervals_text ARGS intervals @DATA@/programs/transition_g61.nc STDOUT "intervals on 21 passes")
clsurf_cli_test(NAME intervals_json ARGS intervals ${uneven} --json STDOUT "\"own_speed_mm_min\"" "\"passes\": 41")
clsurf_cli_test(NAME intervals_wrong_ratio ARGS intervals ${uneven} --curvature-ratio 1 EXIT 2 STDERR "--curvature-ratio must be above 1")
clsurf_cli_test(NAME intervals_of_a_length ARGS intervals @DATA@/programs/transition_g61.nc --max-length 2 STDOUT "intervals on 21 passes")
clsurf_cli_test(NAME intervals_wrong_length ARGS intervals ${uneven} --max-length 0 EXIT 2 STDERR "--max-length must be above 0")
# √(100 mm/s² / κ): the speed at the wave's crests, which a controller that plans by intervals does not exceed.
set(wave "awk 'BEGIN { print \"G21 G90 G64 P0.01\\nG0 X0 Y0 Z20\\nG1 Z0 F1000\\nF3000\"; for (k = 0; k < 6; ++k) for (i = 0; i <= 200; ++i) { x = 0.1 * (k % 2 ? 200 - i : i); printf \"G1 X%.3f Y%.1f Z%.3f\\n\", x, 0.3 * k, 1.5 * sin(0.3 * x) } print \"M2\" }' > wave.ngc && sed 's/max_normal_acceleration = 1500/max_normal_acceleration = 100/' @DATA@/machines/three_axis_mill.toml > slow.toml && sed 's/feed = \"programmed\"/feed = \"intervals\"/' slow.toml > intervals.toml")
clsurf_cli_test(NAME simulate_by_intervals SETUP "${wave}" ARGS simulate wave.ngc --machine intervals.toml --json -o run.biip STDOUT "\"limits_ok\": true" FILE run.biip)
clsurf_cli_test(NAME simulate_unknown_feed_rule SETUP "${wave} && sed -i 's/intervals/interval/' intervals.toml" ARGS simulate wave.ngc --machine intervals.toml -o run.biip EXIT 3 STDERR "'feed' is 'interval', which is not known" "did you mean 'intervals'")
# Corners slow down single passes of this part.
clsurf_cli_test(NAME optimize_by_intervals SETUP "sed 's/^G61/G64 P0.005/' @DATA@/programs/transition_g61.nc > transition.nc"
  ARGS optimize transition.nc --machine @DATA@/machines/three_axis_mill.toml --feeds intervals --more-time 5 -o better.nc STDOUT "accepted" "of speed +[0-9]+ +0 +-100" FILE better.nc)
clsurf_cli_test(NAME optimize_unknown_feeds ARGS optimize ${uneven} --feeds wu -o better.nc EXIT 2 STDERR "--feeds: 'wu' is not one of searched, intervals")
clsurf_cli_test(NAME intervals_as_colours ARGS render @DATA@/programs/transition_g61.nc @LOGS@/transition_g61.biip --color interval -o map.png --size 160x120 FILE map.png)
