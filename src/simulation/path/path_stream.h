#pragma once
// PathStream: the path of a program as the controller runs it, in spans with bounds on its derivatives.
//
// Between exact stops, corners are rounded inside the tolerance by adding to the programmed path
// p(u), u its arc length, for each joint at u_i with a jump Δt of the tangent and Δk of the curvature,
//
//     Δt · (w − |d|)³ / (6 w²)      +      Δk · d (v − |d|)³ / (12 v²),      d = u − u_i,
//
// where |d| < w (< v). The first term is what smoothing p with a triangle of half-width w adds at a corner; the second term
// removes the jump of the second derivative. The sum is C² with a bounded third derivative, so a speed profile with bounded
// jerk gives axis positions with bounded jerk. (A circular transition arc, whose curvature jumps, does not: arc_steps.h.)
// Adjacent roundings may overlap: dense polylines are smoothed over many blocks.
//
// If the path limits the jerk and no axis does, the triangle becomes a trapezoid, whose top has the half-width c = β w: a
// lower curvature for the same deviation, with a greater third derivative. The first term is then
//
//     Δt · ((w − |d|)³ − (c − |d|)³) / (6 (w² − c²)),      each cube where it is positive.
//
// The widths satisfy the tolerance by construction: the deviation D at a corner is at most Σ |Δt_j| (w_j − |d|)³/(6 w_j²),
// which is convex between corners, and multiplying all w_j of that sum by f < 1 makes it at most f D.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "core/queue.h"
#include "machine/machine.h"
#include "simulation/path/block_merging.h"
#include "simulation/path/block_stream.h"
#include "simulation/path/corner_arcs.h"
#include "simulation/path/curve_blocks.h"

namespace clsurf {

/// The factor that limited the speed of a point: the values of the channel `limit`.
enum class LimitingFactor : std::uint8_t {
    none = 0,               ///< at rest
    feed = 1,               ///< programmed feed
    axis_speed = 2,         ///< speed of an axis, or of the path
    axis_acceleration = 3,  ///< acceleration of an axis, of the path, or normal to it
    jerk = 4,
    corner_tolerance = 5,  ///< jerk in a corner that is as round as the tolerance allows
    chord_error = 6,
    lookahead_end = 7,  ///< braking to a stop, or to the end of the known blocks
    feed_override = 8,
    block_time = 9,  ///< the block is shorter than the distance covered in the controller's block time
};

/// "feed", "axis speed", …
[[nodiscard]] std::string_view name_of(LimitingFactor limiting);

/// Pace: path speed divided by the speed along the programmed arc length u, and its derivatives by u: |p′|, |p′|′ [1/mm]
/// and |p′|″ [1/mm²]. A rounded path is shorter than the programmed one. Therefore the tangential acceleration is |p′| u″ +
/// |p′|′ u′², and the tangential jerk |p′| u‴ + 3 |p′|′ u′ u″ + |p′|″ u′³.
struct Pace {
    double value = 1, slope = 0, curve = 0;
};
[[nodiscard]] Pace pace_of(const PathDerivatives& derivatives);

/// A section of the path with the terms of its position and its limits of speed.
struct Span {
    PathElement base;
    double from = 0;                 ///< arc length on the element where the span begins [mm]
    double length = 0;               ///< [mm]
    std::array<Vec3, 5> rounding{};  ///< Σ rounding[k] τᵏ, τ from the span's start
    bool rounded = false;

    // Greatest values on the span. For each axis: first to third derivative of the position by the arc length.
    Vec3 first = Vec3::Zero(), second = Vec3::Zero(), third = Vec3::Zero();
    double greatest_first = 0, greatest_second = 0;  ///< of the vectors
    double pace_slope = 0, pace_curve = 0;           ///< of |p′|′ and |p′|″ [1/mm, 1/mm²]; 0 without rounding
    double swing = 0;                                ///< of |p′|³ times the square of the curvature [1/mm²]
    double fourth = 0;                               ///< of the length of the fourth derivative [1/mm³]
    // Speed limit without the limits of bends (feed, speed of path and axes), and its factor.
    double free_cap = 0;
    LimitingFactor free_limiting = LimitingFactor::none;
    double begin_cap = std::numeric_limits<double>::infinity();  ///< at its start, for a corner that is not rounded
    // Speed limit without tangential acceleration, and its factor.
    double cap = 0;
    LimitingFactor limiting = LimitingFactor::none;
    // Tangential limits, as on a straight path with the same slopes.
    double acceleration = 0, jerk = 0;

