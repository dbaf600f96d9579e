// clsurf survey: the properties of a long log as a whole, for judging it in shards.

#include <algorithm>

#include <fmt/format.h>

#include "cli/options/survey_options.h"
#include "cli/terminal.h"
#include "core/column_file.h"

namespace clsurf::cli {
namespace {

ExitCode run_survey(const po::variables_map& values) {
    const std::string output = required(values, "output");
    PartOptions options = read_part_options(values);
    if (values.count("scratch") > 0) keep_columns_in(values["scratch"].as<std::string>());
    const io::SurveyOrigin origin = survey_origin(options, values);
    const std::optional<Role> measured = take_measured_role(options);
    StageClock clock(read_common(values), 6);
    const Part part = load_part(options, clock);
    print(part.diagnostics, values);
    clock.begin("survey the log");
    const Survey survey = make_survey(part, measured);
    clock.begin("write the survey");
    io::write_survey(output, survey, origin);
    clock.end();
    const auto passes = std::count_if(survey.passes.begin(), survey.passes.end(),
                                      [](const Pass& pass) { return pass.kind == PassKind::cut; });
    write_answer(fmt::format("{} points, {} of them in {} passes, {:.3f} mm apart\n", survey.points,
                             cutting_points(survey.passes), passes, survey.step_over),
                 values);
    return ExitCode::done;
}

}  // namespace

Subcommand survey_subcommand() {
    return {
        .name = "survey",
        .arguments = "PROGRAM LOG -o run.survey",
        .summary = "analyses a long log as a whole, so that it can be judged in shards",
        .description =
            "Finds the passes of a log, the neighbours of each point and the thresholds of its defects, and keeps\n"
            "them in a file. With it `clsurf check --shard` and `clsurf export --shard` work on a part of the log without\n"
            "reading the rest, on one machine or on many (docs/howto/shards.md). The log is a BIIP file of a machine with\n"
            "three axes. Give the same options for program and log to every step.\n"
            "The file takes 8 bytes a point, and only the version of clsurf that made it can read it. If memory is too\n"
            "small for 24 to 32 bytes a point, --scratch keeps them in temporary files.\n\n"
            "  clsurf survey part.nc run.biip -o run.survey\n"
            "  clsurf check part.nc run.biip --survey run.survey --shard 1/8 -o shard1.json\n"
            "  clsurf check part.nc run.biip --survey run.survey --merge shard*.json -o whole.json",
        .declare =
            [](po::options_description& options) {
                options.add_options()("output,o", po::value<std::string>()->value_name("FILE"), "the survey");
                options.add_options()(
                    "scratch", po::value<std::string>()->value_name("FOLDER"),
                    "keep the data of the log in files in this folder instead of in memory (up to 32 bytes a point)");
                declare_part(options);
            },
        .positional = {"PROGRAM", "LOG"},
        .run = run_survey,
    };
}

}  // namespace clsurf::cli
