#include "io/line_ranges.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace clsurf::io {

std::string line_ranges(std::span<const DefectRun> runs, std::size_t shown) {
    std::vector<std::pair<LineNumber, LineNumber>> ranges;
    for (const DefectRun& run : runs) {
        // A loop that begins again ends on an earlier line than it began.
        if (run.first_line > 0) ranges.emplace_back(std::minmax({run.first_line, std::max(run.last_line, 1U)}));
    }
    if (ranges.empty()) return "-";
    std::sort(ranges.begin(), ranges.end());
    std::vector<std::pair<LineNumber, LineNumber>> merged;
    for (const auto& range : ranges) {
        if (!merged.empty() && range.first <= merged.back().second)
            merged.back().second = std::max(merged.back().second, range.second);
        else
            merged.push_back(range);
    }
    std::string text;
    for (std::size_t k = 0; k < std::min(shown, merged.size()); ++k) {
        const auto& [first, last] = merged[k];
        text += (k > 0 ? ", " : "") + (first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last));
    }
    if (merged.size() > shown) text += fmt::format(" and {} more", merged.size() - shown);
    return text;
}

}  // namespace clsurf::io
