#pragma once
// The verbs of `history`: each reads its arguments and options, queries the database, and formats the answer.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.h"

namespace clsurf::cli {

/// The words after `clsurf history`.
struct HistoryCall {
    std::string database;
    std::vector<std::string> arguments;  ///< arguments of the verb
    const po::variables_map& values;
};

struct HistoryVerb {
    std::string_view name;
    std::string_view arguments;                         ///< "PROGRAM LOG", for messages
    std::size_t least = 0, most = 0;                    ///< arguments
    void (*declare)(po::options_description& options);  ///< declares its options, except --json and --output
    bool json = true, output = false;                   ///< whether the verb has these options
    ExitCode (*run)(const HistoryCall& call);
};
[[nodiscard]] std::span<const HistoryVerb> history_verbs();

// One function per verb.
[[nodiscard]] ExitCode add_to_history(const HistoryCall& call);
[[nodiscard]] ExitCode list_history(const HistoryCall& call);
[[nodiscard]] ExitCode show_run(const HistoryCall& call);
[[nodiscard]] ExitCode show_trend(const HistoryCall& call);
[[nodiscard]] ExitCode compare_with_run(const HistoryCall& call);
[[nodiscard]] ExitCode show_outliers(const HistoryCall& call);
[[nodiscard]] ExitCode write_shop_page(const HistoryCall& call);

}  // namespace clsurf::cli
