// clsurf convert: converts any readable log into BIIP.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/options.h"
#include "cli/options/output_format.h"
#include "io/files/compressed.h"
#include "io/formats/biip.h"
#include "io/formats/joined_log.h"
#include "io/formats/program_identity.h"
#include "io/formats/run_parameters.h"
#include "io/history/parameter_file.h"

namespace clsurf::cli {
namespace {

/// Adds the channels of --join.
void join(Log& log, const po::variables_map& values) {
    if (values.count("join") == 0) {
        for (const char* name : {"join-offset", "join-age"}) {
            if (given(values, name)) throw UsageError("--" + std::string(name) + " needs --join");
        }
        return;
    }
    io::JoinRules rules;
    if (values.count("join-offset") > 0) rules.offset = values["join-offset"].as<double>();
    if (values.count("join-age") > 0) rules.age = values["join-age"].as<double>();
    if (rules.age && !(*rules.age > 0)) throw UsageError("--join-age must be more than 0");
    const Log slow = io::open_log(values["join"].as<std::string>(), {});
    print(slow.diagnostics, values);
    print(io::join_log(log, slow, rules), values);
}

/// The parameters of --param, with units, checked against --parameters.
std::vector<RunParameter> read_parameters(const po::variables_map& values, const std::string& metadata) {
    std::vector<RunParameter> parameters;
    if (values.count("param") > 0) {
        for (const std::string& text : values["param"].as<std::vector<std::string>>())
            parameters.push_back(parse_parameter(text));
    }
    if (values.count("parameters") == 0) {
        sort_parameters(parameters);
        return parameters;
    }
    // The log may have parameters already: they must also obey --parameters, and only missing ones are required.
    for (RunParameter& known : io::parameters_of_metadata(metadata)) {
        if (std::ranges::find(parameters, known.name, &RunParameter::name) == parameters.end())
            parameters.push_back(std::move(known));
    }
    const ParameterRules rules = io::read_parameter_rules(values["parameters"].as<std::string>());
    return rules.with_units(rules.checked(std::move(parameters)));
}

ExitCode run_convert(const po::variables_map& values) {
    const std::string output = required(values, "output");
    (void)output_format(output, log_formats());
    Log log = io::open_log(required(values, "LOG"), read_log_options(values));
    print(log.diagnostics, values);
    join(log, values);
    std::string metadata = log.metadata;
    if (values.count("program") > 0) {
        std::vector<ProgramReference> programs;
        for (const std::string& path : values["program"].as<std::vector<std::string>>())
            programs.push_back(io::identify(io::open_source(path)));
        metadata = io::with_programs(metadata, programs);
    }
    if (const std::vector<RunParameter> parameters = read_parameters(values, metadata); !parameters.empty())
        metadata = io::with_parameters(metadata, parameters);
    print(io::fit_biip(log), values);
    io::write_biip(output, log.channels, log.records, log.period, metadata);
    return ExitCode::done;
}

}  // namespace

Subcommand convert_subcommand() {
    return {
        .name = "convert",
        .arguments = "LOG -o out.biip",
        .summary = "converts any readable log into BIIP",
        .description =
            "Keeps the stored types and scales of binary logs; text becomes 64-bit floating point. With\n"
            "--program the log records its program, and other subcommands then warn if the program was edited\n"
            "or is another one.\n"
            "With --join the channels of a slow log, such as that of `clsurf record`, become channels of this log.\n"
            "Each value is held until the next one, for at most --join-age.\n"
            "Parameters of the run go into the metadata; `clsurf info` shows them, and a history keeps them.\n\n"
            "  clsurf convert run.raw --layout run.layout.toml -o run.biip\n"
            "  clsurf convert run.csv --program part.nc -o run.biip\n"
            "  clsurf convert run.csv --parameters shop.toml --param tool=D6R3 --param wear=0.05mm -o run.biip\n"
            "  clsurf convert run.csv --join slow.biip --join-offset 12.5 -o joined.biip",
        .declare =
            [](po::options_description& options) {
                // clang-format off
            options.add_options()
                ("output,o", po::value<std::string>()->value_name("FILE"), "the BIIP log")
                ("program", po::value<std::vector<std::string>>()->value_name("FILE"), "the program that ran; repeat the option for its subprograms; name, size and SHA-256 go into the log")
                ("param", po::value<std::vector<std::string>>()->value_name("NAME=VALUE"), "a parameter of the run, such as coolant=MQL, kept in the log's metadata; may be repeated")
                ("parameters", po::value<std::string>()->value_name("FILE"), "rules for the parameters of runs, with unit and range (TOML)")
                ("join", po::value<std::string>()->value_name("FILE"), "a log of slow channels, which are added to LOG by time")
                ("join-offset", po::value<double>()->value_name("S"), "time in the slow log at which LOG begins, in seconds (default: from the recording times that both logs state)")
                ("join-age", po::value<double>()->value_name("S"), "seconds for which a value is held; later records have none (default: three periods of the slow log)");
                // clang-format on
                declare_log_options(options);
            },
        .positional = {"LOG"},
        .run = run_convert,
    };
}

}  // namespace clsurf::cli
