#include <algorithm>
#include <cmath>
#include <limits>

#include "core/statistics.h"
#include "lint/lint.h"
#include "lint/lint_rule.h"
#include "numeric/polyline.h"

namespace clsurf {
namespace {

constexpr double least_curvature = 1e-4;  ///< [1/mm] below it a line counts as straight
constexpr std::size_t bridged_ends = 2;   ///< greatest number of good points within a run

/// Direction of the feed at a point of a pass; 0: the tool is at rest.
Eigen::Vector3f direction_at(const Positions& positions, const ProgrammedPass& pass, PointIndex i) {
    const Eigen::Vector3f chord =
        positions[std::min(pass.points.last, i + 1)] - positions[std::max(pass.points.first, i - 1)];
    return chord.squaredNorm() > 0 ? chord.normalized() : Eigen::Vector3f::Zero().eval();
}

}  // namespace

LintContext::LintContext(const Program& program, const ProgrammedSurface& programmed, const LintThresholds& thresholds)
    : motions_(program.motions),
      path_(program.motions, Vec3::Zero()),
      programmed_(programmed),
      thresholds_(thresholds),
      passes_(cut_passes(programmed)),
      tolerance_(thresholds.tolerance > 0 ? thresholds.tolerance : programmed_tolerance(program)) {
    measure_spacing();
    measure_chords();
}

double LintContext::spacing_at(PointIndex point) const { return spacing_[static_cast<std::size_t>(point)]; }

double LintContext::chord_error_at(PointIndex point) const { return chord_error_[static_cast<std::size_t>(point)]; }

Vec3 LintContext::at(PointIndex point) const {
    return programmed_.ends_motion(point) ? path_.end(programmed_.motion_of(point))
                                          : surface().positions.absolute(point);
}

void LintContext::measure_spacing() {
    spacing_.assign(programmed_.motion.size(), std::numeric_limits<float>::quiet_NaN());
    std::vector<double> lengths;
    for (const ProgrammedPass& pass : passes_) {
        for (std::size_t k = 1; k < pass.ends.size(); ++k) {
            const double length = path_.length(programmed_.motion_of(pass.ends[k]));
            for (PointIndex i = pass.ends[k - 1] + 1; i <= pass.ends[k]; ++i)
                spacing_[static_cast<std::size_t>(i)] = static_cast<float>(length);
            if (length > 0) lengths.push_back(length);
        }
        spacing_[static_cast<std::size_t>(pass.points.first)] =
            spacing_[static_cast<std::size_t>(pass.points.first + 1)];
    }
    usual_spacing_ = (lengths.empty() ? 0 : quantile_below(lengths, 0.5));
}

void LintContext::measure_chords() {
    std::vector<double> errors;
    std::vector<std::pair<PointIndex, double>> of_point;
    for (const ProgrammedPass& pass : passes_) {
        std::vector<double> curvature(pass.ends.size(), 0);
        for (std::size_t k = 1; k + 1 < pass.ends.size(); ++k) {
            const double measured = three_point_curvature(at(pass.ends[k - 1]), at(pass.ends[k]), at(pass.ends[k + 1]));
            curvature[k] = is_corner(pass, k) ? 0 : measured;
        }
        for (std::size_t k = 2; k + 1 < pass.ends.size(); ++k) {
            if (!is_line(pass.ends[k])) continue;
            const double error =
                chord_error_of(path_.length(programmed_.motion_of(pass.ends[k])), curvature[k - 1], curvature[k]);
            if (curvature[k - 1] < least_curvature || curvature[k] < least_curvature) continue;
            errors.push_back(error);
            of_point.emplace_back(pass.ends[k], error);
        }
    }
    usual_chord_error_ = (errors.empty() ? 0 : quantile_below(errors, 0.95));
    chord_error_.assign(programmed_.motion.size(), 0);
    for (const auto& [point, error] : of_point)
        chord_error_[static_cast<std::size_t>(point)] = static_cast<float>(error);
}

bool LintContext::is_corner(const ProgrammedPass& pass, std::size_t k) const {
    constexpr double bending_cosine = 0.866;  // cos 30°
    const Vec3 in = at(pass.ends[k]) - at(pass.ends[k - 1]), out = at(pass.ends[k + 1]) - at(pass.ends[k]);
    return in.dot(out) < bending_cosine * in.norm() * out.norm();
}

std::optional<std::array<PathLocation, 2>> LintContext::both_sides(const ProgrammedPass& pass, PointIndex point) const {
    if (!surface().neighbours.has(Side::left, point) || !surface().neighbours.has(Side::right, point))
        return std::nullopt;
    const Eigen::Vector3f feed = direction_at(surface().positions, pass, point);
    const PathLocation here{point, 0};
    const std::array<PathLocation, 2> both{adjacent_location(surface(), here, feed, Side::left),
                                           adjacent_location(surface(), here, feed, Side::right)};
    if (!both[0].exists() || !both[1].exists()) return std::nullopt;
    return both;
}

std::optional<LintMeasure> LintContext::against_both(const ProgrammedPass& pass, PointIndex point, double ratio,
                                                     const std::function<double(PointIndex)>& read) const {
    const auto both = both_sides(pass, point);
    if (!both) return std::nullopt;
    const double mine = read(point);
    const PointIndex left = (*both)[0].nearest(), right = (*both)[1].nearest();
    const double low = std::min(read(left), read(right)), high = std::max(read(left), read(right));
    if (!(mine > 0) || !(low > 0)) return std::nullopt;
    if (mine * ratio < low) return LintMeasure{mine, low, left};
    if (mine > ratio * high) return LintMeasure{mine, high, left};
    return std::nullopt;
}

void find_runs(const LintContext& context, const LintRule& rule, const LintRunRule& runs,
               const std::function<std::optional<LintMeasure>(const ProgrammedPass&, PointIndex)>& measure,
               std::vector<LintFinding>& findings) {
    for (const ProgrammedPass& pass : context.passes()) {
        LintFinding finding;
        std::size_t good = 0, size = 0;
        double worst = 0;
        std::vector<double> found, expected;
        const auto close = [&] {
            // One pair of points that nearly coincide is not typical of a section.
            if (runs.medians && size > 0) {
                finding.found = median(found);
                finding.expected = median(expected);
            }
            found.clear();
            expected.clear();
            if (size >= runs.fewest && size > 0) findings.push_back(finding);
            size = 0;
            worst = 0;
        };
        for (std::size_t k = 1; k < pass.ends.size(); ++k) {
            const PointIndex i = pass.ends[k];
            const std::optional<LintMeasure> m = measure(pass, i);
            if (!m) {
                if (++good > bridged_ends) close();
                continue;
            }
            good = 0;
            if (size++ == 0) {
                finding = {&rule, Severity::warning, context.line(i), context.line(i), 0, 0, pass.number, i, {}, 0, 0};
                finding.beside_first = finding.beside_last = m->beside >= 0 ? context.line(m->beside) : 0;
            }
            finding.last_line = context.line(i);
            found.push_back(m->found);
            expected.push_back(m->expected);
            if (m->beside >= 0) {
                finding.beside_first = std::min(finding.beside_first, context.line(m->beside));
                finding.beside_last = std::max(finding.beside_last, context.line(m->beside));
            }
            const double distance = std::abs(std::log(std::max(m->found, 1e-9) / std::max(m->expected, 1e-9)));
            if (distance >= worst) {
                worst = distance;
                finding.found = m->found;
                finding.expected = m->expected;
                finding.point = i;
                finding.place.tip = context.at(i);
            }
        }
        close();
    }
}

}  // namespace clsurf
