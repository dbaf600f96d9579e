#include "lint/lint.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "core/statistics.h"
#include "numeric/polyline.h"
#include "surface/path_location.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

constexpr double least_curvature = 1e-4;   ///< [1/mm] below it a line does not bend
constexpr std::size_t bridged_ends = 2;    ///< good points between bad ones that do not end a run
constexpr std::size_t fewest_uneven = 3;   ///< ends: a point or two that a collinear line saves are no harm
constexpr double reversing_cosine = -0.5;  ///< a line runs back that turns by more than 120°
constexpr double scatter_of_starts = 6;    ///< times the median absolute residual: more is out of line
constexpr double start_reach = 6;  ///< step-overs that the ends of neighbour passes may lie apart across the feed

struct RuleText {
    LintRule rule;
    std::string_view name, description;
};
constexpr std::array<RuleText, lint_rules> rule_texts{{
    {LintRule::point_spacing, "point-spacing", "Points lie closer or farther apart than on the neighbour passes"},
    {LintRule::chord_error, "chord-error", "Lines leave the curve by more than the controller's tolerance can hide"},
    {LintRule::reversed_segment, "reversed-segment", "A short line runs back against the lines around it"},
    {LintRule::feed_difference, "feed-difference", "Another feed than on the neighbour passes"},
    {LintRule::start_point, "start-point", "The pass begins or ends out of line with its neighbours"},
}};

class Linter {
public:
    Linter(const Program& program, const ProgrammedSurface& laid, const LintRules& rules)
        : motions_(program.motions),
          path_(program.motions, Vec3::Zero()),
          laid_(laid),
          surface_(laid.surface),
          rules_(rules),
          passes_(cut_passes(laid)) {
        report_.passes = static_cast<std::int64_t>(passes_.size());
        report_.step_over = surface_.step_over;
        report_.tolerance = rules.tolerance > 0 ? rules.tolerance : programmed_tolerance(program);
    }

    LintReport run() {
        measure_spacing();
        check_spacing();
        check_chords();
        check_reversals();
        check_feeds();
        check_starts();
        return std::move(report_);
    }

private:
    [[nodiscard]] Vec3 at(PointIndex point) const {
        return laid_.ends_motion(point) ? path_.end(laid_.motion_of(point)) : surface_.positions.absolute(point);
    }
    [[nodiscard]] LineNumber line(PointIndex point) const { return motions_.line[laid_.motion_of(point)]; }
    [[nodiscard]] bool is_line(PointIndex point) const {
        return motions_.kind[laid_.motion_of(point)] == MotionKind::feed;
    }

    void measure_spacing() {
        spacing_.assign(laid_.motion.size(), std::numeric_limits<float>::quiet_NaN());
        std::vector<double> lengths;
        for (const ProgrammedPass& pass : passes_) {
            for (std::size_t k = 1; k < pass.ends.size(); ++k) {
                const double length = path_.length(laid_.motion_of(pass.ends[k]));
                for (PointIndex i = pass.ends[k - 1] + 1; i <= pass.ends[k]; ++i)
                    spacing_[static_cast<std::size_t>(i)] = static_cast<float>(length);
                if (length > 0) lengths.push_back(length);
            }
            spacing_[static_cast<std::size_t>(pass.points.first)] =
                spacing_[static_cast<std::size_t>(pass.points.first + 1)];
        }
        report_.spacing = (lengths.empty() ? 0 : quantile_below(lengths, 0.5));
    }

    /// Direction of the feed at a point of a pass; 0: the tool stands.
    [[nodiscard]] Eigen::Vector3f feed_at(const ProgrammedPass& pass, PointIndex i) const {
        const Eigen::Vector3f chord = surface_.positions[std::min(pass.points.last, i + 1)] -
                                      surface_.positions[std::max(pass.points.first, i - 1)];
        return chord.squaredNorm() > 0 ? chord.normalized() : Eigen::Vector3f::Zero().eval();
    }

