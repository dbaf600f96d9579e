// clsurf optimize: a smoother program within a tolerance, verified by simulation.

#include <memory>

#include <fmt/format.h>

#include "cli/optimize_options.h"
#include "cli/optimize_picture.h"
#include "cli/options.h"
#include "cli/output_format.h"
#include "cli/picture_output.h"
#include "cli/progress_bar.h"
#include "cli/work_frames.h"
#include "io/files/atomic_file.h"
#include "io/files/compressed.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "io/reports/optimize_report.h"
#include "pipeline/placement.h"
#include "repair/optimizer.h"

namespace clsurf::cli {
namespace {

/// A program's new text, read as the old one was: the same name, dialect, options and subprograms.
Program read_text(const io::Source& source, const std::string& text, const io::ProgramOptions& options,
                  std::string_view dialect, const FramePoses& poses) {
    auto bytes = std::make_shared<std::string>(text);
    io::Source changed = source;
    changed.bytes = std::as_bytes(std::span(bytes->data(), bytes->size()));
    changed.keep_alive = bytes;
    io::ProgramOptions same = options;
    same.dialect = dialect;
    same.coordinates.reset();
    Program program = io::read_program(changed, same);
    (void)place_motions(program, poses, Coordinates::level);
    return program;
}

ExitCode run_optimize(const po::variables_map& values) {
    const std::string output_path = required(values, "output");
    require_program_ending(output_path);
    const bool json = read_json_beside_output(values);
    OptimizeRules rules = read_optimize_rules(values);
    const Machine machine =
        values.count("machine") > 0 ? io::read_machine(values["machine"].as<std::string>()) : Machine{};
    const io::ProgramOptions options = read_program_options(values);
    const io::Source source = io::open_source(required(values, "PROGRAM"));
    io::ProgramOptions as_programmed = options;
    as_programmed.coordinates.reset();
    Program program = io::read_program(source, as_programmed);
    const bool five_axes = runs_on_five_axes(program, machine);
    std::optional<Log> measured = read_measured(values, five_axes);
    FramePoses poses = read_work_offset(values);
    if (measured) poses.zero = zero_of(poses, *measured, measured->diagnostics);
    poses.tool_by_kinematics = five_axes;
    // Its axes along those of the machine, whose limits count.
    const Eigen::Isometry3d zero = place_motions(program, poses, Coordinates::level);
    if (measured) measured->work_offset = zero.translation();
    if (measured) measured->work_rotation = 0;
    if (five_axes) rules.zero = zero.translation();
    io::AtomicFile output(output_path);
    std::optional<PictureOutput> picture;
    if (values.count("picture") > 0) picture.emplace(values["picture"].as<std::string>(), "--picture");
    ProgressBar bar(read_common(values));
    Diagnostics diagnostics = program.diagnostics;
    const Optimized result = optimize(
        program,
        [&](const std::string& text) { return read_text(source, text, options, program.dialect->name, poses); },
        machine, rules, std::move(measured), bar.callback(), diagnostics);
    bar.clear();
    if (json) {
        write_to_stdout(io::optimize_json(result, diagnostics));
    } else {
        print(diagnostics, values);
        write_answer(io::optimize_text(result), values);
    }
    if (picture) {
        picture->write(draw_before_and_after(result, program.main().name()),
                       fmt::format("clsurf optimize of {}: speeds before and after", program.main().name()));
    }
    if (!result.evaluation.accepted) return ExitCode::check_failed;
    output.write(result.text);
    output.commit();
    return ExitCode::done;
}

}  // namespace

Subcommand optimize_subcommand() {
    return {
        .name = "optimize",
        .arguments = "PROGRAM -o better.nc",
        .summary = "a smoother program within a tolerance, verified by simulation",
        .description =
            "Simulates the program, aligns the points of its finishing passes with those of adjacent passes\n"
            "on the smoothest curve within the tolerance, and simulates it again. The new program is written\n"
            "only if it is better: speeds of adjacent passes differ less, there are no more defects, it does\n"
            "not take longer (or at most by --more-time), and it stays within the tolerance. Otherwise the\n"
            "exit code is 1, with the reason. Lines that contain anything but line number, G1, X, Y, Z, A, B,\n"
            "C are kept byte for byte.\n"
            "Programs that move rotary axes need a machine file that has them. Passes are then those of the\n"
            "tool tip, and the tool axis stays within a hundredth of a degree of the programmed one.\n\n"
            "  clsurf optimize part.nc --machine mill.toml --tolerance 0.005 -o better.nc --picture better.png",
        .declare = declare_optimize,
        .positional = {"PROGRAM"},
        .run = run_optimize,
    };
}

}  // namespace clsurf::cli
