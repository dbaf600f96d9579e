#include "io/reports/line_ranges.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace clsurf::io {

namespace {

using Range = std::pair<LineNumber, LineNumber>;

std::string text_of_ranges(std::vector<Range> ranges, std::size_t shown) {
    std::sort(ranges.begin(), ranges.end());
    std::vector<Range> merged;
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

}  // namespace

std::string line_ranges(std::span<const DefectRun> runs, std::size_t shown) {
    std::vector<Range> ranges;
    std::map<std::string, std::vector<Range>> of_file;
    for (const DefectRun& run : runs) {
        // A loop that begins again ends on an earlier line than it began.
        if (run.first_line > 0) ranges.emplace_back(std::minmax({run.first_line, std::max(run.last_line, 1U)}));
        if (!run.file.empty()) of_file[run.file].emplace_back(run.file_first_line, run.file_last_line);
    }
    if (ranges.empty()) return "-";
    std::string text = text_of_ranges(std::move(ranges), shown);
    for (auto& [file, lines] : of_file)
        text += fmt::format(" (in {}: {})", file, text_of_ranges(std::move(lines), shown));
    return text;
}

std::string named_line_ranges(std::span<const DefectRun> runs, std::size_t shown) {
    const std::string text = line_ranges(runs, shown);
    if (text == "-") return "no known line";
    // Lines of a subprogram follow in brackets; the word is of what stands before them.
    const bool one = text.substr(0, text.find(" (in ")).find_first_not_of("0123456789") == std::string::npos;
    return (one ? "line " : "lines ") + text;
}

}  // namespace clsurf::io
