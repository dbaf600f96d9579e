#pragma once
// Signal curves: fields over time or arc length, one stacked chart each, with a cursor.

#include <span>
#include <string>
#include <vector>

#include "field/field.h"
#include "viz/canvas.h"

namespace clsurf::viz {

/// The name of a value of a curve with classes.
struct CurveClass {
    double value = 0;
    std::string name;
    Rgb rgb{0, 0, 0};
};

struct Curve {
    std::string label;                     ///< "Path speed [mm/min]"
    std::vector<double> values;            ///< shown units; NaN: a gap
    std::vector<CurveClass> classes = {};  ///< drawn as bands; empty: values are numbers
    std::vector<double> reference = {};    ///< drawn below the curve in grey, in the same frame; empty: none
    std::string reference_label = {};      ///< "predicted"
};

struct ChartCursor {
    double x = 0;
    std::string label;           ///< "point 812, line 204"
    std::vector<double> values;  ///< one per curve, shown at the cursor; none: only the label, at the first curve
};

struct ChartLook {
    int width = 1600, height = 900;
    Rgb background{255, 255, 255};
    std::string gl = "osmesa";
    int supersample = 2;
    bool keep_drawing = false;  ///< for SVG and PDF
    std::string title, subtitle, x_label, footnote;
};

/// An empty sheet with the given look.
[[nodiscard]] Sheet sheet_of(const ChartLook& look);
/// The height of its text [px]; `lines` lines of it fit into the picture.
[[nodiscard]] double text_size_of(const ChartLook& look, double lines);

/// Draws the curves over common x values (increasing). Throws SystemError.
[[nodiscard]] Image draw_chart(std::span<const double> x, const std::vector<Curve>& curves,
                               const std::vector<ChartCursor>& cursors, const ChartLook& look);

}  // namespace clsurf::viz
