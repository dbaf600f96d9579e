#pragma once
// ChartFrame: a rectangle of a sheet with two axes, its grid and its numbers.

#include "viz/canvas.h"

namespace clsurf::viz {

inline constexpr Rgb chart_ink{20, 20, 24};
inline constexpr Rgb chart_faint{95, 95, 100};
inline constexpr Rgb chart_grid{222, 222, 226};

struct ChartFrame {
    Rect rect;
    double x_low = 0, x_high = 1, y_low = 0, y_high = 1;
    /// Where values lie on the sheet [px].
    [[nodiscard]] Vec2 at(double x, double y) const {
        const double u = x_high > x_low ? (x - x_low) / (x_high - x_low) : 0.5;
        const double v = y_high > y_low ? (y - y_low) / (y_high - y_low) : 0.5;
        return {rect.x + u * rect.width, rect.y + v * rect.height};
    }
};

/// Grid lines at round values, numbers of a text size [px] at the left, and below where `x_labels` says so.
void add_grid(Sheet& sheet, const ChartFrame& frame, double text, bool x_labels);
/// The grid lines of the y axis with their numbers, two at least where the range has a length, and the frame.
void add_y_axis(Sheet& sheet, const ChartFrame& frame, double text);
/// The lines up from the x axis, and its numbers, alone.
void add_x_grid(Sheet& sheet, const ChartFrame& frame, double text, bool x_labels);

}  // namespace clsurf::viz
