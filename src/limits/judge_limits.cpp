#include "limits/judge_limits.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "core/not_finite.h"
#include "core/statistics.h"
#include "limits/finding_runs.h"
#include "limits/line_lead.h"
#include "limits/path_tolerance.h"
#include "log/quantum.h"

namespace clsurf {
namespace {

/// If a steady excess is as small as its uncertainty, some records do not show it. On circles 2 % too fast, such gaps
/// lasted up to 0.06 s. Excesses separated by longer gaps are at different places.
constexpr double longest_gap = 0.1;  // [s]

/// A limit and its comparison with records.
struct Comparison {
    StatedLimit limit;
    std::function<RecordRuns(PointRange, const MotionWindow&)> judge;
};

Comparison compare_motion(const StatedLimit& limit, const CommandedMotion& motion) {
    return {limit, [limit, strides = strides_for(limit, motion)](PointRange points, const MotionWindow& window) {
                const std::vector<MeasuredValue> measured = window.measure(limit, strides);
                RunFinder finder(limit);
                for (std::size_t i = 0; i < measured.size(); ++i)
                    finder.add(points.first + static_cast<PointIndex>(i), measured[i], limit.value);
                return finder.finish();
            }};
}

Comparison compare_following_error(const StatedLimit& limit, const ChannelView& commanded,
                                   const ChannelView& measured) {
    const double rounding = 0.5 * (resolution_of(commanded) + resolution_of(measured));
    return {limit, [=](PointRange points, const MotionWindow&) {
                std::vector<double> c(static_cast<std::size_t>(points.size())), m(c.size());
                copy_block(commanded, points.first, c);
                copy_block(measured, points.first, m);
                RunFinder finder(limit);
                for (std::size_t i = 0; i < c.size(); ++i)
                    finder.add(points.first + static_cast<PointIndex>(i), {std::abs(c[i] - m[i]), rounding, rounding},
                               limit.value);
                return finder.finish();
            }};
}

/// Contribution of the program's rounding to a distance from its path [mm]. Half a step of four decimals
/// (docs/limits.md#how-certain).
constexpr double program_rounding = 5e-5;

/// Whether the offset was stated; a fitted one has other digits.
bool is_stated(const Trajectory& path) {
    const Vec3 steps = path.offset * um_per_mm;
    return path.turn.isIdentity() && (steps - steps.array().round().matrix()).cwiseAbs().maxCoeff() < 1e-6;
}

/// Possible offset of the log's zero from the program's zero: half of all records are nearer to the path.
double pose_error(const Trajectory& path, const PathTolerance& tolerance) {
    if (is_stated(path)) return 0;
    const PointIndex count = path.count;
    constexpr PointIndex section_count = 32, section_length = 512;  // records
    Column<double> distances;
    for (PointIndex s = 0; s < section_count; ++s) {
        const PointIndex first = std::max<PointIndex>(0, count - section_length) * s / (section_count - 1);
        for (const PathDeviation& at : tolerance.read({first, std::min(count, first + section_length) - 1})) {
            if (std::isfinite(at.distance)) distances.push_back(at.distance);
        }
    }
    return distances.empty() ? 0 : quantile_below(distances, 0.5);
}

Comparison compare_tolerance(const StatedLimit& limit, const CommandedMotion& motion, const PathTolerance& tolerance) {
    const double error = 0.5 * motion.resolution() + program_rounding + pose_error(motion.path(), tolerance);
    return {limit, [limit, error, &tolerance](PointRange points, const MotionWindow&) {
                const std::vector<PathDeviation> deviations = tolerance.read(points);
                RunFinder finder(limit);
                for (std::size_t i = 0; i < deviations.size(); ++i) {
                    const bool is_held = deviations[i].tolerance < infinite;
                    finder.add(points.first + static_cast<PointIndex>(i),
                               {is_held ? deviations[i].distance : missing<double>, error, error},
                               deviations[i].tolerance);
                }
                return finder.finish();
            }};
}

class Judge {
public:
    Judge(const LimitedRun& run, std::span<const StatedLimit> limits) : run_(run), motion_(run.log, run.path, limits) {
        report_.line_lead = find_line_lead(run.path, run.program, run.lines);
        for (const StatedLimit& limit : limits) prepare(limit);
        prepare_tolerance(limits);
    }

