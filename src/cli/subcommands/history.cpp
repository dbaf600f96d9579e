// clsurf history: judged runs in a database, and their trends.

#include <algorithm>
#include <set>

#include "cli/history/history_options.h"
#include "cli/history/history_verbs.h"
#include "cli/runs/checked_run.h"
#include "cli/runs/run_recorder.h"
#include "core/spelling.h"

namespace clsurf::cli {
namespace {

const HistoryVerb& find_verb(const std::string& word) {
    std::vector<std::string_view> names;
    std::string list;
    for (const HistoryVerb& verb : history_verbs()) {
        if (verb.name == word) return verb;
        names.push_back(verb.name);
        list += (list.empty() ? "" : ", ") + std::string(verb.name);
    }
    const std::string nearest = did_you_mean(word, names);
    throw UsageError("'" + word + "' is not one of " + list,
                     nearest.empty() ? "usage: clsurf history DB VERB …" : nearest);
}

void declare_output(po::options_description& options) {
    options.add_options()("output,o", po::value<std::string>()->value_name("FILE"),
                          "the picture of trend (.png, .jpg, .tif, .webp, .svg or .pdf) or the page of report (.html)");
}

/// Throws UsageError: an option of another verb on the command line.
void refuse_foreign_options(const HistoryVerb& verb, const po::variables_map& values) {
    po::options_description own;
    verb.declare(own);
    declare_common(own);
    if (verb.json) declare_json(own);
    if (verb.output) declare_output(own);
    for (const auto& [name, value] : values) {
        const bool argument = name == "DB" || name == "VERB" || name == "ARGUMENT";
        if (argument || !given(values, name.c_str()) || own.find_nothrow(name, false) != nullptr) continue;
        throw UsageError("history … " + std::string(verb.name) + " takes no --" + name);
    }
}

ExitCode run_history(const po::variables_map& values) {
    HistoryCall call{required(values, "DB"), {}, values};
    if (values.count("VERB") == 0)
        throw UsageError("missing argument: VERB", "for example clsurf history " + call.database + " list");
    const HistoryVerb& verb = find_verb(values["VERB"].as<std::string>());
    if (values.count("ARGUMENT") > 0) call.arguments = values["ARGUMENT"].as<std::vector<std::string>>();
    const std::string usage = "usage: clsurf history DB " + std::string(verb.name) +
                              (verb.arguments.empty() ? "" : " ") + std::string(verb.arguments);
    if (call.arguments.size() < verb.least) throw UsageError("missing argument: " + std::string(verb.arguments), usage);
    if (call.arguments.size() > verb.most)
        throw UsageError("unexpected argument '" + call.arguments[verb.most] + "'", usage);
    refuse_foreign_options(verb, values);
    return verb.run(call);
}

}  // namespace

Subcommand history_subcommand() {
    return {
        .name = "history",
        .arguments = "DB add|list|show|trend|against|outliers|report …",
        .summary = "keeps judged runs in a database and shows trends, outliers, and when a level changed",
        .description =
            "DB is one SQLite file; `add` makes it. Several programs may add to it at the same time.\n\n"
            "  add PROGRAM LOG       judge a run as `check` does, and record it\n"
            "  list                  one row for each run\n"
            "  show N                everything recorded for a run\n"
            "  trend                 a quantity over the runs: since when, and with which tool\n"
            "  against N|best|first  the latest run against another one of its program\n"
            "  outliers              runs that stand out among those of their program\n"
            "  report                a page with trends, causes and the worst programs\n\n"
            "A run is its program, its log and its parameters, by content: adding it again replaces it.\n"
            "--program, --where, --since and --last choose runs for list, trend, outliers and report.\n"
            "The exit code of add is that of `check` (docs/history.md).\n\n"
            "  clsurf history shop.db add part.nc run.biip --tool ball:6 --param tool=D6R3\n"
            "  clsurf history shop.db trend --pass 7 --by tool -o pass7.png\n"
            "  clsurf history shop.db against best\n"
            "  clsurf history shop.db report -o shop.html",
        .declare =
            [](po::options_description& options) {
                declare_output(options);
                declare_json(options);
                declare_run_choice(options);
                declare_trend(options);
                options.add_options()("run", po::value<long long>()->value_name("N"),
                                      "the run that `against` compares (default: the latest)");
                declare_recording(options);
                declare_judging(options);
            },
        .positional = {"DB", "VERB", "ARGUMENT…"},
        .run = run_history,
    };
}

}  // namespace clsurf::cli
