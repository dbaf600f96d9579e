// clsurf convert: converts any readable log into BIIP.

#include "cli/options.h"
#include "cli/output_format.h"
#include "io/files/compressed.h"
#include "io/formats/biip.h"
#include "io/formats/program_identity.h"

namespace clsurf::cli {
namespace {

ExitCode run_convert(const po::variables_map& values) {
    const std::string output = required(values, "output");
    (void)output_format(output, log_formats());
    Log log = io::open_log(required(values, "LOG"), read_log_options(values));
    print(log.diagnostics, values);
    std::string metadata = log.metadata;
    if (values.count("program") > 0) {
        std::vector<ProgramReference> programs;
        for (const std::string& path : values["program"].as<std::vector<std::string>>())
            programs.push_back(io::identify(io::open_source(path)));
        metadata = io::with_programs(metadata, programs);
    }
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
            "or is another one.\n\n"
            "  clsurf convert run.raw --layout run.layout.toml -o run.biip\n"
            "  clsurf convert run.csv --program part.nc -o run.biip",
        .declare =
            [](po::options_description& options) {
                // clang-format off
            options.add_options()
                ("output,o", po::value<std::string>()->value_name("FILE"), "the BIIP log")
                ("program", po::value<std::vector<std::string>>()->value_name("FILE"), "the program that ran (again: its subprograms); name, size and SHA-256 go into the log");
                // clang-format on
                declare_log_options(options);
            },
        .positional = {"LOG"},
        .run = run_convert,
    };
}

}  // namespace clsurf::cli
