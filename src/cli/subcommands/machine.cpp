// clsurf machine: prints a machine file with every key, or validates one.

#include <fmt/format.h>

#include "cli/options/options.h"
#include "io/readers/machine_file.h"

namespace clsurf::cli {
namespace {

ExitCode run_machine(const po::variables_map& values) {
    const bool defaults = values.count("defaults") > 0;
    const char* const checked = values.count("FILE") > 0 ? "FILE" : "check";
    if (defaults + values.count("FILE") + values.count("check") != 1)
        throw UsageError("one of --defaults and FILE is needed", "clsurf machine mill.toml validates a machine file");
    if (defaults) {
        write_to_stdout(io::machine_text(Machine{}));
        return ExitCode::done;
    }
    const std::string path = values[checked].as<std::string>();
    const Machine machine = io::read_machine(path);
    write_to_stdout(fmt::format("{}: {}: can be used\n", path, machine.name));
    return ExitCode::done;
}

}  // namespace

Subcommand machine_subcommand() {
    return {
        .name = "machine",
        .arguments = "--defaults | FILE",
        .summary = "prints a machine file with every key, or validates one",
        .description =
            "A machine file holds the limits, the controller's settings and the servo loops of a machine, for\n"
            "simulate. FILE is validated: exit code 3 and the line if it cannot be used.\n\n"
            "  clsurf machine --defaults > mill.toml\n"
            "  clsurf machine mill.toml",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("defaults", "print a machine file with every key at its default")
                    ("check", po::value<std::string>()->value_name("FILE"), "the same as FILE alone");
                // clang-format on
            },
        .positional = {"FILE"},
        .run = run_machine,
    };
}

}  // namespace clsurf::cli