    /// The two neighbour passes at a point; nothing where one is not there.
    [[nodiscard]] std::optional<std::array<Station, 2>> both_sides(const ProgrammedPass& pass, PointIndex i) const {
        if (!surface_.neighbours.has(Side::left, i) || !surface_.neighbours.has(Side::right, i)) return std::nullopt;
        const Eigen::Vector3f feed = feed_at(pass, i);
        const Station here{i, 0};
        const std::array<Station, 2> both{beside(surface_, here, feed, Side::left),
                                          beside(surface_, here, feed, Side::right)};
        if (!both[0].exists() || !both[1].exists()) return std::nullopt;
        return both;
    }

    /// Runs of a pass's ends for which `measure` has a value. Told are the values farthest from 1, of spacings the medians.
    struct Measured {
        double found = 0, expected = 0;
        PointIndex beside = -1;
    };
    template <typename Measure>
    void find_runs_of(LintRule rule, const Measure& measure) {
        for (const ProgrammedPass& pass : passes_) {
            LintFinding finding;
            std::size_t good = 0, size = 0;
            double worst = 0;
            std::vector<double> found, expected;
            const auto close = [&] {
                // One pair of points that nearly coincide says little of a stretch.
                if (rule == LintRule::point_spacing && size > 0) {
                    finding.found = median(found);
                    finding.expected = median(expected);
                }
                found.clear();
                expected.clear();
                if (size >= (rule == LintRule::point_spacing ? fewest_uneven : 1)) report_.findings.push_back(finding);
                size = 0;
                worst = 0;
            };
            for (std::size_t k = 1; k < pass.ends.size(); ++k) {
                const PointIndex i = pass.ends[k];
                const std::optional<Measured> m = measure(pass, i);
                if (!m) {
                    if (++good > bridged_ends) close();
                    continue;
                }
                good = 0;
                if (size++ == 0) {
                    finding = {rule, Severity::warning, line(i), line(i), 0, 0, pass.number, i, {}, 0, 0};
                    finding.beside_first = finding.beside_last = m->beside >= 0 ? line(m->beside) : 0;
                }
                finding.last_line = line(i);
                found.push_back(m->found);
                expected.push_back(m->expected);
                if (m->beside >= 0) {
                    finding.beside_first = std::min(finding.beside_first, line(m->beside));
                    finding.beside_last = std::max(finding.beside_last, line(m->beside));
                }
                const double distance = std::abs(std::log(std::max(m->found, 1e-9) / std::max(m->expected, 1e-9)));
                if (distance >= worst) {
                    worst = distance;
                    finding.found = m->found;
                    finding.expected = m->expected;
                    finding.point = i;
                    finding.place.tip = at(i);
                }
            }
            close();
        }
    }

    /// A value that lies on one side of those of both neighbours by more than `ratio`.
    template <typename Read>
    [[nodiscard]] std::optional<Measured> against_both(const ProgrammedPass& pass, PointIndex i, double ratio,
                                                       const Read& read) const {
        const auto both = both_sides(pass, i);
        if (!both) return std::nullopt;
        const double mine = read(i);
        const PointIndex left = (*both)[0].nearest(), right = (*both)[1].nearest();
        const double low = std::min(read(left), read(right)), high = std::max(read(left), read(right));
        if (!(mine > 0) || !(low > 0)) return std::nullopt;
        if (mine * ratio < low) return Measured{mine, low, left};
        if (mine > ratio * high) return Measured{mine, high, left};
        return std::nullopt;
    }

    void check_spacing() {
        find_runs_of(LintRule::point_spacing, [&](const ProgrammedPass& pass, PointIndex i) {
            return against_both(pass, i, rules_.spacing_ratio, [&](PointIndex p) {
                return static_cast<double>(spacing_[static_cast<std::size_t>(p)]);
            });
        });
    }

    void check_feeds() {
        find_runs_of(LintRule::feed_difference, [&](const ProgrammedPass& pass, PointIndex i) {
            return against_both(pass, i, rules_.feed_ratio,
                                [&](PointIndex p) { return static_cast<double>(motions_.feed[laid_.motion_of(p)]); });
        });
    }

