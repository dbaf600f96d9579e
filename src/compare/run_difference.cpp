#include "compare/run_difference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/block.h"
#include "core/not_finite.h"
#include "core/point_count.h"
#include "core/statistics.h"
#include "field/field_set.h"
#include "log/quantum.h"
#include "surface/smoothing_segments.h"

namespace clsurf {
namespace {

constexpr double smoothing_seconds = 0.015;   ///< window of the mean of following errors and heights
constexpr double jerk_seconds = 0.050;        ///< window of the root mean square of the jerk
constexpr double jump_seconds = 0.0125;       ///< half a window of derivatives, plus a record
constexpr double jerk_jump_seconds = 0.0475;  ///< half of both windows of the jerk, plus a record
constexpr PointIndex feed_reach = 8;          ///< points before and after one that determine the feed there
constexpr double least_feed = 1e-4;           ///< [mm] least arc length for a direction
constexpr float least_tilt = 0.1F;  ///< sine of the angle between feed and Z: a steeper feed has no upper side
constexpr std::int64_t points_for_usual = 200'000;  ///< points for the computation of usual values

constexpr auto quantity_table = std::to_array<RunQuantityInfo>({
    {RunQuantity::speed, "speed", "Path speed", unit::mm_min, "mm_min"},
    {RunQuantity::acceleration, "acceleration", "Acceleration", unit::mm_s2, "mm_s2"},
    {RunQuantity::following_error, "lag", "Lag along the feed", unit::um, "um"},
    {RunQuantity::height, "height", "Height of the path", unit::um, "um"},
    {RunQuantity::jerk, "jerk", "RMS jerk over 50 ms", unit::mm_s3, "mm_s3"},
});

/// The unit vector of the feed at a point of a trajectory; NaN if the tool rests.
Vec3 feed_at(const Trajectory& path, PointIndex i) {
    for (PointIndex reach = 1; reach <= feed_reach; reach *= 2) {
        const Vec3 chord = path.at(std::min(path.count - 1, i + reach)) - path.at(std::max<PointIndex>(0, i - reach));
        const double length = chord.norm();
        if (length > least_feed) return chord / length;
    }
    return Vec3::Constant(missing<float>);
}

/// How far the measured positions trail the commanded ones along the feed [mm].
Column<float> following_errors_of(const ComparedRun& run) {
    Column<float> errors(static_cast<std::size_t>(run.path.count));
    for_each_block(run.path.count, [&](PointIndex first, PointIndex last) {
        for (PointIndex i = first; i < last; ++i) {
            const Vec3 behind = run.commanded->at(i) - run.measured->at(i);
            errors[static_cast<std::size_t>(i)] = static_cast<float>(behind.dot(feed_at(*run.commanded, i)));
        }
    });
    return errors;
}

/// The upward normal of the CL surface, or of the path if a pass has no adjacent one.
Eigen::Vector3f normal_at(const ClSurface& surface, PointIndex i, const Eigen::Vector3f& feed) {
    const Positions& p = surface.positions;
    const PathLocation left = adjacent_location(surface, {i, 0}, feed, Side::left);
    const PathLocation right = adjacent_location(surface, {i, 0}, feed, Side::right);
    const Eigen::Vector3f a = left.exists() ? position_at(p, left) : p[i];
    const Eigen::Vector3f b = right.exists() ? position_at(p, right) : p[i];
    const Eigen::Vector3f across = feed.cross(a - b);
    if (across.norm() > 0) return across.normalized();
    const Eigen::Vector3f up = Eigen::Vector3f::UnitZ() - feed.z() * feed;
    return up.norm() > least_tilt ? Eigen::Vector3f(up.normalized()) : Eigen::Vector3f::Constant(missing<float>);
}

/// A position between two points on the cubic through the surrounding points (Catmull, Rom 1974). A chord would have an error
/// of a T²/8, which is 5 µm at 600 mm/s² and 8 ms.
Vec3 position_between(const Trajectory& path, const PathLocation& at) {
    const Vec3 p1 = path.at(at.point);
    if (at.fraction == 0) return p1;
    const double f = at.fraction;
    const Vec3 p2 = path.at(at.point + 1);
    const Vec3 step = p2 - p1;
    const Vec3 before = 0.5 * (p2 - path.at(std::max<PointIndex>(0, at.point - 1))) - step;
    const Vec3 after = 0.5 * (path.at(std::min(path.count - 1, at.point + 2)) - p1) - step;
    const Vec3 chord = p1 + f * step;
    const Vec3 bend = f * (1 - f) * ((1 - f) * before - f * after);
    return bend.allFinite() ? Vec3(chord + bend) : chord;
}

/// Height of `b` above `a`, normal to A's surface [mm].
Column<float> heights_of(const Trajectory& a, const Trajectory& b, const RunAlignment& alignment,
                         const ClSurface& surface, const Trajectory& path) {
    Column<float> heights(static_cast<std::size_t>(a.count));
    for_each_block(a.count, [&](PointIndex first, PointIndex last) {
        for (PointIndex i = first; i < last; ++i) {
            float& height = heights[static_cast<std::size_t>(i)];
            height = missing<float>;
            const PathLocation& at = alignment.locations[static_cast<std::size_t>(i)];
            if (!at.exists()) continue;
            const Vec3 feed = feed_at(path, i);
            if (!feed.allFinite()) continue;
            height = static_cast<float>(
                (position_between(b, at) - a.at(i)).dot(normal_at(surface, i, feed.cast<float>()).cast<double>()));
        }
    });
    return heights;
}

/// values := B's values at the locations minus A's.
void subtract(const Column<float>& of_b, const RunAlignment& alignment, Column<float>& values) {
    for_each_block(static_cast<PointIndex>(values.size()), [&](PointIndex first, PointIndex last) {
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
            const PathLocation& at = alignment.locations[i];
            values[i] = at.exists() ? interpolate(of_b, at) - values[i] : missing<float>;
        }
    });
}

/// Means of known values over `points` around each point, inside the sections. O(points).
void smooth(Column<float>& values, const std::vector<PointRange>& sections, PointIndex points) {
    const PointIndex half = points / 2;
    std::vector<float> raw;
    for (const PointRange& section : sections) {
        raw.assign(values.begin() + section.first, values.begin() + section.last + 1);
        double sum = 0;
        PointIndex known = 0;
        PointIndex begin = 0;
        PointIndex end = 0;
        const PointIndex size = section.size();
        const auto take = [&](PointIndex k, int sign) {
            const float value = raw[static_cast<std::size_t>(k)];
            if (!(value == value)) return;
            sum += sign * static_cast<double>(value);
            known += sign;
        };
        for (PointIndex k = 0; k < size; ++k) {
            // The window shrinks symmetrically towards the ends.
            const PointIndex reach = std::min({half, k, size - 1 - k});
            while (end <= k + reach) take(end++, +1);
            while (begin < k - reach) take(begin++, -1);
            float& value = values[static_cast<std::size_t>(section.first + k)];
            if (value == value)
                value = known > 0 ? static_cast<float>(sum / static_cast<double>(known)) : missing<float>;
        }
    }
}

/// The root mean square of the jerk around each point of a run.
Column<float> rough_motion(const FieldSet& fields, double period) {
    Column<float> values = fields.get("jerk").values;
    const auto count = static_cast<PointIndex>(values.size());
    const auto for_all = [&](auto&& f) {
        for_each_block(count, [&](PointIndex first, PointIndex last) {
            for (PointIndex i = first; i < last; ++i) f(values[static_cast<std::size_t>(i)]);
        });
    };
    for_all([](float& value) { value *= value; });
    smooth(values, {{0, count - 1}}, points_in(jerk_seconds, period));
    for_all([](float& value) { value = std::sqrt(std::max(0.0F, value)); });
    return values;
}

/// Percentile of all that is compared, finishing or not; rapids are excluded.
float percentile_at_feed(const Column<float>& values, const Passes& passes, double p) {
    Column<float> sampled;
    PointIndex cutting = 0;
    for (const Pass& pass : passes) cutting += pass.kind != PassKind::rapid ? pass.size() : 0;
    const PointIndex step = std::max<PointIndex>(1, cutting / points_for_usual);
    for (const Pass& pass : passes) {
        if (pass.kind == PassKind::rapid) continue;
        for (PointIndex i = pass.first; i <= pass.last; i += step) {
            const float value = values[static_cast<std::size_t>(i)];
            if (std::isfinite(value)) sampled.push_back(value);
        }
    }
    return sampled.empty() ? 0.0F : quantile_below(sampled, p);
}

/// The resolution of the finest axis. An axis that hardly moves would seem to have a coarse one.
float quantum_of(const Trajectory& path) {
    double finest = 0;
    for (const ChannelView& axis : path.axes) {
        const double quantum = clsurf::quantum_of(axis);
        if (quantum > 0 && (finest == 0 || quantum < finest)) finest = quantum;
    }
    return static_cast<float>(finest);
}

/// Excludes rapids from the comparison.
void leave_out_rapids(const Passes& passes, RunDifferences& differences) {
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::rapid) continue;
        for (Column<float>& values : differences.of) {
            if (!values.empty()) std::fill(values.begin() + pass.first, values.begin() + pass.last + 1, missing<float>);
        }
    }
}

