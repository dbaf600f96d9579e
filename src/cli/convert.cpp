// clsurf convert: any readable log into BIIP.

#include "cli/options.h"
#include "io/biip.h"

namespace clsurf::cli {
namespace {

ExitCode run(const po::variables_map& values) {
    const Log log = io::open_log(required(values, "LOG"), read_log_options(values));
    print(log.diagnostics, values);
    io::write_biip(required(values, "output"), log.channels, log.records, log.period, log.metadata);
    return ExitCode::done;
}

}  // namespace

Subcommand convert_subcommand() {
    return {
        .name = "convert",
        .arguments = "LOG -o out.biip",
        .summary = "any readable log into BIIP",
        .description = "Keeps the stored types and scales of binary logs; text becomes 64-bit floating point.\n\n"
                       "  clsurf convert run.raw --layout run.layout.toml -o run.biip",
        .declare = [](po::options_description& options) {
            options.add_options()("output,o", po::value<std::string>()->value_name("FILE"), "the BIIP log");
            declare_log_options(options);
        },
        .positional = {"LOG"},
        .run = run,
    };
}

}  // namespace clsurf::cli