    void check_chords() {
        std::vector<double> errors;
        std::vector<std::pair<PointIndex, double>> of_point;
        for (const ProgrammedPass& pass : passes_) {
            std::vector<double> curvature(pass.ends.size(), 0);
            for (std::size_t k = 1; k + 1 < pass.ends.size(); ++k) {
                const double bend = three_point_curvature(at(pass.ends[k - 1]), at(pass.ends[k]), at(pass.ends[k + 1]));
                curvature[k] = is_corner(pass, k) ? 0 : bend;
            }
            for (std::size_t k = 2; k + 1 < pass.ends.size(); ++k) {
                if (!is_line(pass.ends[k])) continue;
                const double error =
                    chord_error_of(path_.length(laid_.motion_of(pass.ends[k])), curvature[k - 1], curvature[k]);
                if (curvature[k - 1] < least_curvature || curvature[k] < least_curvature) continue;
                errors.push_back(error);
                of_point.emplace_back(pass.ends[k], error);
            }
        }
        report_.chord_error = (errors.empty() ? 0 : quantile_below(errors, 0.95));
        if (report_.tolerance <= 0 || of_point.empty()) return;
        std::vector<float> error_at(laid_.motion.size(), 0);
        for (const auto& [point, error] : of_point)
            error_at[static_cast<std::size_t>(point)] = static_cast<float>(error);
        const double most = report_.tolerance / rules_.least_tolerance_ratio;
        find_runs_of(LintRule::chord_error, [&](const ProgrammedPass&, PointIndex i) -> std::optional<Measured> {
            const double error = error_at[static_cast<std::size_t>(i)];
            if (error <= most) return std::nullopt;
            return Measured{error, most, -1};
        });
        if (report_.chord_error > 0 && report_.tolerance > rules_.most_tolerance_ratio * report_.chord_error) {
            const ProgrammedPass& first = passes_.front();
            report_.findings.push_back({LintRule::chord_error,
                                        Severity::note,
                                        line(first.ends[1]),
                                        line(passes_.back().ends.back()),
                                        0,
                                        0,
                                        0,
                                        first.ends[0],
                                        {at(first.ends[0]), {}},
                                        report_.chord_error,
                                        report_.tolerance / rules_.most_tolerance_ratio});
        }
    }

    /// A turn by more than 30° is a corner, not a bend of a curve.
    [[nodiscard]] bool is_corner(const ProgrammedPass& pass, std::size_t k) const {
        constexpr double bending_cosine = 0.866;
        const Vec3 in = at(pass.ends[k]) - at(pass.ends[k - 1]), out = at(pass.ends[k + 1]) - at(pass.ends[k]);
        return in.dot(out) < bending_cosine * in.norm() * out.norm();
    }

    void check_reversals() {
        const double longest = rules_.reversed_share * report_.spacing;
        find_runs_of(
            LintRule::reversed_segment, [&](const ProgrammedPass& pass, PointIndex i) -> std::optional<Measured> {
                const auto k = static_cast<std::size_t>(std::lower_bound(pass.ends.begin(), pass.ends.end(), i) -
                                                        pass.ends.begin());
                if (k < 2 || k + 1 >= pass.ends.size()) return std::nullopt;
                const Vec3 before = at(pass.ends[k - 1]) - at(pass.ends[k - 2]), mine = at(i) - at(pass.ends[k - 1]),
                           after = at(pass.ends[k + 1]) - at(i);
                const double length = mine.norm();
                if (length <= 0 || length > longest || before.dot(after) <= 0) return std::nullopt;
                const bool back = mine.dot(before) < reversing_cosine * length * before.norm() &&
                                  mine.dot(after) < reversing_cosine * length * after.norm();
                return back ? std::optional(Measured{length, report_.spacing, -1}) : std::nullopt;
            });
    }

    /// An end of a pass, and the nearest ends of the passes before and after it in the program.
    struct End {
        const ProgrammedPass* pass = nullptr;
        bool begins = false;
        double residual = 0;  ///< [mm] along the feed
        LineNumber beside = 0;
    };

