#include "io/reports/line_ranges.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace clsurf::io {
namespace {

/// The last line of a section can be before its first one, in a repeated loop.
LineRange rising(LineNumber first, LineNumber last) { return std::minmax({first, std::max(last, 1U)}); }

std::vector<LineRange> merged(std::vector<LineRange> ranges) {
    std::sort(ranges.begin(), ranges.end());
    std::vector<LineRange> merged;
    for (const LineRange& range : ranges) {
        if (!merged.empty() && range.first <= merged.back().second)
            merged.back().second = std::max(merged.back().second, range.second);
        else
            merged.push_back(range);
    }
    return merged;
}

/// Moves the range with a line to the front.
void put_first(std::vector<LineRange>& ranges, LineNumber line) {
    const auto found = std::find_if(ranges.begin(), ranges.end(),
                                    [&](const LineRange& r) { return r.first <= line && line <= r.second; });
    if (found != ranges.end()) std::rotate(ranges.begin(), found, found + 1);
}

/// "3-9, 12 and 4 more"; in a sentence, "… and 4 more ranges".
std::string text_of_ranges(const std::vector<LineRange>& ranges, std::size_t shown, bool in_sentence) {
    std::string text;
    for (std::size_t k = 0; k < std::min(shown, ranges.size()); ++k) {
        const auto& [first, last] = ranges[k];
        text += (k > 0 ? ", " : "") + (first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last));
    }
    if (ranges.size() <= shown) return text;
    const std::size_t more = ranges.size() - shown;
    text += fmt::format(" and {} more", more);
    if (in_sentence) text += more == 1 ? " range" : " ranges";
    return text;
}

std::string text_of(const Defect& defect, std::size_t shown, bool in_sentence) {
    const std::vector<LineRange> ranges = sections_lines(defect);
    if (ranges.empty()) return "-";
    std::map<std::string, std::vector<LineRange>> of_file;
    for (const DefectSection& section : defect.sections) {
        if (!section.file.empty()) of_file[section.file].emplace_back(section.file_first_line, section.file_last_line);
    }
    std::string text = text_of_ranges(ranges, shown, in_sentence);
    const DefectSection* strongest = strongest_section(defect);
    for (auto& [file, lines] : of_file) {
        std::vector<LineRange> in_file = merged(std::move(lines));
        if (strongest->file == file) put_first(in_file, strongest->file_first_line);
        text += fmt::format(" (in {}: {})", file, text_of_ranges(in_file, shown, in_sentence));
    }
    return text;
}

}  // namespace

std::vector<LineRange> sections_lines(const Defect& defect) {
    std::vector<LineRange> ranges;
    for (const DefectSection& section : defect.sections) {
        if (section.first_line > 0) ranges.push_back(rising(section.first_line, section.last_line));
    }
    ranges = merged(std::move(ranges));
    if (const DefectSection* strongest = strongest_section(defect); strongest != nullptr && strongest->first_line > 0)
        put_first(ranges, strongest->first_line);
    return ranges;
}

std::string line_ranges(const Defect& defect, std::size_t shown) { return text_of(defect, shown, false); }

std::string named_line_ranges(const Defect& defect, std::size_t shown) {
    const std::string text = text_of(defect, shown, true);
    if (text == "-") return "no known line";
    // Lines of a subprogram follow in brackets, further ranges after "and"; the noun counts only the ranges before them.
    const bool one = text.substr(0, std::min(text.find(" (in "), text.find(" and "))).find_first_not_of("0123456789") ==
                     std::string::npos;
    return (one ? "line " : "lines ") + text;
}

}  // namespace clsurf::io
