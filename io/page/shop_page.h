#pragma once
// The page of `history … report`: trends, causes and the worst programs of a shop, in one self-contained HTML file.

#include <span>
#include <string>
#include <vector>

#include "history/outliers.h"
#include "history/run_record.h"
#include "io/history/history_database.h"

namespace clsurf::io {

struct ShopPage {
    std::string database;                ///< its name
    std::span<const RunRecord> runs;     ///< in order of time
    std::span<const CauseCount> causes;  ///< causes in these runs and others
    std::span<const RunOutlier> outliers;
};

/// O(runs).
[[nodiscard]] std::string write_shop_page(const ShopPage& page);

}  // namespace clsurf::io