    void check_starts() {
        std::vector<End> ends;
        std::vector<double> sizes;
        for (std::size_t i = 1; i + 1 < passes_.size(); ++i) {
            for (const bool begins : {true, false}) {
                const End end = measure_end(i, begins);
                if (end.pass == nullptr) continue;
                ends.push_back(end);
                sizes.push_back(std::abs(end.residual));
            }
        }
        const double limit = std::max(rules_.start_step_overs * surface_.step_over,
                                      scatter_of_starts * (sizes.empty() ? 0 : quantile_below(sizes, 0.5)));
        for (const End& end : ends) {
            if (std::abs(end.residual) <= limit) continue;
            const PointIndex point = end.begins ? end.pass->ends.front() : end.pass->ends.back();
            const LineNumber number = end.begins ? line(end.pass->ends[1]) : line(point);
            report_.findings.push_back({LintRule::start_point,
                                        Severity::warning,
                                        number,
                                        number,
                                        end.beside,
                                        end.beside,
                                        end.pass->number,
                                        point,
                                        {at(point), {}},
                                        std::abs(end.residual),
                                        limit});
        }
    }

    [[nodiscard]] End measure_end(std::size_t i, bool begins) const {
        const ProgrammedPass& pass = passes_[i];
        const PointIndex mine = begins ? pass.points.first : pass.points.last;
        const Vec3 here = at(mine);
        const Vec3 feed = (at(begins ? std::min(mine + 1, pass.points.last) : mine) -
                           at(begins ? mine : std::max(mine - 1, pass.points.first)))
                              .normalized();
        Vec3 mean = Vec3::Zero();
        End end{&pass, begins, 0, 0};
        for (const std::size_t other : {i - 1, i + 1}) {
            const PointRange& range = passes_[other].points;
            const bool first = (at(range.first) - here).norm() <= (at(range.last) - here).norm();
            const PointIndex nearest = first ? range.first : range.last;
            const Vec3 aside = at(nearest) - here;
            if ((aside - aside.dot(feed) * feed).norm() > start_reach * surface_.step_over) return {};
            mean += 0.5 * aside;
            end.beside = line(nearest);
        }
        end.residual = mean.dot(feed);
        return end;
    }

    const Motions& motions_;
    Toolpath path_;
    const ProgrammedSurface& laid_;
    const ClSurface& surface_;
    const LintRules& rules_;
    std::vector<ProgrammedPass> passes_;
    std::vector<float> spacing_;  ///< [mm] length of the line that a point lies on
    LintReport report_;
};

}  // namespace

std::string_view name_of(LintRule rule) { return rule_texts[static_cast<std::size_t>(rule)].name; }
std::string_view description_of(LintRule rule) { return rule_texts[static_cast<std::size_t>(rule)].description; }

std::size_t LintReport::count(LintRule rule) const {
    return static_cast<std::size_t>(
        std::count_if(findings.begin(), findings.end(), [&](const LintFinding& f) { return f.rule == rule; }));
}

std::size_t LintReport::warnings() const {
    return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(),
                                                  [](const LintFinding& f) { return f.severity != Severity::note; }));
}

double programmed_tolerance(const Program& program) {
    double least = 0;
    for (const ProgramEvent& event : program.events) {
        if (!event.path_mode || event.path_mode->block_end != BlockEnd::rounded) continue;
        const double tolerance = event.path_mode->tolerance;
        if (std::isfinite(tolerance) && (least == 0 || tolerance < least)) least = tolerance;
    }
    return least;
}

LintReport lint(const Program& program, const ProgrammedSurface& laid, const LintRules& rules) {
    LintReport report = Linter(program, laid, rules).run();
    PointIndex finishing = 0;
    for (const Pass& pass : laid.surface.passes) finishing += pass.kind == PassKind::cut ? pass.size() : 0;
    const PointIndex all = finishing + laid.surface.not_finishing;
    if (all > 0) report.not_finishing = static_cast<double>(laid.surface.not_finishing) / static_cast<double>(all);
    // What lies beside what by chance says nothing.
    if (report.not_finishing > 0.5) report.findings.clear();
    std::stable_sort(report.findings.begin(), report.findings.end(), [](const LintFinding& a, const LintFinding& b) {
        return std::pair(a.rule, a.first_line) < std::pair(b.rule, b.first_line);
    });
    return report;
}

}  // namespace clsurf
