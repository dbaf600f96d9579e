// The rules of lint. To add one: a row of `lint_rule_table`, and its check.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/statistics.h"
#include "core/units.h"
#include "lint/lint.h"
#include "lint/lint_rule.h"

namespace clsurf {
namespace {

using Findings = std::vector<LintFinding>;

// fewest_uneven, scatter_of_starts: docs/optimize.md#lint.
constexpr std::size_t fewest_uneven = 3;   ///< ends in a run: saving one or two points on a collinear line is harmless
constexpr double reversing_cosine = -0.5;  ///< a line that turns by more than 120° runs back
constexpr double scatter_of_starts = 6;    ///< multiple of the median absolute residual; a greater one is out of line
constexpr double start_reach = 6;  ///< [step-overs] greatest distance between ends of adjacent passes across the feed

void check_spacing(const LintContext& context, const LintRule& rule, Findings& findings) {
    find_runs(
        context, rule, {fewest_uneven, true},
        [&](const ProgrammedPass& pass, PointIndex i) {
            return context.against_both(pass, i, context.thresholds().spacing_ratio,
                                        [&](PointIndex p) { return context.spacing_at(p); });
        },
        findings);
}

void check_feeds(const LintContext& context, const LintRule& rule, Findings& findings) {
    find_runs(
        context, rule, {},
        [&](const ProgrammedPass& pass, PointIndex i) {
            return context.against_both(pass, i, context.thresholds().feed_ratio,
                                        [&](PointIndex p) { return context.feed_at(p); });
        },
        findings);
}

void check_chords(const LintContext& context, const LintRule& rule, Findings& findings) {
    if (context.tolerance() <= 0 || context.chord_error() <= 0) return;
    const double most = context.tolerance() / context.thresholds().least_tolerance_ratio;
    find_runs(
        context, rule, {},
        [&](const ProgrammedPass&, PointIndex i) -> std::optional<LintMeasure> {
            const double error = context.chord_error_at(i);
            if (error <= most) return std::nullopt;
            return LintMeasure{error, most, -1};
        },
        findings);
    if (context.chord_error() > 0 &&
        context.tolerance() > context.thresholds().most_tolerance_ratio * context.chord_error()) {
        const ProgrammedPass& first = context.passes().front();
        findings.push_back({&rule,
                            Severity::note,
                            context.line(first.ends[1]),
                            context.line(context.passes().back().ends.back()),
                            0,
                            0,
                            0,
                            first.ends[0],
                            {context.at(first.ends[0]), {}},
                            context.chord_error(),
                            context.tolerance() / context.thresholds().most_tolerance_ratio});
    }
}

void check_reversals(const LintContext& context, const LintRule& rule, std::vector<LintFinding>& findings) {
    const double longest = context.thresholds().reversed_share * context.spacing();
    find_runs(
        context, rule, {},
        [&](const ProgrammedPass& pass, PointIndex i) -> std::optional<LintMeasure> {
            const auto k =
                static_cast<std::size_t>(std::lower_bound(pass.ends.begin(), pass.ends.end(), i) - pass.ends.begin());
            if (k < 2 || k + 1 >= pass.ends.size()) return std::nullopt;
            const Vec3 before = context.at(pass.ends[k - 1]) - context.at(pass.ends[k - 2]),
                       mine = context.at(i) - context.at(pass.ends[k - 1]),
                       after = context.at(pass.ends[k + 1]) - context.at(i);
            const double length = mine.norm();
            if (length <= 0 || length > longest || before.dot(after) <= 0) return std::nullopt;
            const bool back = mine.dot(before) < reversing_cosine * length * before.norm() &&
                              mine.dot(after) < reversing_cosine * length * after.norm();
            return back ? std::optional(LintMeasure{length, context.spacing(), -1}) : std::nullopt;
        },
        findings);
}

/// An end of a pass, and the nearest ends of the previous and the next pass in the program.
struct End {
    const ProgrammedPass* pass = nullptr;
    bool begins = false;
    double residual = 0;  ///< [mm] along the feed
    LineNumber beside = 0;
};

End measure_end(const LintContext& context, std::size_t i, bool begins) {
    const ProgrammedPass& pass = context.passes()[i];
    const PointIndex mine = begins ? pass.points.first : pass.points.last;
    const Vec3 here = context.at(mine);
    const Vec3 feed = (context.at(begins ? std::min(mine + 1, pass.points.last) : mine) -
                       context.at(begins ? mine : std::max(mine - 1, pass.points.first)))
                          .normalized();
    Vec3 mean = Vec3::Zero();
    End end{&pass, begins, 0, 0};
    for (const std::size_t other : {i - 1, i + 1}) {
        const PointRange& range = context.passes()[other].points;
        const bool first = (context.at(range.first) - here).norm() <= (context.at(range.last) - here).norm();
        const PointIndex nearest = first ? range.first : range.last;
        const Vec3 aside = context.at(nearest) - here;
        if ((aside - aside.dot(feed) * feed).norm() > start_reach * context.surface().step_over) return {};
        mean += 0.5 * aside;
        end.beside = context.line(nearest);
    }
    end.residual = mean.dot(feed);
    return end;
}

void check_starts(const LintContext& context, const LintRule& rule, std::vector<LintFinding>& findings) {
    std::vector<End> ends;
    std::vector<double> sizes;
    for (std::size_t i = 1; i + 1 < context.passes().size(); ++i) {
        for (const bool begins : {true, false}) {
            const End end = measure_end(context, i, begins);
            if (end.pass == nullptr) continue;
            ends.push_back(end);
            sizes.push_back(std::abs(end.residual));
        }
    }
    const double limit = std::max(context.thresholds().start_step_overs * context.surface().step_over,
                                  scatter_of_starts * (sizes.empty() ? 0 : quantile_below(sizes, 0.5)));
    for (const End& end : ends) {
        if (std::abs(end.residual) <= limit) continue;
        const PointIndex point = end.begins ? end.pass->ends.front() : end.pass->ends.back();
        const LineNumber number = end.begins ? context.line(end.pass->ends[1]) : context.line(point);
        findings.push_back({&rule,
                            Severity::warning,
                            number,
                            number,
                            end.beside,
                            end.beside,
                            end.pass->number,
                            point,
                            {context.at(point), {}},
                            std::abs(end.residual),
                            limit});
    }
}

// ---- messages ----

std::string spacing_message(const LintFinding& f, const std::string& found, const std::string& expected) {
    return fmt::format("points {} apart on pass {}, {} on the adjacent passes", found, f.pass, expected);
}

std::string chord_message(const LintFinding& f, const std::string& found, const std::string& expected) {
    if (f.severity == Severity::note)
        return fmt::format(
            "chord error of {} (95th percentile) on lines {} to {}: a controller tolerance above {} hides detail of the points",
            found, f.first_line, f.last_line, expected);
    return fmt::format("lines deviate from the curve by {} on pass {}; the controller's tolerance hides {}", found,
                       f.pass, expected);
}

std::string reversal_message(const LintFinding& f, const std::string& found, const std::string& expected) {
    return fmt::format("a line of {} runs back on pass {}; lines are usually {} long", found, f.pass, expected);
}

std::string feed_message(const LintFinding& f, const std::string& found, const std::string& expected) {
    return fmt::format("feed {} on pass {}, {} on the adjacent passes", found, f.pass, expected);
}

std::string start_message(const LintFinding& f, const std::string& found, const std::string& expected) {
    return fmt::format("pass {} ends {} out of line with the adjacent passes, more than {}", f.pass, found, expected);
}

constexpr LintUnit in_mm{"mm", 1, 3}, in_um{"µm", um_per_mm, 2}, in_mm_min{"mm/min", seconds_per_minute, 0};

constexpr auto lint_rule_table = std::to_array<LintRule>({
    {"point-spacing", "Points are closer together or farther apart than on the adjacent passes", in_mm, spacing_message,
     check_spacing},
    {"chord-error", "Lines deviate from the curve by more than the controller's tolerance can hide", in_um,
     chord_message, check_chords},
    {"reversed-segment", "A short line runs back against the lines around it", in_mm, reversal_message,
     check_reversals},
    {"feed-difference", "The feed differs from that of the adjacent passes", in_mm_min, feed_message, check_feeds},
    {"start-point", "The pass begins or ends out of line with its neighbours", in_mm, start_message, check_starts},
});

}  // namespace

std::span<const LintRule> lint_rules() { return lint_rule_table; }

std::string message_of(const LintFinding& finding) {
    const LintUnit& unit = finding.rule->unit;
    const auto shown = [&](double value) {
        return fmt::format("{:.{}f} {}", value * unit.per_inside, unit.digits, unit.name);
    };
    return finding.rule->message(finding, shown(finding.found), shown(finding.expected));
}

}  // namespace clsurf
