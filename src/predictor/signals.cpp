#include "predictor/signals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/block.h"
#include "core/not_finite.h"
#include "core/point_count.h"
#include "core/point_ranges.h"
#include "core/statistics.h"
#include "log/health.h"
#include "log/placeholder.h"
#include "log/quantum.h"
#include "predictor/position_noise.h"
#include "predictor/zone_marker.h"
#include "surface/path_location.h"
#include "toolpath/arc_length.h"

namespace clsurf {
namespace {

// speed_seconds, speed_arc_length, acceleration_windows, height_window, least_upward, least_chord_share:
// docs/design/predictor.md#1-compare-adjacent-passes.
constexpr double speed_seconds = 0.010;  ///< longest window: of an oscillation of 20 ms it keeps four fifths …
constexpr double speed_arc_length =
    0.4;  ///< [mm] … and on fast passes, of one of 0.8 mm, because marks are seen by their length
// 1.5 steps of rounding in a window of 150 steps (docs/design/predictor.md#2-apply-thresholds).
constexpr double speed_steps = 150;  ///< steps of the positions in the window: rounding is then 1 % of the speed
// Stated in docs/design/predictor.md#2-apply-thresholds.
constexpr double scatter_deviations = 6;    ///< standard deviations: largest difference of two passes by scatter alone
constexpr double acceleration_windows = 2;  ///< times the window of the speed, for accelerations of slow passes
constexpr double height_window = 0.015;     ///< [s] window of the mean that smooths heights
constexpr PointIndex relief_every = 3;      ///< normals and reliefs are computed at every third point
constexpr double longest_lag = 0.1;         ///< [s] longest delay of the measured position after the commanded one
constexpr PointIndex shortest_reach = 64;   ///< points
constexpr float least_upward = 0.013F;      ///< sin 0.75°: on a steeper wall, the side that faces up is not determined
constexpr float least_chord_share =
    0.33F;  ///< share of the chord between both neighbours: least distance of a point from either for a relief
constexpr PointIndex longest_reach = 4096;
constexpr PointIndex lead = 16;       ///< points by which the measured position may come first, in merged logs
constexpr float farthest_lag = 2.0F;  ///< step-overs: paths that are farther apart are unrelated
constexpr double end_step_overs = 2;  ///< least length at the ends of passes that is not judged
constexpr float slowest = 1e-3F;      ///< [mm/s]: below this speed, the feed has no direction

/// Standard deviation of a derivative [1/s^d] for independent errors of the positions with a standard deviation of 1.
double noise_gain(const DerivativeFilter& filter) {
    double sum = 0;
    for (const double weight : derivative_weights(filter.points, filter.order, filter.derivative, filter.points / 2))
        sum += weight * weight;
    return std::sqrt(sum) * std::pow(filter.period, -filter.derivative);
}

/// The window of the speed [s] for a usual speed [mm/s] and positions with a resolution of `quantum` [mm].
double speed_window(double usual_speed, double quantum) {
    const double rounded = usual_speed > 0 ? std::min(speed_steps * quantum, speed_arc_length) / usual_speed : 0;
    return std::max(std::min(speed_seconds, speed_arc_length / usual_speed), rounded);
}

DerivativeFilter speed_filter(double usual_speed, double quantum, double period) {
    return {window_points(speed_window(usual_speed, quantum), period, 5), 2, 1, period};
}

DerivativeFilter acceleration_filter(double usual_speed, double quantum, double period) {
    DerivativeFilter filter = derivative_filter(2, period);
    const double seconds = acceleration_windows * speed_window(usual_speed, quantum);
    if (seconds > acceleration_windows * speed_seconds)
        filter.points = std::max(filter.points, window_points(seconds, period, 5));
    return filter;
}

using Axes = std::array<std::vector<double>, 3>;

void read(const Trajectory& path, PointIndex first, PointIndex last, Axes& out) {
    for (std::vector<double>& axis : out) axis.resize(static_cast<std::size_t>(last - first + 1));
    path.read(first, out[0], out[1], out[2]);
}

/// Mean of the known values in a window around a value; at least half of the window must be known.
class Smoother {
public:
    explicit Smoother(int points) : half_(points / 2) {}
    [[nodiscard]] PointIndex reach() const { return half_; }

