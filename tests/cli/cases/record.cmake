# Recordings over Modbus. Errors before a recording begins leave no file; the rest is in tests/cli/record_test.
set(registers "printf '[[channel]]\\nname = \"load\"\\nfunction = \"input\"\\naddress = 7\\ntype = \"u16\"\\n' > registers.toml")
clsurf_cli_test(NAME record_without_an_address SETUP "${registers}" ARGS record --map registers.toml -o run.biip EXIT 2 STDERR "modbus")
clsurf_cli_test(NAME record_without_a_map ARGS record --modbus tcp:127.0.0.1:1 -o run.biip EXIT 2 STDERR "map")
clsurf_cli_test(NAME record_wrong_address SETUP "${registers}" ARGS record --modbus plc:502 --map registers.toml -o run.biip EXIT 2 STDERR "--modbus: 'plc:502': is neither tcp:HOST:PORT nor rtu:DEVICE,BAUD" "hint: for example tcp:192.168.0.10:502")
clsurf_cli_test(NAME record_wrong_baud SETUP "${registers}" ARGS record --modbus rtu:/dev/ttyS0,9601 --map registers.toml -o run.biip EXIT 2 STDERR "'9601' is not a baud rate")
clsurf_cli_test(NAME record_wrong_rate SETUP "${registers}" ARGS record --modbus tcp:127.0.0.1:1 --map registers.toml --rate 0 -o run.biip EXIT 2 STDERR "--rate must be between 0.000277778 and 1000")
clsurf_cli_test(NAME record_wrong_timeout SETUP "${registers}" ARGS record --modbus tcp:127.0.0.1:1 --map registers.toml --timeout 0 -o run.biip EXIT 2 STDERR "--timeout must be between 0.001 and 3600")
clsurf_cli_test(NAME record_wrong_ending SETUP "${registers}" ARGS record --modbus tcp:127.0.0.1:1 --map registers.toml -o run.csv EXIT 2 STDERR "'run.csv' must end in .biip")
clsurf_cli_test(NAME record_refused SETUP "${registers}" ARGS record --modbus tcp:127.0.0.1:1 --map registers.toml -o run.biip EXIT 4 STDERR "cannot connect to tcp:127.0.0.1:1: Connection refused")
clsurf_cli_test(NAME record_no_device SETUP "${registers}" ARGS record --modbus rtu:nowhere,9600 --map registers.toml -o run.biip EXIT 4 STDERR "cannot connect to rtu:nowhere,9600: No such file")
clsurf_cli_test(NAME record_position SETUP "${registers}; sed -i 's/load/cmd.x/' registers.toml" ARGS record --modbus tcp:127.0.0.1:1 --map registers.toml -o run.biip
  EXIT 3 STDERR "registers.toml:2:[0-9]+: error: 'cmd.x' cannot come from Modbus" "display.cmd.x")
clsurf_cli_test(NAME record_unknown_key SETUP "${registers}; echo 'offset = 3' >> registers.toml" ARGS record --modbus tcp:127.0.0.1:1 --map registers.toml -o run.biip EXIT 3 STDERR "registers.toml:6:[0-9]+: error: unknown key 'offset'")

# ---- slow channels joined to a log ----
clsurf_cli_test(NAME join_age_without_join ARGS convert ${run} --join-age 3 -o run.biip EXIT 2 STDERR "--join-age needs --join")
clsurf_cli_test(NAME join_without_a_time SETUP "$CLSURF export ${run} -o slow.biip --columns time,speed" ARGS convert ${run} --join slow.biip -o joined.biip EXIT 2 STDERR "does not say when it was recorded" "hint: --join-offset S")
clsurf_cli_test(NAME join_what_both_have ARGS convert ${run} --join ${run} --join-offset 0 -o joined.biip EXIT 3 STDERR "channel '[a-z.]+' is in [^ ]*bottle_uneven.biip, too")
clsurf_cli_test(NAME join_nothing_in_common SETUP "$CLSURF export ${run} -o slow.biip --columns time,acceleration" ARGS convert ${run} --join slow.biip --join-offset 1000 -o joined.biip EXIT 3 STDERR "has no value at any time of [^ ]*bottle_uneven.biip, which begins 1000.000 s after it")

add_test(NAME cli.record COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/cli/record_test
  ${PROJECT_BINARY_DIR}/tests/cli/record $<TARGET_FILE:clsurf> $<TARGET_FILE:clsurf_modbus_server> ${PROJECT_SOURCE_DIR}/data ${PROJECT_BINARY_DIR}/samples)
set_tests_properties(cli.record PROPERTIES TIMEOUT 120)

# The output of `record` has no positions.
set(slow_signals "$CLSURF export ${run} -o slow.biip --columns time,speed,acceleration -q")
clsurf_cli_test(NAME export_slow_signals SETUP "${slow_signals}; $CLSURF export slow.biip -o out.csv; $CLSURF export ${run} -o same.csv --columns time,speed,acceleration -q; head -n 1 out.csv | grep -q '^time .s.,speed .mm/min.,acceleration' && cut -d, -f2 out.csv > a; cut -d, -f2 same.csv > b; cmp a b" ARGS --version)
clsurf_cli_test(NAME export_slow_signals_chosen SETUP "${slow_signals}" ARGS export slow.biip -o out.biip --columns point,acceleration FILE out.biip)
clsurf_cli_test(NAME export_slow_signals_without_positions SETUP "${slow_signals}" ARGS export slow.biip -o out.csv --columns time,x EXIT 2 STDERR "'x' is not a channel of slow.biip, which has no positions" "hint: one of point, time, speed, acceleration" NO_FILE out.csv)
clsurf_cli_test(NAME export_slow_signals_as_vtk SETUP "${slow_signals}" ARGS export slow.biip -o out.vtp EXIT 2 STDERR "has no positions, which VTK files need" NO_FILE out.vtp)
