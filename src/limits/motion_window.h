#pragma once
// CommandedMotion: the commanded motion of a log, as the limits need it. MotionWindow: some of its records, with their
// distances to the limits. Nothing is smoothed.
//
// A difference quotient over n periods is the mean of the derivative over them, so it is at most the greatest value of the
// derivative: a limit that is exceeded here was exceeded in the machine. Rounding to a grid of q adds at most 2^(order − 1)
// q / (stride · period)^order. If that is too much for steps of one record, longer steps are used as well.

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "limits/clock.h"
#include "log/log.h"
#include "machine/limit_table.h"
#include "toolpath/trajectory.h"

namespace clsurf {

struct CommandedAxis {
    char letter = 'x';
    ChannelView positions;
    double to_inside = 1;   ///< [rad/deg] for rotary axes
    double resolution = 0;  ///< [mm or rad]
};

class CommandedMotion {
public:
    /// Shares the columns of both. Without axes there are no commanded positions.
    CommandedMotion(const Log& log, const Trajectory& path, std::span<const StatedLimit> limits);

    [[nodiscard]] const Log& log() const { return *log_; }
    [[nodiscard]] const Trajectory& path() const { return *path_; }
    [[nodiscard]] std::span<const CommandedAxis> axes() const { return axes_; }
    [[nodiscard]] const CommandedAxis* find(char letter) const;
    /// Resolution of positions of the linear axes: all three have a rounding error at the same time [mm].
    [[nodiscard]] double resolution() const { return std::sqrt(3.0) * rules_.resolution; }
    /// Resolution of the tip at these positions [mm and rad]: rounding of a rotary axis moves it, too, by the lever arm
    /// [mm].
    [[nodiscard]] double tip_resolution(const Vec3& linear, const Vec3& rotary) const;
    /// Resolution of the path: the coarsest of some records throughout the log [mm].
    [[nodiscard]] double path_resolution() const;
    [[nodiscard]] const ClockRules& clock() const { return rules_; }
    /// Whether the path's positions differ from those of the linear axes.
    [[nodiscard]] bool has_tip() const { return path_->kinematics != nullptr; }
    /// Whether any of the limits applies to the path.
    [[nodiscard]] bool limits_path() const { return limits_path_; }

private:
    const Log* log_;
    const Trajectory* path_;
    std::vector<CommandedAxis> axes_;
    ClockRules rules_;
    bool limits_path_ = false;
};

/// A step width in records for one limit, and the effect of rounding in multiples of the resolution.
struct Stride {
    std::size_t records = 1;
    double roundings = 0;
};
/// Strides of one record and more, until rounding is less than a percent of the limit; at most 16 records.
[[nodiscard]] std::vector<Stride> strides_for(const StatedLimit& limit, const CommandedMotion& motion);

/// The value for the stride with the greatest certain value; NaN: not known.
struct MeasuredValue {
    double value = 0;
    double uncertainty = 0;
    double noise = 0;  ///< the part of the uncertainty from rounding and the clock; the rest is from bends
};

class MotionWindow {
public:
    /// Number of records that a window reads on each side.
    static constexpr PointIndex margin = 3 * 16 + 2;

    /// Reads the records [first, last] of the motion, and the margin. O(records).
    MotionWindow(const CommandedMotion& motion, PointRange records);

    /// Speed, acceleration or jerk of an axis or of the path, by record. O(records · strides).
    [[nodiscard]] std::vector<MeasuredValue> measure(const StatedLimit& limit, std::span<const Stride> strides) const;
    /// Steps between records that are not judged.
    [[nodiscard]] std::vector<PointIndex> broken() const;

private:
    using Path = std::array<std::vector<double>, 3>;
    struct Value {
        double value, noise;
        double bend = 0;  ///< greatest effect of a bend within the difference
    };

    void read_tip();
    [[nodiscard]] const std::vector<double>* column_of(char letter) const;
    /// Resolution of the path in the records about i [mm]: on a straight path the lever arms are longest at its ends.
    [[nodiscard]] double path_resolution(std::size_t first, std::size_t i, std::size_t last) const;
    [[nodiscard]] bool clean(std::size_t first, std::size_t last) const { return breaks_[last] == breaks_[first]; }
    /// Whether the log has an unsteady clock. Values by its times and by equal periods are then both possible.
    [[nodiscard]] bool is_timed() const { return !steps_.late.empty(); }
    [[nodiscard]] double time_between(std::size_t first, std::size_t last) const;  ///< [s]
    [[nodiscard]] double crowding(std::size_t first, std::size_t stride, int order) const;
    [[nodiscard]] double clock_noise(double speed, double rate, int order) const;
    [[nodiscard]] Value of_axis(std::span<const double> x, std::size_t i, std::size_t stride, int order) const;
    [[nodiscard]] Value of_path(std::size_t i, std::size_t stride, LimitedQuantity quantity, double rounding) const;
    [[nodiscard]] bool may_stop(std::size_t i, std::size_t stride) const;
    [[nodiscard]] Value path_jerk(std::size_t i, std::size_t stride) const;
    [[nodiscard]] Vec3 place(std::size_t i) const { return {path()[0][i], path()[1][i], path()[2][i]}; }
    [[nodiscard]] const Path& path() const { return tip_[0].empty() ? linear_ : tip_; }

    const CommandedMotion* motion_;
    PointRange records_;
    PointIndex begin_ = 0;  ///< record of the columns' first value
    std::size_t count_ = 0;
    std::vector<std::vector<double>> axes_;
    Path linear_, tip_;                    ///< tip_: empty if it equals linear_
    std::vector<double> tip_resolutions_;  ///< [mm] by record; empty with tip_
    StepClock steps_;
    std::vector<std::uint32_t> breaks_;  ///< broken steps up to each record
};

}  // namespace clsurf
