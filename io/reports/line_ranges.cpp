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

/// "3-9, 12 and 4 more"; in a sentence, "… and 4 more ranges".
std::string text_of_ranges(std::vector<Range> ranges, std::size_t shown, bool in_sentence) {
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
    if (merged.size() <= shown) return text;
    const std::size_t more = merged.size() - shown;
    text += fmt::format(" and {} more", more);
    if (in_sentence) text += more == 1 ? " range" : " ranges";
    return text;
}

std::string text_of_runs(std::span<const DefectRun> runs, std::size_t shown, bool in_sentence) {
    std::vector<Range> ranges;
    std::map<std::string, std::vector<Range>> of_file;
    for (const DefectRun& run : runs) {
        // A loop that begins again ends on an earlier line than it began.
        if (run.first_line > 0) ranges.emplace_back(std::minmax({run.first_line, std::max(run.last_line, 1U)}));
        if (!run.file.empty()) of_file[run.file].emplace_back(run.file_first_line, run.file_last_line);
    }
    if (ranges.empty()) return "-";
    std::string text = text_of_ranges(std::move(ranges), shown, in_sentence);
    for (auto& [file, lines] : of_file)
        text += fmt::format(" (in {}: {})", file, text_of_ranges(std::move(lines), shown, in_sentence));
    return text;
}

}  // namespace

std::string line_ranges(std::span<const DefectRun> runs, std::size_t shown) { return text_of_runs(runs, shown, false); }

std::string named_line_ranges(std::span<const DefectRun> runs, std::size_t shown) {
    const std::string text = text_of_runs(runs, shown, true);
    if (text == "-") return "no known line";
    // Lines of a subprogram follow in brackets, ranges that are not shown behind "and"; the word is of what stands before them.
    const bool one = text.substr(0, std::min(text.find(" (in "), text.find(" and "))).find_first_not_of("0123456789") ==
                     std::string::npos;
    return (one ? "line " : "lines ") + text;
}

}  // namespace clsurf::io