    /// Means for raw[skip …], as many as `out` has, from cumulative sums. `every`: only one in so many points has a value.
    void apply(std::span<const float> raw, std::size_t skip, std::size_t every, std::span<float> out) const {
        std::vector<double> sums(raw.size() + 1);
        std::vector<std::uint32_t> counts(raw.size() + 1);
        for (std::size_t i = 0; i < raw.size(); ++i) {
            const bool there = raw[i] == raw[i];
            sums[i + 1] = sums[i] + (there ? static_cast<double>(raw[i]) : 0.0);
            counts[i + 1] = counts[i] + (there ? 1 : 0);
        }
        const auto half = static_cast<std::size_t>(half_);
        // The window shrinks symmetrically towards the ends: an asymmetric one would be biased on slopes.
        for (std::size_t k = 0; k < out.size(); ++k) {
            const std::size_t at = skip + k;
            const std::size_t reach = std::min({half, at, raw.size() - 1 - at});
            const std::uint32_t count = counts[at + reach + 1] - counts[at - reach];
            const bool enough = count > 0 && 2 * every * count >= 2 * reach + 1;
            out[k] = enough ? static_cast<float>((sums[at + reach + 1] - sums[at - reach]) / count) : missing<float>;
        }
    }

private:
    int half_;
};

/// Calls f(piece, first, last) for the sections of pieces inside a block, last inclusive.
template <typename F>
void for_each_piece(const std::vector<PointRange>& pieces, PointIndex begin, PointIndex end, F&& f) {
    for (auto piece = range_at(pieces, begin); piece != pieces.end() && piece->first < end; ++piece) {
        const PointIndex first = std::max(begin, piece->first);
        const PointIndex last = std::min(end - 1, piece->last);
        if (first <= last) f(*piece, first, last);
    }
}

/// The same for all blocks, in parallel.
template <typename F>
void for_each_section(PointIndex count, const std::vector<PointRange>& pieces, F&& f) {
    for_each_block(count, [&](PointIndex begin, PointIndex end) { for_each_piece(pieces, begin, end, f); });
}

class Deriver {
public:
    /// `usual_speed` [mm/s]; `quantum` [mm] of the path's positions.
    Deriver(const ClSurface& surface, const Trajectory& path, const Trajectory* measured,
            const MotionEstimate* estimate, double usual_speed, double quantum, SamplesInWork out)
        : surface_(surface),
          path_(path),
          measured_(measured),
          estimate_(estimate),
          usual_speed_(usual_speed),
          out_(out),
          speed_(speed_filter(usual_speed, quantum, path.period)),
          acceleration_(acceleration_filter(usual_speed, quantum, path.period)),
          smoother_(window_points(height_window, path.period)),
          reach_(std::min<PointIndex>(points_in(longest_lag, path.period, shortest_reach), longest_reach)) {}

    /// `scatter` [mm]: position_noise().
    void note_noise(double quantum, double scatter, Signals& signals) const {
        signals.speed_step_response = static_cast<float>(acceleration_.filter().speed_step_response());
        if (estimate_ != nullptr) {
            signals.speed_noise = static_cast<float>(scatter_deviations * estimate_->sigma(1));
            signals.acceleration_noise = static_cast<float>(scatter_deviations * estimate_->sigma(2));
            return;
        }
        const auto noise = [&](const DerivativeFilter& filter) {
            return static_cast<float>(
                std::max(2 * quantum * filter.step_response(), scatter_deviations * scatter * noise_gain(filter)));
        };
        signals.speed_noise = noise(speed_.filter());
        signals.acceleration_noise = noise(acceleration_.filter());
    }
    void note_windows(Signals& signals) const {
        const auto note = [&](std::string_view what, int points) {
            return fmt::format("{} over {} points ({:.3g} ms)", what, points, 1e3 * points * path_.period);
        };
        signals.speed_note = note("speed", speed_.filter().points);
        signals.acceleration_note = note("acceleration", acceleration_.filter().points);
        if (estimate_ != nullptr) {
            const std::string_view of = estimate_->fused() != nullptr ? " of scale and encoder" : "";
            signals.speed_note = fmt::format("speed by a Kalman smoother{}", of);
            signals.acceleration_note = fmt::format("acceleration by a Kalman smoother{}", of);
        }
        signals.height_note = note("heights", static_cast<int>(2 * smoother_.reach() + 1));
    }