/// Where the path of a run jumps (it was stopped and restarted from an earlier line), its derivatives mean nothing.
void leave_out_jumps(const std::vector<PointRange>& sections, double period, RunDifferences& differences) {
    const auto leave_out = [&](RunQuantity q, double seconds) {
        Column<float>& values = differences.of[index_of(q)];
        const auto reach = static_cast<PointIndex>(std::ceil(std::min(seconds / period, 1e6))) + 1;
        for (std::size_t k = 1; k < sections.size(); ++k) {
            const PointRange &ends = sections[k - 1], &begins = sections[k];
            const PointRange before{std::max(ends.first, ends.last - reach + 1), ends.last};
            const PointRange after{begins.first, std::min(begins.last, begins.first + reach - 1)};
            for (const PointRange& range : {before, after})
                std::fill(values.begin() + range.first, values.begin() + range.last + 1, missing<float>);
        }
    };
    leave_out(RunQuantity::speed, jump_seconds);
    leave_out(RunQuantity::acceleration, jump_seconds);
    leave_out(RunQuantity::jerk, jerk_jump_seconds);
}

/// The whole log as one pass: windows end only at gaps in time, equally in both runs.
Passes whole(const Trajectory& path) {
    Passes passes;
    passes.push_back({0, path.count - 1, PassKind::cut});
    return passes;
}

