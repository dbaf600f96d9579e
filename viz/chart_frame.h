#pragma once
// ChartFrame: a rectangle of a sheet with two axes, grid and numbers.

#include <limits>
#include <span>
#include <vector>

#include "viz/canvas.h"

namespace clsurf::viz {

inline constexpr Rgb chart_ink{20, 20, 24};
inline constexpr Rgb chart_faint{95, 95, 100};
inline constexpr Rgb chart_grid{222, 222, 226};

struct ChartFrame {
    Rect rect;
    double x_low = 0, x_high = 1, y_low = 0, y_high = 1;
    /// The position of values on the sheet [px].
    [[nodiscard]] Vec2 at(double x, double y) const {
        const double u = x_high > x_low ? (x - x_low) / (x_high - x_low) : 0.5;
        const double v = y_high > y_low ? (y - y_low) / (y_high - y_low) : 0.5;
        return {rect.x + u * rect.width, rect.y + v * rect.height};
    }
};

/// The range of values that a chart shows. Values that are not finite are ignored.
struct ValueRange {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    void widen(std::span<const double> values);
};

/// Fits the y axis to a range, with a share of it as margin on both sides. The margin does not extend below 0 if no value
/// does. A constant curve gets a margin anyway.
void fit_y(ChartFrame& frame, ValueRange range, double room_share);

/// The points of a curve that a width of pixels can show: the lowest and highest of each column, in
/// order, so that no extreme is lost. A gap (NaN) within one column is closed. O(points).
[[nodiscard]] std::vector<Vec2> thin_curve(std::span<const double> x, std::span<const double> y, double x_low,
                                           double x_high, int columns);

/// A curve over x (increasing), with gaps for missing values; `line` is its look.
void add_line(Sheet& sheet, const ChartFrame& frame, std::span<const double> x, std::span<const double> values,
              FlatLine line);

/// Grid lines at round values, with numbers of a text size [px] at the left and, if `x_labels` is set, below.
void add_grid(Sheet& sheet, const ChartFrame& frame, double text, bool x_labels);
/// The grid lines of the y axis with their numbers, at least two if the range is not empty, and the frame.
void add_y_axis(Sheet& sheet, const ChartFrame& frame, double text);
/// Only the vertical grid lines and the numbers of the x axis; at least two lines if the range is not empty.
void add_x_grid(Sheet& sheet, const ChartFrame& frame, double text, bool x_labels);

}  // namespace clsurf::viz
