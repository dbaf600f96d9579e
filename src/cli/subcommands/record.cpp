// clsurf record: registers of a Modbus device, as slow channels of a log.

#include <fmt/format.h>

#include "cli/options/options.h"
#include "cli/options/output_format.h"
#include "cli/progress_bar.h"
#include "cli/stop_signal.h"
#include "io/modbus/modbus_recording.h"
#include "io/reports/recording_report.h"

namespace clsurf::cli {
namespace {

double number_between(double least, double most, const po::variables_map& values, const char* name) {
    const double value = values[name].as<double>();
    if (!(value >= least && value <= most))
        throw UsageError(fmt::format("--{} must be between {:g} and {:g}", name, least, most));
    return value;
}

io::RecordingRules read_rules(const po::variables_map& values) {
    constexpr double millisecond = 0.001, hour = 3600, year = 366 * 86400.0;  // [s]
    io::RecordingRules rules;
    rules.rate = number_between(1 / hour, 1 / millisecond, values, "rate");
    if (values.count("for") > 0) rules.duration = number_between(millisecond, year, values, "for");
    rules.timeout = number_between(millisecond, hour, values, "timeout");
    rules.patience = number_between(millisecond, year, values, "patience");
    rules.stopped = stop_asked;
    return rules;
}

ExitCode run_record(const po::variables_map& values) {
    const std::string output = required(values, "output");
    (void)output_format(output, log_formats());
    const bool json = read_json_with_output(values);
    const io::ModbusAddress address = io::parse_modbus_address(required(values, "modbus"));
    io::RecordingRules rules = read_rules(values);
    const std::vector<io::RegisterChannel> channels = io::read_register_map(required(values, "map"));
    catch_stop_signals();
    ProgressBar bar(read_common(values));
    rules.progress = bar.callback();
    const io::Recording recording = io::record_modbus(address, channels, rules, output);
    bar.clear();
    if (json)
        write_to_stdout(io::recording_json(recording, channels, rules, output));
    else
        write_answer(io::recording_text(recording, channels, rules, output), values);
    if (recording.end != io::RecordingEnd::disconnected) return ExitCode::done;
    throw SystemError(fmt::format("{} did not answer for {:g} s: {}; {} has the {} records until then", address.text,
                                  rules.patience, recording.reason, output, recording.records));
}

}  // namespace

Subcommand record_subcommand() {
    return {
        .name = "record",
        .arguments = "-o run.biip",
        .summary = "records registers of a Modbus device during a run",
        .description =
            "Reads load, power, temperature, override and other slow signals over Modbus TCP or RTU. It reads\n"
            "registers (functions 3 and 4) and never writes one. The map says which register is which channel.\n"
            "A record without an answer in time becomes a gap, and the summary counts the gaps. Ctrl-C, SIGTERM\n"
            "and --for end the recording. Until then it is in FILE.part, which can be read, too: if the program is\n"
            "killed, only the last second is lost. If no answer comes for the time of --patience, the recording\n"
            "ends with exit code 4, and the log is kept. `clsurf convert --join` adds the channels to the log of\n"
            "the run. Modbus is too slow for positions; they come from the log of the control.\n\n"
            "  clsurf record --modbus tcp:192.168.0.10:502 --map registers.toml -o slow.biip\n"
            "  clsurf record --modbus rtu:/dev/ttyUSB0,19200,8N1 --map registers.toml --rate 5 --for 600 -o slow.biip\n"
            "  clsurf convert run.csv --join slow.biip --join-offset 12.5 -o joined.biip",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the BIIP log")
                    ("modbus", po::value<std::string>()->value_name("ADDRESS"), "tcp:HOST:PORT (without a port: 502), or rtu:DEVICE,BAUD with 8 bits, even parity and one stop bit; others follow as in rtu:DEVICE,BAUD,8N1")
                    ("map", po::value<std::string>()->value_name("FILE"), "which registers are which channels (TOML, docs/howto/record_modbus.md)")
                    ("rate", po::value<double>()->value_name("HZ")->default_value(10, "10"), "records per second")
                    ("for", po::value<double>()->value_name("S"), "seconds to record (default: until Ctrl-C)")
                    ("timeout", po::value<double>()->value_name("S")->default_value(0.5, "0.5"), "seconds to wait for an answer, and for a connection")
                    ("patience", po::value<double>()->value_name("S")->default_value(30, "30"), "seconds without any answer that end the recording; until then the connection is tried again for each record");
                // clang-format on
                declare_json(options);
            },
        .positional = {},
        .run = run_record,
    };
}

}  // namespace clsurf::cli