/// The same windows for both runs, as the run with the longer period requires.
Derivation derivation_of(const ComparedRun& run, const ComparedRun& other, const Passes& passes) {
    return {estimate_motion(run.derivative, *run.log, run.path, passes), other.log->period};
}

/// Effect of the steps of the positions of a run on its jerk [mm/s³].
float jerk_of_steps(const ComparedRun& run, const Derivation& derivation) {
    return quantum_of(run.path) * static_cast<float>(derivation.filter(3, run.log->period).step_response());
}

/// The shortest window [s] in which the steps of the positions of both runs have little effect on the jerk; 0: the usual one. A
/// window hides shorter vibrations.
double shortest_jerk_window(const ComparedRun& a, const ComparedRun& b, float usual_jerk) {
    constexpr float little = 0.05F;
    constexpr double growth = 1.4;
    const double coarser = std::max(a.log->period, b.log->period);
    const DerivativeFilter usual = derivative_filter(3, coarser);
    for (double points = usual.order + 1; points < usual.points - 1; points *= growth) {
        Derivation of_a, of_b;
        of_a.jerk_window = of_b.jerk_window = points * coarser;
        if (jerk_of_steps(a, of_a) <= little * usual_jerk && jerk_of_steps(b, of_b) <= little * usual_jerk)
            return points * coarser;
    }
    return 0;
}

/// A run with the fields that are compared.
struct DerivedRun {
    const ComparedRun& run;
    Passes passes;
    Derivation derivation;
    FieldSet fields;

    DerivedRun(const ComparedRun& one, const ComparedRun& other)
        : run(one),
          passes(whole(one.path)),
          derivation(derivation_of(one, other, passes)),
          fields(*one.log, one.path, passes, derivation) {}

    [[nodiscard]] Column<float> roughness() const {
        const double period = run.log->period;
        return derivation.jerk_window > 0 ? rough_motion(FieldSet(*run.log, run.path, passes, derivation), period)
                                          : rough_motion(fields, period);
    }
};

/// Compares the jerk of both runs, in the shortest window that their resolution allows.
void compare_roughness(DerivedRun& a, DerivedRun& b, const ClSurface& surface, RunDifferences& out) {
    const auto take_a = [&] {
        out.jerk_of_a = a.roughness();
        out.usual_jerk = percentile_at_feed(out.jerk_of_a, surface.passes, 0.95);
    };
    take_a();
    const bool by_window = !a.derivation.estimate && !b.derivation.estimate;
    if (const double window = by_window ? shortest_jerk_window(a.run, b.run, out.usual_jerk) : 0; window > 0) {
        a.derivation.jerk_window = b.derivation.jerk_window = window;
        take_a();
    }
    Column<float>& jerk = out.of[index_of(RunQuantity::jerk)];
    jerk = out.jerk_of_a;
    subtract(b.roughness(), out.alignment, jerk);
    out.jerk_tolerance = out.rules.usual_jerk * out.usual_jerk +
                         std::max(jerk_of_steps(a.run, a.derivation), jerk_of_steps(b.run, b.derivation));
}

