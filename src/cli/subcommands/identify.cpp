// clsurf identify: a machine file from recorded runs.

#include <optional>
#include <vector>

#include <fmt/format.h>

#include "cli/options/options.h"
#include "cli/options/part.h"
#include "cli/pictures/identify_picture.h"
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

/// PROGRAM LOG, and any further pairs.
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

/// The pairs of --test PROGRAM LOG.
std::vector<RunFiles> read_tests(const po::variables_map& values) {
    std::vector<RunFiles> runs;
    if (values.count("test") == 0) return runs;
    const auto& words = values["test"].as<std::vector<std::string>>();
    if (words.size() % 2 != 0)
        throw UsageError(fmt::format("--test '{}' has no log", words.back()),
                         "--test is followed by a program and its log: --test c.nc c.biip");
    for (std::size_t k = 0; k < words.size(); k += 2) runs.push_back({words[k], words[k + 1]});
    return runs;
}

std::vector<Part> load_parts(const std::vector<RunFiles>& files, PartOptions options, StageClock& clock,
                             Diagnostics& diagnostics) {
    std::vector<Part> parts;
    options.accept_unknown_tips = true;  // the servo loops can be identified without tip positions
    for (const RunFiles& run : files) {
        options.program = run.program;
        options.log = run.log;
        parts.push_back(load_part(options, clock));
        diagnostics.append(parts.back().diagnostics);
    }
    return parts;
}

ExitCode run_identify(const po::variables_map& values) {
    const std::vector<RunFiles> files = read_runs(values);
    const std::string output = required(values, "output");
    const bool json = read_json_with_output(values);
    const std::vector<RunFiles> test_files = read_tests(values);
    const PartOptions options = read_part_options(values);
    const Machine known = options.machine.empty() ? Machine{} : io::read_machine(options.machine);
    io::AtomicFile file(output);
    std::optional<PictureOutput> picture;
    if (values.count("picture") > 0)
        picture.emplace(values["picture"].as<std::string>(), "--picture", PictureKind::drawing);
    StageClock clock(read_common(values), 4 * static_cast<int>(files.size() + test_files.size()) + 3);
    Diagnostics diagnostics;
    std::vector<Part> parts = load_parts(files, options, clock, diagnostics);
    const std::vector<Part> tests = load_parts(test_files, options, clock, diagnostics);
    clock.begin("identify");
    Identification result = identify_parts(parts, known);
    clock.begin("cross-validate");
    cross_validate(parts, known, result);
    clock.begin("test");
    test_runs(tests, result);
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
    // The machine file is the requested result: it is kept even if the picture cannot be drawn.
    if (picture) draw_speed_residual(result, parts, tests, *picture);
    return ExitCode::done;
}

}  // namespace

Subcommand identify_subcommand() {
    return {
        .name = "identify",
        .arguments = "PROGRAM LOG [PROGRAM LOG]… -o machine.toml",
        .summary = "fits a machine file to recorded runs: servo loops, limits and planner rules, with the evidence",
        .description =
            "Fits the servo loop of each axis to the commanded and the fed-back positions of one or more runs: position gain, velocity\n"
            "feed-forward, time constant and integral time of the velocity loop, dead time, friction, backlash and resolution. The loop is that of simulate.\n"
            "Each value has a standard error. Integral time, friction, backlash and dead time are in the file only if an information criterion\n"
            "(BIC) falls with them. The limits of speed, acceleration and jerk come from the commanded positions: a limit is reached where the motion\n"
            "stays at it in several places. Accelerations and jerks that the motion hides come from simulations: the value that explains the\n"
            "speeds best is taken if a lower and a higher one explain them less well. Any other limit is a lower bound; the file then keeps the\n"
            "limit of --machine, or the default, if that is greater. Values that the runs do not determine are listed with the reason.\n"
            "The rules of the planner are selected by simulation: each value is scored by the speed along the path. The fidelity of the result\n"
            "is measured on the runs of --test, else by leaving out one run after the other, else on the fitted run, and is kept in the file.\n"
            "Exit code 3 means that nothing could be identified, or that only the picture could not be drawn: then the machine file is\n"
            "written.\n\n"
            "  clsurf identify part.nc run.biip -o mill.toml\n"
            "  clsurf identify a.nc a.biip b.nc b.biip --machine five_axis.toml -o mill.toml --test c.nc c.biip --picture residual.png",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the machine file")
                    ("picture", po::value<std::string>()->value_name("FILE"), "map of simulated minus recorded speed, for the run in which they differ most, of those of --test, else of the fitted ones (.png, .jpg, .tif, .webp, .svg or .pdf)")
                    ("test", po::value<std::vector<std::string>>()->multitoken()->value_name("PROGRAM LOG"), "a run that is not used for the fit but compared with its simulation; repeatable");
                // clang-format on
                declare_part(options, MachineUse::known);
                declare_json(options);
            },
        .positional = {"PROGRAM", "LOG…"},
        .run = run_identify,
    };
}

}  // namespace clsurf::cli
