# Data that cannot show marks: `info` warns, `check` gives no verdict.

# A zigzag of 20 passes at 10 mm/s and its log, a record every T seconds; if P is set, every 300th record is a placeholder.
set(zigzag_program "(printf 'G21 G90 G54\\nG0 X0 Y0 Z5\\nG1 Z0 F600\\n' && awk 'BEGIN { for (k = 0; k < 20; k++) printf \"G1 X%d\\nY%.1f\\n\", k % 2 ? 0 : 20, 0.4 * (k + 1) }' && echo M30) > part.nc")
set(zigzag_log "'BEGIN { print \"time,cmd.x,cmd.y,cmd.z\"; n = 0; for (k = 0; k < 20; k++) for (s = 0; s < 20; s += 10 * T) { if (P && n % 300 == 150) printf \"%.3f,198,158,119\\n\", n * T; else printf \"%.3f,%.3f,%.3f,0\\n\", n * T, k % 2 ? 20 - s : s, 0.4 * k; n++ } }' > run.csv")

clsurf_cli_test(NAME slow_records_are_not_judged SETUP "${zigzag_program} && awk -v T=0.1 ${zigzag_log}" ARGS check part.nc run.csv
  EXIT 5 STDOUT "NOT JUDGED: A record comes every 100 ms[.]")
clsurf_cli_test(NAME info_warns_of_slow_records SETUP "awk -v T=0.1 ${zigzag_log}" ARGS info run.csv STDOUT "a record every 100 ms: marks")
clsurf_cli_test(NAME placeholders_are_not_judged SETUP "${zigzag_program} && awk -v T=0.01 -v P=1 ${zigzag_log}" ARGS check part.nc run.csv
  EXIT 5 STDOUT "NOT JUDGED: .*jumps to X198 Y158 Z119 and back 1[0-9] times")
clsurf_cli_test(NAME info_warns_of_placeholders SETUP "awk -v T=0.01 -v P=1 ${zigzag_log}" ARGS info run.csv
  STDOUT "jumps to X198 Y158 Z119 and back 1[0-9] times, here for the first time, over up to 27[0-9][.][0-9] mm")
clsurf_cli_test(NAME a_record_every_ten_milliseconds_is_judged SETUP "${zigzag_program} && awk -v T=0.01 ${zigzag_log}" ARGS check part.nc run.csv
  STDOUT "0 defects on 20 passes")