void compare_motion(const ComparedRun& a, const ComparedRun& b, const ClSurface& surface, RunDifferences& out) {
    DerivedRun of_a(a, b), of_b(b, a);
    out.speed_of_a = of_a.fields.get("speed").values;
    out.usual_speed = percentile_at_feed(out.speed_of_a, surface.passes, 0.95);
    out.of[index_of(RunQuantity::speed)] = out.speed_of_a;
    subtract(of_b.fields.get("speed").values, out.alignment, out.of[index_of(RunQuantity::speed)]);
    Column<float>& acceleration = out.of[index_of(RunQuantity::acceleration)];
    acceleration = of_a.fields.get("acceleration").values;
    out.usual_acceleration = percentile_at_feed(acceleration, surface.passes, 0.99);
    subtract(of_b.fields.get("acceleration").values, out.alignment, acceleration);
    compare_roughness(of_a, of_b, surface, out);
}

}  // namespace

std::span<const RunQuantityInfo> run_quantity_table() { return quantity_table; }

float RunDifferences::speed_base(PointIndex i) const {
    const float own = speed_of_a[static_cast<std::size_t>(i)];
    return std::max(own == own ? own : 0.0F, rules.least_speed * usual_speed);
}

float RunDifferences::threshold_at(RunQuantity q, PointIndex i) const {
    const auto at = static_cast<std::size_t>(i);
    switch (q) {
        case RunQuantity::speed: return rules.speed * speed_base(i) + speed_tolerance;
        case RunQuantity::jerk: {
            const float smoother = jerk_of_a[at] + std::min(0.0F, of[index_of(q)][at]);
            return rules.jerk * smoother + jerk_tolerance;
        }
        default: return threshold[index_of(q)];
    }
}

RunDifferences compare_runs(const ComparedRun& a, const ClSurface& surface, const ComparedRun& b,
                            const RunThresholds& rules) {
    RunDifferences out;
    out.rules = rules;
    {
        const Positions path_b = gather(b.path);
        out.alignment = align_runs(surface.positions, path_b);
    }
    compare_motion(a, b, surface, out);
    const PointIndex window = points_in(smoothing_seconds, a.log->period);
    float error_quantum = 0;
    if (a.commanded && a.measured && b.commanded && b.measured) {
        Column<float>& following_error = out.of[index_of(RunQuantity::following_error)];
        following_error = following_errors_of(a);
        subtract(following_errors_of(b), out.alignment, following_error);
        smooth(following_error, out.alignment.sections, window);
        for (const ComparedRun* run : {&a, &b})
            error_quantum = std::max({error_quantum, quantum_of(*run->commanded), quantum_of(*run->measured)});
    }
    const bool measured = a.truest && b.truest;
    const Trajectory& height_a = measured ? *a.truest : a.path;
    const Trajectory& height_b = measured ? *b.truest : b.path;
    Column<float>& height = out.of[index_of(RunQuantity::height)];
    if (measured) {
        const RunAlignment alignment = align_runs(gather(height_a), gather(height_b));
        height = heights_of(height_a, height_b, alignment, surface, a.path);
        smooth(height, alignment.sections, window);
    } else {
        height = heights_of(height_a, height_b, out.alignment, surface, a.path);
        smooth(height, out.alignment.sections, window);
    }
    const float height_quantum = std::max(quantum_of(height_a), quantum_of(height_b));
    out.speed_tolerance =
        rules.period * static_cast<float>(std::max(a.log->period, b.log->period)) * out.usual_acceleration;
    out.threshold = {rules.speed * out.usual_speed + out.speed_tolerance, rules.acceleration * out.usual_acceleration,
                     std::max(rules.height, rules.following_error_quanta * error_quantum),
                     std::max(rules.height, rules.height_quanta * height_quantum),
                     rules.jerk * out.usual_jerk + out.jerk_tolerance};
    leave_out_rapids(surface.passes, out);
    leave_out_jumps(out.alignment.sections, std::min(a.log->period, b.log->period), out);
    return out;
}

}  // namespace clsurf
