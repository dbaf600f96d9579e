// clsurf intervals: the sections of a program that can be cut at constant speed, and their speeds.

#include <cmath>

#include "cli/options/options.h"
#include "cli/options/report_output.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "io/reports/intervals_report.h"

namespace clsurf::cli {
namespace {

constexpr const char* interval_formats = "text|json|csv";

double read_above(const po::variables_map& values, const char* name, double least, double otherwise) {
    if (values.count(name) == 0) return otherwise;
    const double value = values[name].as<double>();
    if (!(value > least) || !std::isfinite(value))
        throw UsageError(std::string("--") + name + " must be above " + (least > 0 ? "1" : "0"));
    return value;
}

ExitCode run_intervals(const po::variables_map& values) {
    IntervalRules rules;
    rules.error = read_above(values, "error", 0, rules.error);
    rules.length_ratio = read_above(values, "length-ratio", 1, rules.length_ratio);
    rules.curvature_ratio = read_above(values, "curvature-ratio", 1, rules.curvature_ratio);
    rules.drift_ratio = 2 * rules.curvature_ratio;
    rules.greatest_length = read_above(values, "max-length", 0, rules.greatest_length);
    const Machine machine =
        values.count("machine") > 0 ? io::read_machine(values["machine"].as<std::string>()) : Machine{};
    ReportOutput output(values, interval_formats);
    const Program program = io::read_program(required(values, "PROGRAM"), read_program_options(values));
    const ProgrammedSurface programmed = build_programmed_surface(program);
    const ProgramIntervals intervals = plan_intervals(program, programmed, rules, machine);
    if (output.format() == "json") {
        output.write(io::intervals_json(intervals, program.diagnostics));
    } else {
        print(program.diagnostics, values);
        output.write(output.format() == "csv" ? io::intervals_csv(intervals) : io::intervals_text(intervals));
    }
    return ExitCode::done;
}

}  // namespace

Subcommand intervals_subcommand() {
    return {
        .name = "intervals",
        .arguments = "PROGRAM",
        .summary = "plans constant-speed intervals of the passes, and a speed for each",
        .description =
            "Divides each pass where the spacing of its points or its curvature changes, after Wu et al.\n"
            "(Machines 10 (2022) 558). Adjacent passes get their boundaries at the same places. The speed of\n"
            "each interval follows from its curvature, the machine and the adjacent intervals of the adjacent\n"
            "passes. `own` is the speed that feed, curvature and machine allow; `planned` is the speed that\n"
            "the neighbours can keep, too.\n\n"
            "  clsurf intervals part.nc --machine mill.toml\n"
            "  clsurf render part.nc run.biip --color interval -o intervals.png",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("error", po::value<double>()->value_name("MM"), "largest distance of characteristic points from the pass (default: 0.01)")
                    ("length-ratio", po::value<double>()->value_name("RATIO"), "ratio of the lengths of consecutive lines that bounds an interval (default: 5)")
                    ("curvature-ratio", po::value<double>()->value_name("RATIO"), "ratio of the curvatures before and after a point that bounds an interval; an interval with twice this ratio is divided, too (default: 2)")
                    ("max-length", po::value<double>()->value_name("MM"), "longest interval; longer ones are divided into equal parts (default: no limit)")
                    ("machine", po::value<std::string>()->value_name("FILE"), "machine file (default: that of clsurf machine --defaults)");
                // clang-format on
                declare_report_output(options, interval_formats);
                declare_program_options(options);
            },
        .positional = {"PROGRAM"},
        .run = run_intervals,
    };
}

}  // namespace clsurf::cli