    /// Distance [mm] from an end, at the usual speed, from which on the windows of derivatives are symmetric.
    [[nodiscard]] double window_reach() const {
        return 0.5 * acceleration_.filter().points * path_.period * usual_speed_;
    }

    void derive_motion(PointRange piece, PointIndex first, PointIndex last) const {
        const auto n = static_cast<std::size_t>(last - first + 1);
        std::array<Axes, 4> derived;
        if (estimate_ != nullptr) {
            MotionEstimate::Scratch scratch;
            estimate_->estimate(piece, first, last, scratch, derived);
        } else {
            derive_over_windows(piece, first, last, derived);
        }
        const Axes& v = derived[1];
        const Axes& a = derived[2];
        for (std::size_t k = 0; k < n; ++k) {
            const auto i = first + static_cast<PointIndex>(k);
            const Vec3 velocity(v[0][k], v[1][k], v[2][k]);
            const double speed = velocity.norm();
            Sample& sample = out_[i];
            sample.speed = static_cast<float>(speed);
            sample.normal_deviation = missing<float>;
            for (Eigen::Index axis = 0; axis < 3; ++axis) {
                sample.feed[axis] = speed > slowest ? static_cast<float>(velocity[axis] / speed) : missing<float>;
                sample.acceleration[axis] = static_cast<float>(a[static_cast<std::size_t>(axis)][k]);
            }
        }
    }

    /// Normals and heights. Domain: after derive_motion() and the zones of all points that are read.
    void derive_heights(PointRange piece, PointIndex first, PointIndex last) const {
        const PointIndex from = std::max(piece.first, first - smoother_.reach());
        const PointIndex to = std::min(piece.last, last + smoother_.reach());
        std::vector<Eigen::Vector3f> normals(static_cast<std::size_t>(to - from + 1));
        std::vector<float> relief(normals.size());
        for (PointIndex i = from; i <= to; ++i) {
            const auto k = static_cast<std::size_t>(i - from);
            if (i % relief_every == 0 || i == piece.first) {
                relief[k] = measure_relief(i, normals[k]);
            } else {
                // Between two of them the normal hardly turns.
                relief[k] = missing<float>;
                const PointIndex before = std::max(piece.first, i - i % relief_every);
                if (before >= from)
                    normals[k] = normals[static_cast<std::size_t>(before - from)];
                else
                    (void)measure_relief(before, normals[k]);
            }
            if (i >= first && i <= last) Eigen::Map<Eigen::Vector3f>(out_[i].normal) = normals[k];
        }
        const auto skip = static_cast<std::size_t>(first - from);
        std::vector<float> smooth(static_cast<std::size_t>(last - first + 1));
        smoother_.apply(relief, skip, static_cast<std::size_t>(relief_every), smooth);
        for (std::size_t k = 0; k < smooth.size(); ++k) out_[first + static_cast<PointIndex>(k)].relief = smooth[k];
        if (measured_ == nullptr) return;
        std::vector<float>& lag = relief;
        measure_lag(from, to, normals, lag);
        smoother_.apply(lag, skip, 1, smooth);
        for (std::size_t k = 0; k < smooth.size(); ++k)
            out_[first + static_cast<PointIndex>(k)].normal_deviation = smooth[k];
    }

private:
    void derive_over_windows(PointRange piece, PointIndex first, PointIndex last, std::array<Axes, 4>& derived) const {
        const PointIndex reach = std::max(speed_.reach(), acceleration_.reach());
        const PointIndex from = std::max(piece.first, first - reach);
        const PointIndex to = std::min(piece.last, last + reach);
        Axes samples;
        read(path_, from, to, samples);
        const auto n = static_cast<std::size_t>(last - first + 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            derived[1][axis].resize(n);
            derived[2][axis].resize(n);
            speed_.apply(samples[axis], from, piece, first, derived[1][axis]);
            acceleration_.apply(samples[axis], from, piece, first, derived[2][axis]);
        }
    }

