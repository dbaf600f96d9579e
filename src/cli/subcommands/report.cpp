// clsurf report: the linked page.

#include <algorithm>

#include "cli/options/output_format.h"
#include "cli/options/survey_options.h"
#include "cli/report/report_classes.h"
#include "cli/report/report_content.h"
#include "cli/report/report_log.h"
#include "cli/report/report_options.h"
#include "cli/report/report_shards.h"
#include "cli/runs/check_shards.h"
#include "cli/runs/followed_output.h"
#include "compare/run_alignment.h"
#include "io/files/atomic_file.h"
#include "viz/picture_libraries.h"

namespace clsurf::cli {
namespace {

/// Keeps the fields that both logs have: only they can be compared.
void keep_common_fields(std::vector<Field>& fields, const std::vector<Field>& other) {
    std::erase_if(fields, [&](const Field& field) {
        return std::none_of(other.begin(), other.end(), [&](const Field& f) { return f.info.name == field.info.name; });
    });
}

/// `last`: the log is complete. Problems of the part are only reported then.
ExitCode write_page(const ReportOptions& options, const po::variables_map& values, bool last) {
    (void)output_format(options.output, page_formats());
    io::AtomicFile output(options.output);  // a name that cannot be written fails before the work
    const viz::PictureLibrariesPreload preload;
    StageClock clock(read_common(values), options.before.empty() ? 12 : 21);
    std::vector<ReportLog> logs;
    logs.push_back(load_report_log(options.part, options, clock));
    if (options.accepted) {
        ReportLog& judged = logs.front();
        judged.acceptance = io::accept(judged.quality.report, *options.accepted);
        io::note_changes(*judged.acceptance, judged.quality.report, judged.part.diagnostics);
    }
    if (last) print(logs.front().part.diagnostics, values);
    if (!options.before.empty()) {
        PartOptions other = options.part;
        other.log = options.before;
        other.log_source.reset();
        logs.push_back(load_report_log(other, options, clock));
        if (last) print(logs.back().part.diagnostics, values);
        keep_common_fields(logs.front().fields, logs.back().fields);
        keep_common_fields(logs.back().fields, logs.front().fields);
        clock.begin("compare the logs");
        RunAlignment alignment = align_runs(logs.front().surface.positions, logs.back().surface.positions);
        if (alignment.aligned > 0) logs.front().places_before = std::move(alignment.locations);
    }
    const ReportLog& shown = logs.front();
    if (shown.fields.empty())
        throw InputError(Place::of_file(shown.part.log.name), "no cutting point has a value to show",
                         "too few points, or the program and the log do not belong together?");

    clock.begin("measure");
    name_classes(logs);
    find_ramps(logs);
    io::ReportPage page = report_page_of(shown, logs, options);
    page.programmed = programmed_path(shown, options);
    if (options.measurement) page.measured = measured_for_report(shown, options, clock);
    std::optional<ReportedForm> as_machined;
    if (shown.quality.as_machined) {  // missing if the axis of the tool is unknown
        as_machined = form_for_report(shown, options, clock);
        page.height_map = page_height_map_of(*as_machined);
        page.as_machined_options = {"--surface", "formed", "--tool", to_text(*shown.part.tool)};
        if (options.measured)
            page.as_machined_options.insert(page.as_machined_options.end(),
                                            {"--swept", std::string(name_of(*options.measured))});
    }
    clock.begin("draw");
    add_report_pictures(page, shown, options, as_machined);
    clock.begin("write the page");
    output.write(fit_page(page, logs));
    output.commit();
    return ExitCode::done;
}

ExitCode run_report(const po::variables_map& values) {
    if (const std::optional<ShardNumber> shard = read_shard_number(values))
        return check_shard(read_part_options(values), *shard, values);
    ReportOptions options = read_report_options(values);
    read_report_shards(values, options);
    const std::optional<FollowOptions> follow = read_follow(values);
    if (!follow) return write_page(options, values, true);
    return update_while_growing(options.part, *follow, options.output,
                                [&](bool last) { return write_page(options, values, last); });
}

}  // namespace

Subcommand report_subcommand() {
    return {
        .name = "report",
        .arguments = "PROGRAM LOG -o report.html",
        .summary = "links surface, program, curves and defects in one HTML file",
        .description =
            "Writes one file that any browser opens offline: the surface, which can be turned, each place\n"
            "linked with its line and its point on the curves, the defects with pictures, the health of the\n"
            "log. The file loads nothing from a server. Pictures, tables and the summary can be read without\n"
            "JavaScript.\n"
            "The page of a log that is too large for memory is made shard by shard (`clsurf survey`, docs/howto/shards.md).\n\n"
            "  clsurf report part.nc run.biip -o report.html\n"
            "  clsurf report part.nc run.biip -o report.html --tool ball:6 --before old.biip\n"
            "  clsurf report part.nc run.biip -o report.html --tool ball:6 --measured stylus.csv --measured-at 12.5,3,90\n"
            "  clsurf report part.nc run.biip --survey run.survey --shards 8 -o report.html",
        .declare = declare_report_with_shards,
        .positional = {"PROGRAM", "LOG"},
        .run = run_report,
    };
}

}  // namespace clsurf::cli
