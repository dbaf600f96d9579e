#pragma once
// CommandedMotion: the commanded motion of a log as limits see it. MotionWindow: some records of it, and how near each
// is to a limit. Nothing is smoothed.
//
// A difference quotient over n periods is the mean of the derivative over them. So it is never greater than the
// derivative's greatest value: what exceeds a limit here exceeds it in the machine. Rounding to a grid of q adds at most
// 2^(order − 1) q / (stride · period)^order. Where that is much for steps of one record, longer steps are taken as well.

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
    double to_inside = 1;   ///< rad per deg of rotary axes
    double resolution = 0;  ///< [mm or rad]
};

class CommandedMotion {
public:
    /// Shares the columns of both. Empty axes: nothing is commanded.
    CommandedMotion(const Log& log, const Trajectory& path, std::span<const StatedLimit> limits);

    [[nodiscard]] const Log& log() const { return *log_; }
    [[nodiscard]] const Trajectory& path() const { return *path_; }
    [[nodiscard]] std::span<const CommandedAxis> axes() const { return axes_; }
    [[nodiscard]] const CommandedAxis* find(char letter) const;
    /// Of positions of the linear axes: three are off at once [mm].
    [[nodiscard]] double resolution() const { return std::sqrt(3.0) * rules_.resolution; }
    /// Of the tip at these positions [mm and rad]: rounding of a rotary axis moves it by the lever arm, too [mm].
    [[nodiscard]] double tip_resolution(const Vec3& linear, const Vec3& rotary) const;
    /// Of the path: the coarsest of some records from all over the log [mm].
    [[nodiscard]] double path_resolution() const;
    [[nodiscard]] const ClockRules& clock() const { return rules_; }
    /// Whether the path's positions are not simply those of the linear axes.
    [[nodiscard]] bool has_tip() const { return path_->kinematics != nullptr; }
    /// Whether any of the limits is one of the path.
    [[nodiscard]] bool limits_path() const { return limits_path_; }

private:
    const Log* log_;
    const Trajectory* path_;
    std::vector<CommandedAxis> axes_;
    ClockRules rules_;
    bool limits_path_ = false;
};

/// Steps in records that one limit is looked at with, and how many of the resolution rounding adds to a value.
struct Stride {
    std::size_t records = 1;
    double roundings = 0;
};
/// From one record on, until rounding is less than a percent of the limit. At most 16 records.
[[nodiscard]] std::vector<Stride> strides_for(const StatedLimit& limit, const CommandedMotion& motion);

/// A value, of the stride that proves most; NaN: not known.
struct MeasuredValue {
    double value = 0;
    double uncertainty = 0;
    double noise = 0;  ///< the part of the uncertainty that rounding and the clock make; the rest is that of bends
};

class MotionWindow {
public:
    /// Records that a window reads on each side.
    static constexpr PointIndex margin = 3 * 16 + 2;

    /// Records [first, last] of the motion. Reads them and the margin. O(records).
    MotionWindow(const CommandedMotion& motion, PointRange records);

    /// Speed, acceleration or jerk of an axis or of the path, by record. O(records · strides).
    [[nodiscard]] std::vector<MeasuredValue> measure(const StatedLimit& limit, std::span<const Stride> strides) const;
    /// Steps between records that are not judged.
    [[nodiscard]] std::vector<PointIndex> broken() const;

private:
    using Path = std::array<std::vector<double>, 3>;
    struct Value {
        double value, noise;
        double bend = 0;  ///< what a bend within the difference may make of it
    };

    void read_tip();
    [[nodiscard]] const std::vector<double>* column_of(char letter) const;
    /// Of the path in the records about i [mm]: on a straight way the arms are longest at its ends.
    [[nodiscard]] double path_resolution(std::size_t first, std::size_t i, std::size_t last) const;
    [[nodiscard]] bool clean(std::size_t first, std::size_t last) const { return breaks_[last] == breaks_[first]; }
    /// Whether the log has a clock that is not steady. Then values by its times and by even periods are both possible.
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
    Path linear_, tip_;                    ///< tip_: empty where it is the same
    std::vector<double> tip_resolutions_;  ///< [mm] by record; empty with tip_
    StepClock steps_;
    std::vector<std::uint32_t> breaks_;  ///< broken steps up to each record
};

}  // namespace clsurf