    LimitReport judge() {
        const PointIndex records = run_.log.records;
        const auto blocks = static_cast<std::size_t>((records + block_points - 1) / block_points);
        std::vector<std::vector<RecordRuns>> found(blocks);
        std::vector<std::vector<PointIndex>> broken(blocks);
        for_each_block(records, [&](PointIndex first, PointIndex end) {
            const auto block = static_cast<std::size_t>(first / block_points);
            const PointRange points{first, end - 1};
            const MotionWindow window(motion_, points);
            for (const Comparison& comparison : comparisons_) found[block].push_back(comparison.judge(points, window));
            broken[block] = window.broken();
        });
        for (std::size_t c = 0; c < comparisons_.size(); ++c) {
            RecordRuns all;
            all.greatest.limit = comparisons_[c].limit;
            for (const std::vector<RecordRuns>& block : found) all.append(block[c]);
            if (!all.any) continue;
            report_.judged.push_back(all.greatest);
            const auto gap = static_cast<PointIndex>(std::llround(longest_gap / run_.log.period));
            for (LimitFinding& finding : findings_of(all, gap, [&](PointIndex point) { return line_of(point); }))
                report_.findings.push_back(placed(std::move(finding)));
        }
        sort_findings(report_.findings);
        note_broken(broken);
        return std::move(report_);
    }

private:
    void prepare(const StatedLimit& limit) {
        if (limit.quantity == LimitedQuantity::tolerance) return;
        const CommandedAxis* axis = motion_.find(limit.axis);
        const bool there = limit.axis == 0 ? !motion_.axes().empty() : axis != nullptr;
        if (!there) return note_missing(limit, "no commanded positions");
        if (limit.quantity != LimitedQuantity::following_error) {
            comparisons_.push_back(compare_motion(limit, motion_));
            return;
        }
        const Channel* feedback = run_.log.find(std::string("fb.") + limit.axis);
        if (feedback == nullptr) return note_missing(limit, "no feedback positions");
        comparisons_.push_back(compare_following_error(limit, axis->positions, feedback->values));
    }

    /// The program's tolerances apply on any machine.
    void prepare_tolerance(std::span<const StatedLimit> limits) {
        const auto own = std::find_if(limits.begin(), limits.end(), [](const StatedLimit& limit) {
            return limit.quantity == LimitedQuantity::tolerance;
        });
        // The path of a tilting tool is known only as chords; lines of another program cannot be compared.
        if (run_.program.motions.size() == 0 || motion_.has_tip() || motion_.axes().empty() ||
            !run_.lines.match().doubts().empty())
            return;
        tolerance_.emplace(run_.path, run_.program, run_.lines, report_.line_lead,
                           own == limits.end() ? std::nullopt : std::optional<double>(own->value));
        if (!tolerance_->any()) return;
        const StatedLimit limit{LimitedQuantity::tolerance, 0, tolerance_->least()};
        comparisons_.push_back(compare_tolerance(limit, motion_, *tolerance_));
    }

    LineNumber line_of(PointIndex point) const {
        return run_.lines.line_at(std::max<PointIndex>(0, point - report_.line_lead));
    }

    LimitFinding placed(LimitFinding finding) const {
        finding.time = run_.log.time_of(finding.point);
        finding.duration = static_cast<double>(finding.points.size()) * run_.log.period;
        finding.line = line_of(finding.point);
        finding.tip = run_.path.at(finding.point);
        return finding;
    }

    void note_missing(const StatedLimit& limit, std::string_view what) {
        report_.diagnostics.add({Severity::note,
                                 "limits.not-judged",
                                 Place::of_file(run_.log.name),
                                 fmt::format("the limit of the {} is not judged: {}", words_of(limit), what),
                                 {}});
    }

    void note_broken(const std::vector<std::vector<PointIndex>>& broken) {
        PointIndex first = -1;
        for (const std::vector<PointIndex>& block : broken) {
            if (first < 0 && !block.empty()) first = block.front();
            report_.broken_steps += static_cast<PointIndex>(block.size());
        }
        if (first < 0) return;
        report_.diagnostics.add(
            {Severity::warning,
             "limits.lost-records",
             Place::of_point(run_.log.name, first),
             fmt::format("{} {} like lost or repeated records: not compared with limits; the first is here",
                         report_.broken_steps, report_.broken_steps == 1 ? "step looks" : "steps look"),
             {}});
    }

    LimitedRun run_;
    CommandedMotion motion_;
    std::optional<PathTolerance> tolerance_;
    std::vector<Comparison> comparisons_;
    LimitReport report_;
};

}  // namespace

LimitReport judge_limits(const LimitedRun& run, std::span<const StatedLimit> limits) {
    return Judge(run, limits).judge();
}

}  // namespace clsurf