    /// Position τ after the span's start; `deviation`: output, how far the rounding moves it [mm]; `pace`: output, the
    /// length of its first derivative, which is path speed divided by the speed along the programmed arc length.
    [[nodiscard]] Vec3 at(double tau, double& deviation, double& pace) const;
    [[nodiscard]] PathDerivatives derivatives(double tau) const;
    [[nodiscard]] bool straight() const { return !rounded && base.straight(); }
};

class PathStream {
public:
    /// Number of joints to each side that a rounding may cross. It bounds how many blocks must be known
    /// (docs/simulate.md#2-corner-rounding).
    static constexpr std::int64_t reach_of_a_joint = 20;

    /// Both references must outlive the object; the source is at its start. `start`: position of the axes; coordinates that
    /// the program has not set keep their values [mm].
    PathStream(MotionSource& source, const Machine& machine, const Vec3& start);

    /// Goes to the next section, between two exact stops. False: the program has ended.
    /// Throws InputError (feed 0, rotary axes).
    bool begin_section();
    /// The next span of the section, valid until the next call; nullptr: there are no more spans.
    [[nodiscard]] const Span* next();
    /// The blocks of the program. The data at the end of the section are valid after next() has returned false.
    [[nodiscard]] const BlockStream& blocks() const { return blocks_; }

private:
    struct Joint {
        double at = 0;                                  ///< arc length from the section's start [mm]
        Vec3 turn = Vec3::Zero(), bend = Vec3::Zero();  ///< Δt; Δk [1/mm]
        double turning = 0;                             ///< |Δt|
        double tolerance = 0;
        double widest = 0;  ///< greatest width of its rounding
        double width = 0, bend_width = 0;
        double share = 0;  ///< factor of (w − |d|)³ − (β w − |d|)³ in its rounding at the greatest width [1/mm²]
        double deviation = 0;  ///< of the overlapping roundings, before scaling
        // The final rounding: factors of (w − |d|)³ at the scaled width and of d (v − |d|)³, and the reach of both.
        Vec3 turn_share = Vec3::Zero(), bend_share = Vec3::Zero();
        double reach = 0;
    };

    bool pull();
    void add_joint(const PathElement& before, const PathElement& after);
    void settle();
    void settle_width(std::int64_t i);
    void settle_deviation(std::int64_t i);
    void settle_scale(std::int64_t i);
    void make_spans(std::int64_t element);
    void find_roundings(std::int64_t element, double begin, double end);
    void add_roundings(Span& span, double begin) const;
    void set_limits(Span& span) const;
    void limit_next_to_step(Span& span) const;

    Joint& joint(std::int64_t i) { return joints_[static_cast<std::size_t>(i - first_joint_)]; }
    [[nodiscard]] const Joint& joint(std::int64_t i) const {
        return joints_[static_cast<std::size_t>(i - first_joint_)];
    }

    const Machine* machine_;
    double bend_share_ = 0;  ///< share of the tolerance for jumps of curvature
    double top_ = 0;         ///< β: half-width of the top of the trapezoid, as a share of w
    BlockStream blocks_;
    std::unique_ptr<BlockMerging> merged_;
    std::unique_ptr<CurveBlocks> curves_;
    std::unique_ptr<CornerArcs> arcs_;
    ElementSource* source_;  ///< the last of the stages that shape the path

    // The section: elements from first_element_ on; joint i is between elements i and i + 1.
    Queue<PathElement> elements_;
    Queue<double> ends_;  ///< arc length to each element's end [mm]
    Queue<Joint> joints_;
    std::int64_t first_element_ = 0, first_joint_ = 0;
    std::int64_t element_count_ = 0;
    bool closed_ = false;
    double closed_at_ = 0;
    std::int64_t widths_done_ = 0, deviations_done_ = 0, scales_done_ = 0, spans_done_ = 0;
    Queue<Span> ready_;
    bool front_taken_ = false;  ///< of ready_
    // Scratch of make_spans(): joints whose roundings reach into a part of the element, the sum of the roundings that cover
    // it as a polynomial from its start, and where it is divided.
    std::vector<const Joint*> reaching_;
    std::array<Vec3, 4> covering_;
    bool covered_ = false;
    std::vector<double> cuts_;
};

}  // namespace clsurf