    /// The normal at a point. Returns its height above the chord between its neighbours.
    float measure_relief(PointIndex i, Eigen::Vector3f& normal) const {
        normal.setConstant(missing<float>);
        const Eigen::Vector3f feed = out_.feed(i);
        const Positions& p = surface_.positions;
        const Eigen::Vector3f here = p[i];
        const PathLocation left = adjacent_location(surface_, {i, 0}, feed, Side::left);
        const PathLocation right = adjacent_location(surface_, {i, 0}, feed, Side::right);
        if (!left.exists() && !right.exists()) return missing<float>;
        const Eigen::Vector3f a = left.exists() ? position_at(p, left) : here;
        const Eigen::Vector3f b = right.exists() ? position_at(p, right) : here;
        const Eigen::Vector3f across = a - b;
        normal = feed.cross(across).normalized();
        // On a steep wall the left neighbour is above for one direction of the feed and below for the other, so the normal
        // would reverse with the feed.
        if (normal.z() < -least_upward) normal = -normal;
        if (!left.exists() || !right.exists()) return missing<float>;
        // If a pass is interrupted by an island, the neighbour is in its retract or near its end.
        if (out_.zone(left.nearest()) == Zone::outside || out_.zone(right.nearest()) == Zone::outside)
            return missing<float>;
        const float share = (here - b).dot(across) / across.squaredNorm();
        if (!(share > least_chord_share && share < 1 - least_chord_share)) return missing<float>;
        return (here - b - share * across).dot(normal);
    }

    void measure_lag(PointIndex from, PointIndex to, const std::vector<Eigen::Vector3f>& normals,
                     std::vector<float>& lag) const {
        const PointIndex begin = std::max<PointIndex>(0, from - lead - 1);
        const PointIndex end = std::min(path_.count - 1, to + reach_);
        Axes commanded;
        Axes measured;
        read(path_, from, to, commanded);
        read(*measured_, begin, end, measured);
        const auto at = [&](PointIndex m) {
            const auto k = static_cast<std::size_t>(m - begin);
            return Vec3(measured[0][k], measured[1][k], measured[2][k]);
        };
        PointIndex m = from;
        for (PointIndex i = from; i <= to; ++i) {
            const auto k = static_cast<std::size_t>(i - from);
            lag[k] = missing<float>;
            const Vec3 here(commanded[0][k], commanded[1][k], commanded[2][k]);
            const Vec3 feed = out_.feed(i).cast<double>();
            const auto along = [&](PointIndex q) { return (at(q) - here).dot(feed); };
            // The first crossing after the last one, or shortly before it if the path went back.
            m = std::clamp(m, std::max(begin + 1, i - lead), std::min(end, i + reach_));
            while (m > std::max(begin + 1, i - lead) && along(m - 1) >= 0) --m;
            while (m < std::min(end, i + reach_) && along(m) < 0) ++m;
            const double after = along(m);
            const double before = along(m - 1);
            if (!(after >= 0 && before < 0)) continue;
            const double share = before / (before - after);
            const Vec3 off = at(m - 1) + share * (at(m) - at(m - 1)) - here;
            if (off.norm() > farthest_lag * surface_.step_over) continue;
            lag[k] = static_cast<float>(off.dot(normals[k].cast<double>()));
        }
    }

