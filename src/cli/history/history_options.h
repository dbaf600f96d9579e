#pragma once
// The options of `history` that select runs and the quantity to show.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"
#include "history/history_quantity.h"
#include "io/history/history_database.h"
#include "viz/chart.h"

namespace clsurf::cli {

/// --program, --where, --since, --last.
void declare_run_choice(po::options_description& options);
[[nodiscard]] io::RunFilter read_run_choice(const po::variables_map& values);

/// --quantity, --pass, --lines, --cause, --by, --limit, -o, --size, --gl.
void declare_trend(po::options_description& options);

struct TrendOptions {
    const HistoryQuantity* quantity = nullptr;
    DefectFilter filter;
    std::string by;
    std::optional<double> limit;
    std::string output;  ///< empty: no picture
    viz::ChartLook look;
};
/// Throws UsageError.
[[nodiscard]] TrendOptions read_trend_options(const po::variables_map& values);

}  // namespace clsurf::cli
