// clsurf optimize: a smoother program within a tolerance, verified by simulation.

#include <fmt/format.h>

#include "cli/options/options.h"
#include "cli/options/output_format.h"
#include "cli/pictures/optimize_picture.h"
#include "cli/pictures/picture_output.h"
#include "cli/programs/front_output.h"
#include "cli/programs/optimize_options.h"
#include "cli/programs/repair_inputs.h"
#include "cli/progress_bar.h"
#include "core/file_name.h"
#include "io/files/atomic_file.h"
#include "io/reports/optimize_report.h"
#include "io/reports/tradeoff_report.h"

namespace clsurf::cli {
namespace {

ExitCode run_optimize(const po::variables_map& values) {
    const std::string output_path = required(values, "output");
    require_program_ending(output_path);
    const bool json = read_json_with_output(values);
    Diagnostics diagnostics;
    RepairInputs in = read_repair_inputs(values, diagnostics);
    io::AtomicFile output(output_path);
    std::optional<PictureOutput> picture;
    if (values.count("picture") > 0)
        picture.emplace(values["picture"].as<std::string>(), "--picture", PictureKind::drawing);
    FrontOutput front_output(values);
    ProgressBar bar(read_common(values));
    Optimized result = run_repair(values, in, bar.callback(), diagnostics);
    result.machine = in.machine_origin;
    bar.clear();
    if (json) {
        write_to_stdout(io::optimize_json(result, diagnostics));
    } else {
        print(diagnostics, values);
        const std::string front =
            trades_off(values) ? io::tradeoff_text(result.front, {"candidates", "candidate", true}) : std::string();
        write_answer(io::optimize_text(result) + front, values);
    }
    const std::string name = in.program.main().name();
    if (picture) {
        picture->write(draw_before_and_after(result, name, picture->wants_drawing()),
                       fmt::format("clsurf optimize of {}: speeds before and after", name));
    }
    if (trades_off(values))
        front_output.write(result.front, {}, fmt::format("Time against surface: repairs of {}", file_name(name)),
                           diagnostics);
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
        .summary = "writes a smoother program within a tolerance, verified by simulation",
        .description =
            "Simulates the program, aligns the points of its finishing passes with those of adjacent passes\n"
            "on the smoothest curve within the tolerance, and simulates it again. The new program is written\n"
            "only if it is better: speeds of adjacent passes differ less, there are no more defects, it does\n"
            "not take longer (or at most by --more-time), and it stays within the tolerance. Otherwise the\n"
            "exit code is 1, with the reason. Lines that contain anything but line number, G1, X, Y, Z, A, B,\n"
            "C are kept byte for byte. With --tool, the machined surface must not get rougher either.\n"
            "It must also be better on other machines within the uncertainty of the machine file (--machines). With --log and\n"
            "without --machine, the machine is fitted to the log. With --controller, your own controller runs the\n"
            "program and the best candidates, --runs times in all, and its logs decide. After a new program has\n"
            "run, --round adds it and its log: the next program is written only if it is better.\n"
            "Programs that move rotary axes need a machine file that has them. Passes are then those of the\n"
            "tool tip, and the tool axis stays within a hundredth of a degree of the programmed one.\n"
            "--tradeoff shows what the search found: the Pareto front of its acceptable candidates by time, speed\n"
            "difference between adjacent passes and jerk. --weight W chooses from it: the candidate with the\n"
            "smallest value of (1 - W) t + W (m + j) / 2, where t, m and j are time, difference and jerk (95th percentiles)\n"
            "relative to those of the program.\n\n"
            "  clsurf optimize part.nc --machine mill.toml --tolerance 0.005 -o better.nc --picture better.png\n"
            "  clsurf optimize part.nc --log run.biip -o better.nc\n"
            "  clsurf optimize part.nc --log run.biip --round better.nc better_run.biip -o better2.nc\n"
            "  clsurf optimize part.nc --controller 'run_on_kernel.sh {program} {log}' --runs 4 -o better.nc",
        .declare = declare_optimize,
        .positional = {"PROGRAM"},
        .run = run_optimize,
    };
}

}  // namespace clsurf::cli
