#include "io/reports/defect_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/units.h"
#include "io/reports/line_ranges.h"

namespace clsurf::io {
namespace {

constexpr double as_strong = 0.5;  ///< least score of a defect in the title, as a share of the strongest

std::string number_word(std::size_t n) {
    static constexpr std::array<std::string_view, 12> words{"One",   "Two",   "Three", "Four", "Five",   "Six",
                                                            "Seven", "Eight", "Nine",  "Ten",  "Eleven", "Twelve"};
    return n >= 1 && n <= words.size() ? std::string(words[n - 1]) : fmt::format("{}", n);
}

/// Defects that the title counts together.
struct Group {
    std::set<std::int64_t> passes;
    std::size_t defects = 0;
    double least = 0, most = 0;  ///< in percent or µm
};

double shown_size(const Defect& d) {
    const bool speed = d.quantity == Quantity::speed;
    return speed ? 100 * std::abs(d.speed_mismatch) : um_per_mm * d.depth;
}

bool same_kind(const Defect& a, const Defect& b) {
    const bool same_sign = a.quantity != Quantity::speed || (a.speed_mismatch < 0) == (b.speed_mismatch < 0);
    const bool same_way = (a.cause == Cause::oscillation) == (b.cause == Cause::oscillation);
    const bool same_fault = (a.cause == Cause::path_tolerance) == (b.cause == Cause::path_tolerance);
    return a.quantity == b.quantity && same_sign && same_way && same_fault && !a.systematic && !b.systematic;
}

Group group_of(const QualityReport& report) {
    const Defect& strongest = report.defects.front();
    Group group;
    for (const Defect& d : report.defects) {
        if (&d != &strongest && (!same_kind(d, strongest) || d.score < as_strong * strongest.score)) continue;
        for (const DefectSection& section : d.sections) group.passes.insert(section.pass);
        const double size = shown_size(d);
        group.least = group.defects == 0 ? size : std::min(group.least, size);
        group.most = std::max(group.most, size);
        ++group.defects;
    }
    return group;
}

/// "82 to 87", "82".
std::string range_text(const Group& group, int digits) {
    const std::string low = fmt::format("{:.{}f}", group.least, digits);
    const std::string high = fmt::format("{:.{}f}", group.most, digits);
    return low == high ? low : low + " to " + high;
}

/// "Pass 12", "Five passes".
std::string passes_text(const Group& group) {
    if (group.passes.size() == 1) return fmt::format("Pass {}", *group.passes.begin());
    return number_word(group.passes.size()) + " passes";
}

/// The same within a sentence: "pass 12", "5 passes".
std::string subject_of(const Group& group) {
    if (group.passes.size() == 1) return fmt::format("pass {}", *group.passes.begin());
    return fmt::format("{} passes", group.passes.size());
}

}  // namespace

std::string headline_of(const QualityReport& report) {
    if (report.defects.empty()) return report.judgement.judged() ? "No defects" : "Not judged";
    const Defect& d = report.defects.front();
    if (d.systematic)
        return fmt::format("The axes lag: adjacent passes differ by up to ±{:.0f} µm on {:.0f} % of the part",
                           um_per_mm * d.depth, 100 * d.share);
    const Group group = group_of(report);
    const bool one = group.passes.size() == 1;
    const std::string who = passes_text(group);
    const std::string_view whose = one ? "its" : "their";
    switch (d.quantity) {
        case Quantity::speed:
            if (d.cause == Cause::oscillation)
                return fmt::format("The speed of {} oscillates by {} %", subject_of(group), range_text(group, 0));
            return fmt::format("{} {} {} % {} than {} neighbours", who, one ? "runs" : "run", range_text(group, 0),
                               d.speed_mismatch < 0 ? "slower" : "faster", whose);
        case Quantity::acceleration:
            return fmt::format("{} {} differently from {} neighbours", who, one ? "accelerates" : "accelerate", whose);
        case Quantity::normal_deviation:
            return fmt::format("Axis lag on {} differs from the neighbours by {} µm", subject_of(group),
                               range_text(group, 1));
        case Quantity::relief:
            if (d.cause == Cause::path_tolerance)
                return fmt::format("The controller leaves the program: {} {} {} µm off {} neighbours",
                                   subject_of(group), one ? "runs" : "run", range_text(group, 1), whose);
            return fmt::format("{} {} {} µm off {} neighbours in the program", who, one ? "is" : "are",
                               range_text(group, 1), whose);
    }
    return {};
}

std::string label_of(const Defect& d) {
    const std::string_view sign = d.systematic ? "±" : d.pit ? "−" : "+";
    switch (d.quantity) {
        case Quantity::speed:
            return fmt::format("{}{:.0f} % speed", d.speed_mismatch < 0 ? "−" : "+", 100 * std::abs(d.speed_mismatch));
        case Quantity::acceleration: return fmt::format("{:.0f} mm/s² acceleration", d.acceleration_jump);
        case Quantity::normal_deviation: return fmt::format("{}{:.1f} µm lag", sign, um_per_mm * d.depth);
        case Quantity::relief: return fmt::format("{}{:.1f} µm relief", sign, um_per_mm * d.depth);
    }
    return {};
}

std::string place_label(const Defect& d) {
    const Vec3 p = d.place.position();
    const auto number = [](double value) {
        const double rounded = std::round(10 * value) / 10;
        return fmt::format("{}{:.1f}", rounded < 0 ? "−" : "", std::abs(rounded));
    };
    return fmt::format("X {}  Y {}  Z {}", number(p.x()), number(p.y()), number(p.z()));
}

std::string cause_label(const Defect& d) {
    std::string words(name_of(d.cause));
    std::replace(words.begin(), words.end(), '_', ' ');
    if (!(d.depth > 0)) return words;
    if (d.systematic) return fmt::format("{}, ±{:.1f} µm", words, um_per_mm * d.depth);
    return fmt::format("{}, {:.1f} µm {}", words, um_per_mm * d.depth, deep_or_high(d.pit));
}

std::string lines_label(const Defect& d) {
    const std::vector<LineRange> ranges = sections_lines(d);
    if (ranges.empty()) return {};
    const auto& [first, last] = ranges.front();
    std::string text = first == last ? fmt::format("line {}", first) : fmt::format("lines {}–{}", first, last);
    if (ranges.size() > 1) text += fmt::format(", {} sections", ranges.size());
    return text;
}

}  // namespace clsurf::io
