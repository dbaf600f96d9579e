// clsurf help: the options of a subcommand, and the values of options.

#include <string>
#include <string_view>
#include <vector>

#include "cli/manual/help_text.h"
#include "cli/options/options.h"
#include "cli/options/vocabulary.h"
#include "core/spelling.h"
#include "io/reports/listing_json.h"

namespace clsurf::cli {
namespace {

/// "fields, channels, formats": the names of the vocabularies.
std::string vocabulary_names() {
    std::string names;
    for (const Vocabulary& vocabulary : vocabularies())
        names += (names.empty() ? "" : ", ") + std::string(vocabulary.name);
    return names;
}

ExitCode run_help(const po::variables_map& values) {
    const bool json = read_json(values);
    if (values.count("TOPIC") == 0) {
        if (json) throw UsageError("--json needs a list: clsurf help fields --json");
        write_to_stdout(overview_text());
        return ExitCode::done;
    }
    const std::string topic = required(values, "TOPIC");
    std::vector<std::string_view> known;
    for (const Vocabulary& vocabulary : vocabularies()) {
        known.push_back(vocabulary.name);
        if (vocabulary.name != topic && vocabulary.name != topic + "s") continue;
        write_to_stdout(json ? io::listing_json(vocabulary.name, vocabulary.rows()) : listing_text(vocabulary.rows()));
        return ExitCode::done;
    }
    for (const Subcommand& subcommand : subcommands()) {
        if (!subcommand.hidden) known.push_back(subcommand.name);
        if (subcommand.name != topic) continue;
        if (json) throw UsageError("--json is for lists: clsurf help fields --json");
        write_to_stdout(help_text(subcommand));
        return ExitCode::done;
    }
    throw UsageError("no help on '" + topic + "'", did_you_mean(topic, known));
}

}  // namespace

Subcommand help_subcommand() {
    // The texts are static, because views of them outlive the call.
    static const std::string summary = "shows the options of a subcommand, or a list: " + vocabulary_names();
    static const std::string description = "TOPIC is a subcommand, or a list of words that options take as values:\n" +
                                           vocabulary_names() + ". Lists can be had as JSON.";
    return {
        .name = "help",
        .arguments = "[TOPIC]",
        .summary = summary,
        .description = description,
        .declare = [](po::options_description& options) { declare_json(options); },
        .positional = {"TOPIC"},
        .run = run_help,
    };
}

}  // namespace clsurf::cli
