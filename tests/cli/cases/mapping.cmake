# Whether a log belongs to its program: foreign, edited and truncated ones, and lines that run again and again.
set(uneven @DATA@/programs/bottle_uneven.nc)
set(zigzag @DATA@/programs/bottle_zigzag.nc)
set(uneven_log @LOGS@/bottle_uneven.biip)

# ---- a log of another program ----
set(foreign_error "bottle_uneven.biip: error: does not belong to .*bottle_zigzag.nc: 100 % of [0-9]+ checked points")
foreach(subcommand "check" "query --point 9" "render -o out.png" "report -o out.html" "plot -o out.png" "export -o out.csv")
  separate_arguments(words UNIX_COMMAND "${subcommand}")
  list(POP_FRONT words name)
  clsurf_cli_test(NAME foreign_log_in_${name} ARGS ${name} ${zigzag} ${uneven_log} ${words} EXIT 3 STDERR "${foreign_error}" "--force")
endforeach()
clsurf_cli_test(NAME foreign_log_in_info ARGS info ${zigzag} ${uneven_log} EXIT 3 STDOUT "error: .*does not belong to .*bottle_zigzag.nc")
clsurf_cli_test(NAME foreign_log_forced ARGS check ${zigzag} ${uneven_log} --force EXIT 5
  STDOUT "NOT JUDGED: The log does not belong to this program" STDERR "warning: does not belong to")
clsurf_cli_test(NAME info_of_a_log_without_positions EXIT 3
  SETUP "printf '[log]\\nformat = \"delimited\"\\nperiod_s = 0.001\\n[[column]]\\nfrom = \"a\"\\nname = \"cmd.x\"\\nunit = \"mm\"\\n' > map.toml; (echo a; seq 1 50) > run.csv"
  ARGS info run.csv --mapping map.toml STDOUT "error: .*no role has x, y and z")

# ---- an edited program ----
set(insert_comment "sed '5i (a comment)' ${uneven} > bottle_uneven.nc")
clsurf_cli_test(NAME comment_inserted_after_the_run SETUP "${insert_comment}" ARGS query bottle_uneven.nc ${uneven_log} --at 2.0,-5.6,4.7
  STDOUT "^line 569: X2.013" "confidence 0[.]95" STDERR "was edited after the run" "1 line inserted before line [5-7] since the run")
clsurf_cli_test(NAME lines_deleted_after_the_run SETUP "sed '1000,1011d' ${uneven} > bottle_uneven.nc" ARGS query bottle_uneven.nc ${uneven_log} --point 20000 --json
  STDOUT "\"confidence\": 0[.]95" "12 lines deleted before line 101[23]")
clsurf_cli_test(NAME feed_changed_after_the_run SETUP "sed 's/F3000/F2500/' ${uneven} > bottle_uneven.nc" ARGS query bottle_uneven.nc ${uneven_log} --at 2.0,-5.6,4.7
  STDOUT "^line 568: X2.013" "confidence 0[.]95")
clsurf_cli_test(NAME crlf_is_the_same_program SETUP "sed 's/$/\\r/' ${uneven} > bottle_uneven.nc" ARGS info bottle_uneven.nc ${uneven_log}
  STDOUT "positions lie" NO_STDOUT "edited" "another program")
# The log of petal_spiral carries no hash.
clsurf_cli_test(NAME lines_inserted_without_a_hash SETUP "sed -e '3000i (a)' -e '3000i (b)' @DATA@/programs/petal_spiral.ngc > petal_spiral.ngc"
  ARGS query petal_spiral.ngc @LOGS@/petal_spiral.raw --layout @DATA@/logs/petal_spiral.layout.toml --point 70000
  STDOUT "confidence 0[.]95" STDERR "2 lines inserted before line 300[0-9]")

# ---- a log that ends early ----
foreach(subcommand "check" "render -o out.png --size 160x120" "report -o out.html")
  separate_arguments(words UNIX_COMMAND "${subcommand}")
  list(POP_FRONT words name)
  clsurf_cli_test(NAME truncated_log_in_${name} SETUP "head -c 1000000 @LOGS@/bottle_uneven.biip > run.biip"
    ARGS ${name} ${uneven} run.biip ${words} STDERR "the log ends at line 2035: 45 % of the program's motions are missing after it")
endforeach()
clsurf_cli_test(NAME truncated_log_is_not_judged SETUP "head -c 300000 @LOGS@/bottle_uneven.biip > run.biip" ARGS check ${uneven} run.biip EXIT 5
  STDOUT "NOT JUDGED: The log lacks 88 % of the program's motions")
clsurf_cli_test(NAME lines_of_another_program_are_one_finding ARGS info ${uneven} @LOGS@/bottle_zigzag.biip EXIT 3
  STDOUT "points have a line that is none of the program's 3716: 3718 … 3938")
