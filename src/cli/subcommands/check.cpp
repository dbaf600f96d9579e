// clsurf check: differences between adjacent passes, and the marks that they cause.

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "cli/options/report_output.h"
#include "cli/options/survey_options.h"
#include "cli/runs/check_shards.h"
#include "cli/runs/checked_log.h"
#include "cli/terminal.h"
#include "io/readers/baseline_file.h"

namespace clsurf::cli {
namespace {

constexpr const char* check_formats = "text|json|csv|sarif|junit";

ExitCode run_check(const po::variables_map& values) {
    PartOptions options = read_part_options(values);
    CheckRules rules;
    const std::vector<std::string> logs = values["LOG"].as<std::vector<std::string>>();
    if (const std::optional<ShardNumber> shard = read_shard_number(values)) {
        if (logs.size() > 1) throw UsageError("--shard takes one log");
        return check_shard(options, *shard, values);
    }
    rules.merged = read_merged(options, values, logs.size());
    rules.measured = take_measured_role(options);
    rules.budget = read_limits(values);
    if (logs.size() > 1 && options.program == "-")
        throw UsageError("the program of several logs cannot come from standard input");
    if (values.count("baseline") > 0) rules.baseline = io::read_baseline(values["baseline"].as<std::string>());
    rules.recorder = read_recorder(values, options.program, logs);
    ReportOutput output(values, check_formats);
    rules.format = output.format();
    rules.measured_part = read_measured_input(values, rules.format, logs.size());
    rules.followed = read_followed(values, rules.format, logs.size());
    std::vector<std::string> texts;
    ExitCode worst = ExitCode::done;
    Checked checked;
    for (const std::string& log : logs) {
        options.log = log;
        if (rules.followed) rules.followed->follow(options, rules.measured);
        checked = logs.size() > 1 ? check_log_of_several(options, rules, values) : check_log(options, rules, values);
        texts.push_back(checked.text);
        worst = std::max(worst, checked.code);
    }
    const std::string report = joined_reports(logs, texts, output.format());
    if (rules.followed) rules.followed->write_end(checked.resolved, report, worst);
    if (rules.followed && rules.followed->json()) return worst;
    const bool to_terminal = output.format() == "text" && values.count("output") == 0;
    output.write(to_terminal ? fit_terminal(report) : report);
    return worst;
}

}  // namespace

Subcommand check_subcommand() {
    return {
        .name = "check",
        .arguments = "PROGRAM LOG…",
        .summary = "finds differences between adjacent passes and predicts the marks: lines, causes, depths",
        .description =
            "Compares every pass with its neighbours: speed, acceleration, and the deviation of the axes from\n"
            "the commanded path. The output begins with a verdict and lists the differences that are large\n"
            "enough to leave a mark, most conspicuous first, with the responsible lines and the predicted\n"
            "depth.\n"
            "Severity: 1 trace (in the data, hardly on the part), 2 visible (on a polished or glossy\n"
            "surface), 3 distinct (on any finished surface), 4 reject (too deep to polish out). A speed below\n"
            "that of the neighbours is negative. Depths have no sign; their shape, pit or bulge, gives the direction.\n"
            "With --machine every record of the commanded motion is compared with the limits that the machine\n"
            "file states, and with the path tolerance of the program: axis, factor, line, time (docs/limits.md).\n"
            "The exit code is 1 if a limit of --budget, --fail-on or --max-depth is exceeded, and 5 if the\n"
            "data do not allow a verdict: less than half of the cutting points could be compared.\n"
            "With --baseline it is 1 if a defect is new or of a higher severity than in the earlier report.\n"
            "--record adds the run to a history, whatever the verdict.\n"
            "A log that is too large for memory is judged in shards, one by one or on several machines, and --merge gives the\n"
            "report on the whole of it (`clsurf survey`, docs/howto/shards.md).\n"
            "--measured compares a profile or an areal map that was measured on the part with the predicted surface. It\n"
            "aligns both (`clsurf align`), subtracts the same form, applies the same filters, and gives Ra, Rq and Rz of both, the\n"
            "correlation of the roughness profiles, and the predicted marks that were found. The exit code is 5 if the data do not\n"
            "determine the pose.\n"
            "--follow reads a log that is still being written: a file, a named pipe or standard input (-). Its findings are\n"
            "provisional, because thresholds depend on the whole run. When the log ends, the verdict and the exit code are\n"
            "those of a check of the complete log, which confirms or withdraws each finding.\n\n"
            "  clsurf check part.nc run.biip --tool ball:6\n"
            "  clsurf check part.nc run.biip --tool ball:6 --measured stylus.csv --measured-at 12.5,3,90 --picture profile.png\n"
            "  clsurf check part.nc run.biip --follow\n"
            "  clsurf check part.nc run.biip --machine mill.toml --budget limits.toml\n"
            "  clsurf check part.nc monday.biip friday.biip --fail-on distinct --max-depth 5um -q\n"
            "  clsurf check part.nc run.biip --tool ball:6 --budget part.toml --format sarif -o part.sarif",
        .declare =
            [](po::options_description& options) {
                declare_judging(options);
                declare_report_output(options, check_formats);
                options.add_options()(
                    "baseline", po::value<std::string>()->value_name("FILE"),
                    "report of an earlier run (.json or .sarif); exit code 1 if a defect is new or worse");
                options.add_options()("record", po::value<std::string>()->value_name("DB"),
                                      "add the run to that history (`clsurf history`)");
                declare_recording(options);
                declare_measured_check(options);
                declare_follow(
                    options,
                    "the log is still being written: report each defect as soon as the adjacent passes are recorded, and the verdict when the log ends; with --json one object per line (docs/howto/follow.md)");
                declare_shards(options);
            },
        .positional = {"PROGRAM", "LOG…"},
        .run = run_check,
    };
}

}  // namespace clsurf::cli
