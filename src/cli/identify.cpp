// clsurf identify: a machine file from recorded runs.

#include <vector>

#include <fmt/format.h>

#include "cli/options.h"
#include "cli/part.h"
#include "cli/stage_clock.h"
#include "identify/identify.h"
#include "io/files/atomic_file.h"
#include "io/readers/machine_file.h"
#include "io/reports/identify_report.h"

namespace clsurf::cli {
namespace {

struct RunFiles {
    std::string program, log;
};

/// PROGRAM LOG, and the pairs that follow.
std::vector<RunFiles> read_runs(const po::variables_map& values) {
    const std::string program = required(values, "PROGRAM");
    (void)first_value(values, "LOG");
    const auto& rest = values["LOG"].as<std::vector<std::string>>();
    if (rest.size() % 2 == 0)
        throw UsageError(fmt::format("'{}' has no log", rest.back()),
                         "every program is followed by its log: clsurf identify a.nc a.biip b.nc b.biip -o mill.toml");
    std::vector<RunFiles> runs{{program, rest[0]}};
    for (std::size_t k = 1; k < rest.size(); k += 2) runs.push_back({rest[k], rest[k + 1]});
    return runs;
}

ExitCode run_identify(const po::variables_map& values) {
    const std::vector<RunFiles> files = read_runs(values);
    const std::string output = required(values, "output");
    const bool json = read_json_beside_output(values);
    PartOptions options = read_part_options(values);
    const Machine known = options.machine.empty() ? Machine{} : io::read_machine(options.machine);
    io::AtomicFile file(output);
    StageClock clock(read_common(values), 4 * static_cast<int>(files.size()) + 1);
    std::vector<Part> parts;
    Diagnostics diagnostics;
    for (const RunFiles& run : files) {
        options.program = run.program;
        options.log = run.log;
        parts.push_back(load_part(options, clock));
        diagnostics.append(parts.back().diagnostics);
    }
    std::vector<IdentifyRun> runs;
    for (const Part& part : parts) runs.push_back({&part.log, part.lines.get()});
    clock.begin("identify");
    const Identification result = identify(runs, known);
    clock.end();
    file.write(io::identified_machine_text(result));
    file.commit();
    diagnostics.append(result.diagnostics);
    if (json) {
        write_to_stdout(io::identification_json(result, diagnostics));
    } else {
        print(diagnostics, values);
        write_answer(io::identification_text(result), values);
    }
    return ExitCode::done;
}

}  // namespace

Subcommand identify_subcommand() {
    return {
        .name = "identify",
        .arguments = "PROGRAM LOG [PROGRAM LOG]… -o machine.toml",
        .summary = "a machine file from recorded runs: servo loops and limits, with the evidence",
        .description =
            "Fits the servo loop of each axis to the commanded and the fed-back positions of one or more runs: position gain, velocity\n"
            "feed-forward, time constant of the velocity loop, dead time, friction, backlash and resolution. The loop is that of simulate.\n"
            "Each value has a standard error. Friction, backlash and dead time are in the file only if an information criterion (BIC) falls\n"
            "with them. The limits of speed, acceleration and jerk come from the commanded positions: a limit is reached where the motion\n"
            "stays at it in several places; otherwise the value is a lower bound, and the file keeps a greater one. What the runs do not determine is listed with the reason, and keeps its default or the value of --machine.\n"
            "Exit code 3 says that nothing could be identified.\n\n"
            "  clsurf identify part.nc run.biip -o mill.toml\n"
            "  clsurf identify a.nc a.biip b.nc b.biip --machine five_axis.toml -o mill.toml --json",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the machine file");
                // clang-format on
                declare_part(options);
                declare_json(options);
            },
        .positional = {"PROGRAM", "LOG…"},
        .run = run_identify,
    };
}

}  // namespace clsurf::cli
