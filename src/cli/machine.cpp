// clsurf machine: machine files: one with every key, and whether one can be used.

#include <fmt/format.h>

#include "cli/options.h"
#include "io/machine_file.h"

namespace clsurf::cli {
namespace {

ExitCode run_machine(const po::variables_map& values) {
    const bool defaults = values.count("defaults") > 0;
    if (defaults == (values.count("check") > 0)) throw UsageError("one of --defaults and --check is needed");
    if (defaults) {
        write_to_stdout(io::machine_text(Machine{}));
        return ExitCode::done;
    }
    const std::string path = values["check"].as<std::string>();
    const Machine machine = io::read_machine(path);
    write_to_stdout(fmt::format("{}: {}: can be used\n", path, machine.name));
    return ExitCode::done;
}

}  // namespace

Subcommand machine_subcommand() {
    return {
        .name = "machine",
        .arguments = "--defaults | --check FILE",
        .summary = "machine files: one with every key, and whether one can be used",
        .description =
            "A machine file holds the limits, the controller's settings and the servo loops of a machine,\n"
            "for simulate.\n\n"
            "  clsurf machine --defaults > mill.toml\n"
            "  clsurf machine --check mill.toml",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("defaults", "print a machine file with every key at its default")
                    ("check", po::value<std::string>()->value_name("FILE"), "judge a machine file; exit code 3 and the line where it cannot be used");
                // clang-format on
            },
        .positional = {},
        .run = run_machine,
    };
}

}  // namespace clsurf::cli