    const ClSurface& surface_;
    const Trajectory& path_;
    const Trajectory* measured_;
    const MotionEstimate* estimate_;
    double usual_speed_;  ///< [mm/s]
    SamplesInWork out_;
    Differentiator speed_, acceleration_;
    Smoother smoother_;
    PointIndex reach_;
};

/// 95th percentile of the speed [mm/s] at evenly chosen points of cut passes; 0: none moves.
double usual_speed_of(const ClSurface& surface, double period) {
    // A bound on the time. Of 20,000 independent samples, the 95th percentile has a standard error of 0.15 percentage points.
    constexpr PointIndex chosen = 20'000;
    constexpr double chord_seconds = 0.010;
    const Positions& positions = surface.positions;
    const PointIndex every = std::max<PointIndex>(1, positions.size() / chosen);
    const PointIndex chord = points_in(chord_seconds, period);
    std::vector<float> speeds;
    for (const Pass& pass : surface.passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = (pass.first + every - 1) / every * every; i + chord <= pass.last; i += every) {
            const float arc_length = (positions[i + chord] - positions[i]).norm();
            if (arc_length > 0) speeds.push_back(arc_length / static_cast<float>(static_cast<double>(chord) * period));
        }
    }
    return speeds.empty() ? 0 : quantile_below(speeds, 0.95);
}

/// The finest resolution of the axes. An axis that moves only in step-overs would seem to have a coarse one.
float quantum_of_axes(const Trajectory& role) {
    double finest = 0;
    for (const ChannelView& axis : role.axes) {
        const double quantum = quantum_of(axis);
        if (quantum > 0 && (finest == 0 || quantum < finest)) finest = quantum;
    }
    return static_cast<float>(finest);
}

}  // namespace

double usual_end_zone(double step_over) {
    // This and end_step_overs: docs/design/predictor.md#4-join-places-into-defects, not judged.
    constexpr double least = 1.0;  // [mm]
    return std::max(least, end_step_overs * step_over);
}

namespace {

std::vector<std::string> reasons_against(const Trajectory& path) {
    std::vector<std::string> reasons;
    if (path.period > longest_judged_period) {
        reasons.push_back(
            fmt::format("A record comes every {:.4g} ms. Marks last some hundredths of a second: they show in "
                        "records every {:g} ms or faster.",
                        1e3 * path.period, 1e3 * longest_judged_period));
    }
    if (const std::optional<Placeholder> placeholder = find_placeholder(path.axes)) {
        const auto& [x, y, z] = placeholder->position;
        reasons.push_back(
            fmt::format("The log's position jumps to X{:g} Y{:g} Z{:g} and back {} times, over up to {:.1f} mm: "
                        "a placeholder for positions that were not recorded.",
                        x, y, z, placeholder->times, placeholder->farthest));
    }
    return reasons;
}

}  // namespace

namespace {

/// Excludes step-over moves, whose sideways speed differs from the speed of the pass.
std::vector<PointRange> without_moves(const ClSurface& surface, const std::vector<PointRange>& smooth) {
    std::vector<PointRange> pieces;
    StepOverMoveCutter cutter(surface.step_over_moves);
    for (const PointRange& piece : smooth)
        cutter.cut(piece, [&](const PointRange& part, bool) { pieces.push_back(part); });
    return pieces;
}

SignalFacts facts_of(const ClSurface& surface, const Trajectory& path, const Trajectory* measured,
                     const std::vector<PointRange>& pieces) {
    SignalFacts facts;
    facts.usual_speed = usual_speed_of(surface, path.period);
    facts.path_quantum = quantum_of_axes(path);
    facts.quantum = measured != nullptr ? std::max(facts.path_quantum, quantum_of_axes(*measured)) : facts.path_quantum;
    facts.scatter = position_noise(path, pieces);
    facts.unfit = reasons_against(path);
    return facts;
}

EndZone end_zone_of(const Deriver& deriver, double usual, double step_over) {
    return {usual, std::min(usual, std::max(end_step_overs * step_over, deriver.window_reach()))};
}

/// Sets the members that concern the whole log.
void note_facts(const Deriver& deriver, const SignalFacts& facts, Signals& signals) {
    signals.quantum = facts.quantum;
    signals.unfit = facts.unfit;
    deriver.note_windows(signals);
    deriver.note_noise(facts.path_quantum, facts.scatter, signals);
}

/// Derives signals when they are read.
struct Derivation {
    Trajectory path;
    std::optional<Trajectory> measured;
    std::vector<PointRange> pieces;
    std::optional<Deriver> deriver;
    std::optional<ZoneMarker> marker;
};

}  // namespace

