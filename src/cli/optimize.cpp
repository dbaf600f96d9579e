// clsurf optimize: a smoother program inside a tolerance, with proof.

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "cli/options.h"
#include "cli/output_format.h"
#include "cli/picture_output.h"
#include "cli/progress_bar.h"
#include "cli/work_frames.h"
#include "core/file_name.h"
#include "core/units.h"
#include "core/version.h"
#include "field/field_set.h"
#include "field/range.h"
#include "io/files/atomic_file.h"
#include "io/files/compressed.h"
#include "io/formats/log_format.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "io/reports/optimize_report.h"
#include "pipeline/placement.h"
#include "repair/optimizer.h"
#include "viz/image.h"
#include "viz/scene.h"

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

/// The recorded run of --log. Throws UsageError where its options are given without it.
std::optional<Log> read_measured(const po::variables_map& values, bool five_axes) {
    if (values.count("log") == 0) {
        for (const char* name : {"layout", "mapping", "period"}) {
            if (given(values, name)) throw UsageError(std::string("--") + name + " is of a log: give --log");
        }
        if (given(values, "work-offset") && !five_axes)
            throw UsageError("--work-offset is of a log, or for programs on rotary axes: give --log");
        return std::nullopt;
    }
    return io::open_log(values["log"].as<std::string>(), read_log_options(values));
}

/// Both runs side by side, speeds on one scale.
viz::Image draw_before_and_after(const Optimized& result, const std::string& program) {
    const auto speed = [](const JudgedRun& run) {
        return FieldSet(run.log, run.path, run.surface.passes).get("speed");
    };
    const Field before = speed(result.before), after = speed(result.after);
    viz::MapPanel left{&result.before.surface, &before, "before", {}, {}, {}},
        right{&result.after.surface, &after, "after", {}, {}, {}};
    const std::vector<viz::MapPanel> panels{left, right};
    viz::Look look;
    look.view = viz::parse_view("top");
    look.height = 900;
    const ShownRange a = find_range(before, result.before.surface.passes, {}, {}),
                     b = find_range(after, result.after.surface.passes, {}, {});
    const viz::ColourScale scale{viz::make_colour_map("isurface"), std::min(a.low, b.low), std::max(a.high, b.high), 0};
    viz::MapTexts texts;
    texts.title = "Path speed before and after, simulated";
    const auto summary = [](const JudgedRun& run, std::size_t defects) {
        return fmt::format("{:.1f} s, {:.0f} mm/min between neighbour passes (95th percentile), {} defect{}",
                           run.duration, run.mismatch * seconds_per_minute, defects, defects == 1 ? "" : "s");
    };
    texts.subtitle = file_name(program);
    texts.notes = {"before: " + summary(result.before, result.proof.defects_before),
                   "after: " + summary(result.after, result.proof.defects_after)};
    return viz::draw_map(panels, viz::map_camera(panels, look), scale, texts, look);
}

ExitCode run_optimize(const po::variables_map& values) {
    OptimizeRules rules;
    const std::string output_path = required(values, "output");
    require_program_ending(output_path);
    const bool json = read_json_beside_output(values);
    if (values.count("tolerance") > 0) rules.tolerance = values["tolerance"].as<double>();
    if (!(rules.tolerance > 0) || !std::isfinite(rules.tolerance)) throw UsageError("--tolerance must be above 0 mm");
    if (values.count("decimals") > 0) rules.least_decimals = values["decimals"].as<int>();
    if (rules.least_decimals < 0 || rules.least_decimals > 9) throw UsageError("--decimals must be 0 to 9");
    if (values.count("more-time") > 0) rules.more_time = values["more-time"].as<double>() / 100;
    if (!(rules.more_time >= 0) || rules.more_time > 1) throw UsageError("--more-time must be 0 to 100 %");
    rules.start = read_start(values);
    rules.header = fmt::format("clsurf {} optimize, tolerance {} mm", version, rules.tolerance);
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
    if (!result.proof.accepted) return ExitCode::check_failed;
    output.write(result.text);
    output.commit();
    return ExitCode::done;
}

}  // namespace

Subcommand optimize_subcommand() {
    return {
        .name = "optimize",
        .arguments = "PROGRAM -o better.nc",
        .summary = "a smoother program inside a tolerance, with proof",
        .description =
            "Runs the program on the machine, puts the points of its finishing passes in step with those of the passes beside\n"
            "them, on the smoothest curve that is never farther from the programmed path than the tolerance, and\n"
            "runs it again. Written is only what is better: speeds of neighbour passes differ less, no more defects, not longer (or by --more-time at most), inside\n"
            "the tolerance. Otherwise exit code 1, with the reason. Lines with anything but line number, G1, X, Y, Z, A, B, C stay byte for byte.\n\n"
            "Programs that move rotary axes need a machine file that has them: passes are then those of the tool's tip, and the\n"
            "tool axis stays within a hundredth of a degree of the programmed one.\n\n"
            "  clsurf optimize part.nc --machine mill.toml --tolerance 0.005 -o better.nc --picture better.png",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the new program")
                    ("picture", po::value<std::string>()->value_name("FILE"), "speeds before and after on one scale (.png, .jpg, .tif or .webp), also where the new program is refused")
                    ("tolerance", po::value<double>()->value_name("MM"), "how far the new path may leave the programmed one (default: 0.005)")
                    ("more-time", po::value<double>()->value_name("PERCENT"), "how much longer the new program may take, for fewer defects (default: 0)")
                    ("decimals", po::value<int>()->value_name("N"), "new coordinates have at least so many, if the controller reads them (default: as many as the program's)");
                // clang-format on
                options.add_options()(
                    "log", po::value<std::string>()->value_name("LOG"),
                    "a recorded run of the program: only what differs there from the passes beside it is repaired; the proof is by simulation all the same");
                declare_log_options(options);
                declare_work_offset(options);
                declare_simulation(options);
                declare_json(options);
                declare_program_options(options);
            },
        .positional = {"PROGRAM"},
        .run = run_optimize,
    };
}

}  // namespace clsurf::cli
