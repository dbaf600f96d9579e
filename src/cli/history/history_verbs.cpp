#include "cli/history/history_verbs.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/history/history_options.h"
#include "cli/runs/run_recorder.h"
#include "io/history/history_database.h"
#include "io/reports/history_report.h"

namespace clsurf::cli {
namespace {

void declare_nothing(po::options_description&) {}
void declare_add(po::options_description& options) {
    declare_recording(options);
    declare_judging(options);
}
void declare_trend_of_runs(po::options_description& options) {
    declare_run_choice(options);
    declare_trend(options);
}
void declare_against(po::options_description& options) {
    options.add_options()("run", po::value<long long>()->value_name("N"),
                          "the run that is compared (default: the latest)");
}

std::int64_t parse_run(const std::string& text) {
    const bool digits = !text.empty() && text.size() < 19 && text.find_first_not_of("0123456789") == std::string::npos;
    if (!digits) throw UsageError("'" + text + "' is not the number of a run");
    return std::stoll(text);
}

/// A run with its defects.
RunRecord read_run(const io::HistoryDatabase& history, std::int64_t id) {
    io::RunFilter filter;
    filter.id = id;
    std::vector<RunRecord> runs = history.runs(filter);
    if (runs.empty())
        throw InputError(Place::of_file(history.path()), fmt::format("has no run {}", id), "clsurf history DB list");
    history.read_defects(runs);
    return std::move(runs.front());
}

void answer(const HistoryCall& call, const std::string& text, const std::string& json) {
    if (read_json(call.values))
        write_to_stdout(json);
    else
        write_answer(text, call.values);
}

/// Without a verdict there are no defects to compare.
void refuse_unjudged(const RunRecord& run, const std::string& path) {
    if (run.judged) return;
    throw InputError(Place::of_file(path),
                     run.failed() ? fmt::format("run {} failed: {}", run.id, run.failure)
                                  : fmt::format("run {} was not judged: {}", run.id, run.not_judged_reasons),
                     "choose runs with a verdict: `clsurf history DB against N --run M`");
}

/// The run that `against` names; `run` is compared with it.
std::int64_t reference_of(const std::string& word, const std::vector<RunRecord>& runs, const RunRecord& run,
                          const std::string& path) {
    if (word != "best" && word != "first") return parse_run(word);
    const RunRecord* found = nullptr;
    if (word == "best") {
        found = best_run(runs, run);
    } else {
        const auto first = std::ranges::find_if(runs, [&](const RunRecord& r) {
            return r.judged && r.id != run.id && r.program_sha256 == run.program_sha256;
        });
        if (first != runs.end()) found = &*first;
    }
    if (found == nullptr)
        throw InputError(Place::of_file(path),
                         fmt::format("no other judged run of the same program as run {}", run.id));
    return found->id;
}

}  // namespace

std::span<const HistoryVerb> history_verbs() {
    static const std::vector<HistoryVerb> table{
        {"add", "PROGRAM LOG", 2, 2, declare_add, true, false, add_to_history},
        {"list", "", 0, 0, declare_run_choice, true, false, list_history},
        {"show", "N", 1, 1, declare_nothing, true, false, show_run},
        {"trend", "", 0, 0, declare_trend_of_runs, true, true, show_trend},
        {"against", "N|best|first", 1, 1, declare_against, true, false, compare_with_run},
        {"outliers", "", 0, 0, declare_run_choice, true, false, show_outliers},
        {"report", "", 0, 0, declare_run_choice, false, true, write_shop_page},
    };
    return table;
}

ExitCode add_to_history(const HistoryCall& call) {
    po::variables_map values = call.values;
    values.insert({"PROGRAM", po::variable_value(call.arguments[0], false)});
    values.insert({"LOG", po::variable_value(call.arguments[1], false)});
    PartOptions options = read_part_options(values);
    require_files(options.program, {options.log});
    const std::optional<Role> measured = take_measured_role(options);
    const CheckBudget budget = read_limits(values);
    const RunRecorder recorder(call.database, values);
    StageClock clock(read_common(values), 8);
    const CheckedRun run = check_run(options, measured, budget, clock);
    print(run.part.diagnostics, values);
    const io::AddedRun added = recorder.add(options, run);
    RunRecord record = read_run(io::HistoryDatabase(call.database), added.id);
    answer(call, recorder.text_of(added) + "\n" + io::history_text(std::span(&record, 1)),
           io::history_json(std::span(&record, 1)));
    return run.code;
}

ExitCode list_history(const HistoryCall& call) {
    const std::vector<RunRecord> runs = io::HistoryDatabase(call.database).runs(read_run_choice(call.values));
    answer(call, io::history_text(runs), io::history_json(runs));
    return ExitCode::done;
}

ExitCode show_run(const HistoryCall& call) {
    const RunRecord run = read_run(io::HistoryDatabase(call.database), parse_run(call.arguments[0]));
    answer(call, io::run_text(run), io::run_json(run));
    return ExitCode::done;
}

ExitCode compare_with_run(const HistoryCall& call) {
    const io::HistoryDatabase history(call.database);
    const std::vector<RunRecord> runs = history.runs();
    if (runs.empty()) throw InputError(Place::of_file(call.database), "has no runs yet");
    const std::int64_t id = call.values.count("run") > 0 ? call.values["run"].as<long long>() : runs.back().id;
    const RunRecord run = read_run(history, id);
    const RunRecord reference = read_run(history, reference_of(call.arguments[0], runs, run, call.database));
    for (const RunRecord* each : {&run, &reference}) refuse_unjudged(*each, call.database);
    Diagnostics diagnostics;
    if (reference.program_sha256 != run.program_sha256)
        diagnostics.add({Severity::warning,
                         "history.program",
                         Place::of_file(call.database),
                         fmt::format("runs {} and {} are of different programs: {}, {}", run.id, reference.id,
                                     run.program, reference.program),
                         {}});
    print(diagnostics, call.values);
    const RunComparison comparison = compare_runs(reference, run);
    answer(call, io::comparison_text(reference, run, comparison), io::comparison_json(reference, run, comparison));
    return ExitCode::done;
}

ExitCode show_outliers(const HistoryCall& call) {
    const std::vector<RunRecord> runs = io::HistoryDatabase(call.database).runs(read_run_choice(call.values));
    const std::vector<RunOutlier> outliers = find_outliers(runs);
    answer(call, io::outliers_text(runs, outliers), io::outliers_json(runs, outliers));
    return ExitCode::done;
}

}  // namespace clsurf::cli