void Signals::forget() {
    for (const BlockFillPointer* fill : {&motion, &zones, &heights}) {
        if (*fill) (*fill)->forget();
    }
    samples.forget();
    if (arc_length) arc_length->forget();
}

SignalFacts measure_facts(const ClSurface& surface, const Trajectory& path, const Trajectory* measured,
                          const std::vector<PointRange>& pieces) {
    return facts_of(surface, path, measured, without_moves(surface, pieces));
}

Signals derive_signals(const ClSurface& surface, const Trajectory& path, const Trajectory* measured,
                       const std::vector<PointRange>& pieces, double end_zone, const MotionEstimate* estimate) {
    Signals signals;
    const std::vector<PointRange> parts = without_moves(surface, pieces);
    signals.samples.resize(static_cast<std::size_t>(path.count));
    signals.measured = measured != nullptr;
    signals.pieces = parts;
    const SignalFacts facts = facts_of(surface, path, measured, parts);
    const SamplesInWork samples(signals.samples.data());
    const Deriver deriver(surface, path, measured, estimate, facts.usual_speed, facts.path_quantum, samples);
    note_facts(deriver, facts, signals);
    for_each_section(path.count, parts, [&](PointRange piece, PointIndex first, PointIndex last) {
        deriver.derive_motion(piece, first, last);
    });
    const ArcLength arc_length(surface.positions);
    ZoneMarker(surface.passes, parts, arc_length, end_zone_of(deriver, end_zone, surface.step_over), path.period,
               samples)
        .mark({0, path.count - 1});
    for_each_section(path.count, parts, [&](PointRange piece, PointIndex first, PointIndex last) {
        deriver.derive_heights(piece, first, last);
    });
    return signals;
}

Signals derive_when_read(const ClSurface& surface, const Trajectory& path, const Trajectory* measured,
                         const std::vector<PointRange>& pieces, double end_zone, const SignalFacts& facts) {
    Signals signals;
    signals.samples = Column<Sample>::sparse(static_cast<std::size_t>(path.count));
    signals.measured = measured != nullptr;
    signals.pieces = without_moves(surface, pieces);
    signals.arc_length = std::make_shared<ArcLength>(surface.positions);
    auto work = std::make_shared<Derivation>(Derivation{path, {}, signals.pieces, std::nullopt, std::nullopt});
    if (measured != nullptr) work->measured = *measured;
    const PointIndex block = surface.positions.fill ? surface.positions.fill->block() : block_points;
    const auto filled_by = [&](BlockFill::Fill fill) { return BlockFillPointer(path.count, std::move(fill), block); };
    signals.motion = filled_by([work](PointIndex first, PointIndex last) {
        for_each_piece(work->pieces, first, last, [&](PointRange piece, PointIndex a, PointIndex b) {
            work->deriver->derive_motion(piece, a, b);
        });
    });
    signals.zones = filled_by([work, motion = signals.motion.get()](PointIndex first, PointIndex last) {
        motion->need(first);
        work->marker->mark({first, last - 1});
    });
    signals.heights = filled_by([work, zones = signals.zones.get()](PointIndex first, PointIndex last) {
        zones->need(first);
        for_each_piece(work->pieces, first, last, [&](PointRange piece, PointIndex a, PointIndex b) {
            work->deriver->derive_heights(piece, a, b);
        });
    });
    const SamplesInWork samples(signals.samples.data(), signals.motion.get(), signals.zones.get());
    work->deriver.emplace(surface, work->path, work->measured ? &*work->measured : nullptr, nullptr, facts.usual_speed,
                          facts.path_quantum, samples);
    work->marker.emplace(surface.passes, work->pieces, *signals.arc_length,
                         end_zone_of(*work->deriver, end_zone, surface.step_over), path.period, samples);
    note_facts(*work->deriver, facts, signals);
    return signals;
}

}  // namespace clsurf
