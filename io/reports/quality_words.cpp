#include "io/reports/quality_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/units.h"

namespace clsurf::io {
namespace {

constexpr double least_shown_depth = 5e-5;  ///< [mm] a depth that is shown as 0.0 µm is neither pit nor bulge
constexpr double least_depth = 1e-4;        ///< [mm] least depth that is mentioned next to a change of speed

std::string with_um(double mm) { return fmt::format("{:.1f} µm", mm * um_per_mm); }

/// "pass 14", "passes 12 and 13", "12 passes from 3 to 57".
std::string passes_text(const Defect& d) {
    std::vector<std::int64_t> passes;
    for (const DefectSection& section : d.sections) passes.push_back(section.pass);
    std::sort(passes.begin(), passes.end());
    passes.erase(std::unique(passes.begin(), passes.end()), passes.end());
    if (passes.empty()) return "a pass";
    if (passes.size() == 1) return fmt::format("pass {}", passes[0]);
    if (passes.size() == 2) return fmt::format("passes {} and {}", passes[0], passes[1]);
    return fmt::format("{} passes from {} to {}", passes.size(), passes.front(), passes.back());
}

bool one_pass(const Defect& d) {
    return std::all_of(d.sections.begin(), d.sections.end(),
                       [&](const DefectSection& section) { return section.pass == d.sections.front().pass; });
}

std::string capitalised(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

/// "pass 14 runs 82 % slower than its neighbours".
std::string speed_text(const Defect& d) {
    const bool one = one_pass(d);
    return fmt::format("{} {} {:.0f} % {} than {} neighbours", passes_text(d), one ? "runs" : "run",
                       100 * std::abs(d.speed_mismatch), d.speed_mismatch < 0 ? "slower" : "faster",
                       one ? "its" : "their");
}

std::string motion_text(const Defect& d) {
    switch (d.cause) {
        case Cause::oscillation:
            return fmt::format("the speed of {} oscillates by up to {:.0f} % about that of the neighbours",
                               passes_text(d), 100 * std::abs(d.speed_mismatch));
        case Cause::corner: return speed_text(d) + " in a corner";
        default: break;
    }
    if (d.quantity == Quantity::acceleration)
        return fmt::format("{} {} differently from the neighbours", passes_text(d),
                           one_pass(d) ? "accelerates" : "accelerate");
    return speed_text(d);
}

std::string height_text(const Defect& d) {
    const std::string_view where = d.pit ? "below" : "above";
    if (d.quantity == Quantity::relief && d.cause == Cause::path_tolerance)
        return fmt::format("the controller leaves the programmed path: {} {} {} {} the neighbours", passes_text(d),
                           one_pass(d) ? "runs" : "run", with_um(d.depth), where);
    if (d.quantity == Quantity::relief)
        return fmt::format("in the program, {} {} {} {} {} neighbours", passes_text(d), one_pass(d) ? "is" : "are",
                           with_um(d.depth), where, one_pass(d) ? "its" : "their");
    const std::string_view when = d.cause == Cause::corner     ? " in a corner"
                                  : d.cause == Cause::reversal ? " after an axis reverses"
                                                               : "";
    return fmt::format("axis lag on {} differs from the neighbours by {} ({} them){}", passes_text(d), with_um(d.depth),
                       where, when);
}

std::string systematic_text(const Defect& d) {
    std::string text =
        fmt::format("axes lag, forward against backward: adjacent passes differ by up to ±{} on {:.0f} % of the part",
                    with_um(d.depth), 100 * d.share);
    if (d.delays.size() < 2) return text + "; servo gains or feed-forward of the axes differ, or an axis has backlash";
    std::string axes;
    for (std::size_t k = d.delays.size(); k-- > 0;) {
        axes += static_cast<char>(d.delays[k].axis - 'a' + 'A');
        if (k > 0) axes += k == 1 ? " and " : ", ";
    }
    const AxisDelay& slow = d.delays.front();
    const AxisDelay& fast = d.delays.back();
    constexpr double ms_per_s = 1e3;
    return text + fmt::format("; servo gains or feed-forward of {} differ ({} trails {} by {:.2f} ms)", axes,
                              static_cast<char>(slow.axis - 'a' + 'A'), static_cast<char>(fast.axis - 'a' + 'A'),
                              ms_per_s * (slow.delay - fast.delay));
}

constexpr RuleText systematic_rule{
    "systematic_lag", "Axis lag alternates with the direction of travel over a large part of the surface.",
    "Match the servo gains (Kv) and the feed-forward of the axes that are named, look for backlash, or finish in one "
    "direction."};

/// One kind of defects in a verdict.
struct Kind {
    std::string_view one, many;  ///< "slower section", "slower sections"
    std::size_t count = 0;
    const Defect* most = nullptr;  ///< the largest of the kind
};

std::array<std::string_view, 2> kind_of(const Defect& d) {
    if (d.systematic) return {"systematic axis lag", "systematic axis lag"};
    if (d.cause == Cause::oscillation) return {"speed oscillation", "speed oscillations"};
    switch (d.quantity) {
        case Quantity::speed:
            return d.speed_mismatch < 0 ? std::array<std::string_view, 2>{"slower section", "slower sections"}
                                        : std::array<std::string_view, 2>{"faster section", "faster sections"};
        case Quantity::acceleration:
            return {"section with different acceleration", "sections with different acceleration"};
        case Quantity::normal_deviation: return {"section with different axis lag", "sections with different axis lag"};
        case Quantity::relief:
            if (d.cause == Cause::path_tolerance)
                return {"pass that leaves its programmed path", "passes that leave their programmed path"};
            return {"pass programmed too high or too low", "passes programmed too high or too low"};
    }
    return {"defect", "defects"};
}

/// The size of a defect in the quantity of its kind.
double size_of(const Defect& d) { return d.quantity == Quantity::speed ? std::abs(d.speed_mismatch) : d.depth; }

std::string kind_text(const Kind& kind) {
    const Defect& d = *kind.most;
    if (d.systematic) return fmt::format("{} (±{} on {:.0f} % of the part)", kind.one, with_um(d.depth), 100 * d.share);
    const std::string count =
        kind.count == 1 ? fmt::format("1 {}", kind.one) : fmt::format("{} {}", kind.count, kind.many);
    if (d.quantity == Quantity::acceleration) return count;
    if (d.quantity == Quantity::speed)
        return fmt::format("{} ({}{} %)", count, kind.count > 1 ? "up to " : "",
                           signed_text(100 * d.speed_mismatch, 0));
    return fmt::format("{} ({}{})", count, kind.count > 1 ? "up to " : "", with_um(d.depth));
}

/// The kinds of a report's defects, in order of their first occurrence.
std::vector<Kind> kinds_of(const QualityReport& report) {
    std::vector<Kind> kinds;
    for (const Defect& d : report.defects) {
        const auto [one, many] = kind_of(d);
        auto kind = std::find_if(kinds.begin(), kinds.end(), [&, name = one](const Kind& k) { return k.one == name; });
        if (kind == kinds.end()) kind = kinds.insert(kinds.end(), {one, many, 0, &d});
        ++kind->count;
        if (size_of(d) > size_of(*kind->most)) kind->most = &d;
    }
    return kinds;
}

}  // namespace

std::string_view place_word(const CutterPlace& place) { return place.contact ? "contact" : "tool tip"; }

std::string axes_text(const Vec3& at, int decimals) {
    return fmt::format("X {} Y {} Z {}", fixed_text(at.x(), decimals), fixed_text(at.y(), decimals),
                       fixed_text(at.z(), decimals));
}

std::string coordinates_text(const Vec3& at) {
    return fmt::format("{} {} {}", fixed_text(at.x(), 2), fixed_text(at.y(), 2), fixed_text(at.z(), 2));
}

std::string place_text(const CutterPlace& place) {
    return fmt::format("{} {} mm", place_word(place), axes_text(place.position()));
}

std::string_view shape_of(bool systematic, double depth, bool pit) {
    if (systematic) return "alternating";
    if (depth < least_shown_depth) return "none";
    return pit ? "pit" : "bulge";
}

std::string_view shape_of(const Defect& defect) { return shape_of(defect.systematic, defect.depth, defect.pit); }

std::string depth_text(const Defect& defect, std::string_view unit) {
    const std::string_view shape = shape_of(defect);
    return fmt::format("{:.1f}{}{}", defect.depth * um_per_mm, unit, shape == "none" ? "" : fmt::format(" {}", shape));
}

std::string sentence_of(const Defect& d) {
    if (d.systematic) return capitalised(systematic_text(d));
    const bool motion = d.quantity == Quantity::speed || d.quantity == Quantity::acceleration;
    std::string text = motion ? motion_text(d) : height_text(d);
    text += fmt::format(" over {:.1f} mm", d.length);
    if (motion && d.cause == Cause::point_spacing) text += " (programmed points are spaced differently)";
    if (motion && d.depth >= least_depth) text += fmt::format("; predicted {} of {}", shape_of(d), with_um(d.depth));
    return capitalised(text);
}

std::string_view sentence_of(MarkNote note) {
    switch (note) {
        case MarkNote::none: return "";
        case MarkNote::unknown_form: return "the form is not known here (a crease, a fillet or a border)";
        case MarkNote::uneven_passes: return "the adjacent passes differ from each other by as much as the mark";
        case MarkNote::cut_away: return "the adjacent passes cut the bulge down";
        case MarkNote::other_passes:
            return "the adjacent passes deviate too: the depth is that of all of them together";
    }
    return "";
}

std::string verdict_of(const QualityReport& report) {
    std::string text;
    const bool judged = report.judgement.judged();
    if (!judged) {
        text = "Not judged:";
        for (const std::string& reason : report.judgement.reasons) text += " " + reason;
        if (report.defects.empty()) return text;
        text += " Where passes could be compared: ";
    }
    if (report.defects.empty()) return "No defects: no pass differs from its neighbours enough to leave a mark.";
    text += fmt::format("{} {}: ", report.defects.size(), report.defects.size() == 1 ? "defect" : "defects");
    const std::vector<Kind> kinds = kinds_of(report);
    for (std::size_t k = 0; k < kinds.size(); ++k) text += (k > 0 ? ", " : "") + kind_text(kinds[k]);
    return text + ".";
}

std::string thresholds_text(const QualityReport& report) {
    std::string text;
    const auto add = [&](Quantity quantity, std::string_view name, double factor, int digits, std::string_view unit) {
        const double value = factor * static_cast<double>(report.thresholds.of[index_of(quantity)]);
        if (!std::isfinite(value)) return;
        text += fmt::format("{}{} {:.{}f} {}", text.empty() ? "" : ", ", name, value, digits, unit);
    };
    add(Quantity::speed, "speed", 100, 1, "%");
    add(Quantity::acceleration, "acceleration", 1, 0, "mm/s²");
    if (report.has_lag) add(Quantity::normal_deviation, "lag", um_per_mm, 1, "µm");
    add(Quantity::relief, "relief of the passes", um_per_mm, 1, "µm");
    return text;
}

const RuleText& rule_of(const Defect& defect) {
    static constexpr std::array rules{
        RuleText{
            "feed_drop", "A pass runs at a different speed than its neighbours.",
            "Look for short blocks, a feed override or a block that the look-ahead cannot see past, on the lines at "
            "fault; `clsurf optimize` evens the feeds of adjacent passes."},
        RuleText{
            "oscillation", "The speed of a pass oscillates about that of its neighbours.",
            "Short blocks of uneven length make the planner speed up and slow down: space the points evenly, widen "
            "the tolerance of the control (G64 P, CYCLE832), or run `clsurf optimize`."},
        RuleText{
            "lag_step", "Axis lag on a pass differs from the adjacent passes.",
            "The axes follow the commanded path differently there: compare speed and acceleration of the passes, and "
            "the servo gains of the axes."},
        RuleText{"point_spacing", "Programmed points of a pass are spaced differently from the adjacent passes.",
                 "Post the toolpath again with evenly spaced points, or run `clsurf optimize`."},
        RuleText{"corner", "A pass differs from its neighbours in a corner of the programmed path.",
                 "Round the corner in the toolpath, or widen the tolerance of the control there."},
        RuleText{"reversal", "Axis lag on a pass differs from the adjacent passes after an axis reverses.",
                 "Check the axis for backlash and its friction compensation."},
        RuleText{"pass_end", "A pass begins or ends next to a pass that continues.",
                 "Expected at the border of a part."},
        RuleText{
            "path_tolerance", "The controller deviates from the programmed path differently from the adjacent passes.",
            "Narrow the tolerance of the controller (G64 P and Q, CYCLE832, cycle 32), or program points that are closer "
            "together."},
    };
    return defect.systematic ? systematic_rule : rules.at(static_cast<std::size_t>(defect.cause));
}

}  // namespace clsurf::io
