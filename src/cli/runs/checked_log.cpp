#include "cli/runs/checked_log.h"

#include "cli/pictures/defect_colours.h"
#include "cli/runs/quality_writer.h"
#include "cli/terminal.h"
#include "history/record_of.h"
#include "io/reports/quality_report.h"

namespace clsurf::cli {

Checked check_log(const PartOptions& options, CheckRules& rules, const po::variables_map& values) {
    StageClock clock(read_common(values), 8);
    const bool with_motion = rules.format == "json";
    CheckedRun run = check_run(options, rules.measured, rules.budget, clock, with_motion, rules.merged);
    if (rules.recorder) {
        const io::AddedRun added = rules.recorder->add(options, run);
        if (!read_common(values).quiet) write_message("recorded as " + rules.recorder->text_of(added) + "\n");
    }
    std::optional<RecordedMatch> match;
    if (rules.baseline) match = match_recorded(*rules.baseline, recorded_defects(run.quality.report));
    std::optional<io::ReportedMeasurement> measured;
    if (rules.measured_part) measured = compare_measured(run, rules.measured, *rules.measured_part, clock);
    const bool aligned = !measured || measured->result.alignment.determined();
    const bool worse = match && match->worsened() > 0 && run.code == ExitCode::done;
    io::ReportedQuality reported = reported_of(run);
    if (rules.format == "json") reported.colour_differences = colour_differences(run.quality.report, run.part);
    reported.baseline = match ? &*match : nullptr;
    reported.measured = measured ? &*measured : nullptr;
    reported.passes_asked = !rules.budget.only_limits();
    if (values.count("output") == 0) reported.columns = table_columns();
    if (rules.format != "json") print(run.part.diagnostics, values);
    const ExitCode code = worse ? ExitCode::check_failed : run.code;
    return {result_writer(rules.format).quality(reported),
            code == ExitCode::done && !aligned ? ExitCode::not_judged : code,
            rules.followed ? rules.followed->resolve(run.quality.report) : ResolvedFindings{}};
}

Checked check_log_of_several(const PartOptions& options, CheckRules& rules, const po::variables_map& values) {
    try {
        return check_log(options, rules, values);
    } catch (const InputError& error) {
        if (error.diagnostic().where.file != options.log) throw;
        write_message(error.what());
        return {result_writer(rules.format).unusable({options.program, options.log, error.diagnostic()}),
                ExitCode::bad_input,
                {}};
    }
}

}  // namespace clsurf::cli
