#pragma once
// DefectMap: the marks of `render --defects`: the sections with defects, and their names in a column next to the part.

#include <string>
#include <vector>

#include "core/geometry.h"
#include "core/point.h"
#include "viz/colour_map.h"

namespace clsurf::viz {

/// How the sections of a kind of defect are drawn, besides their colour.
enum class StrokeStyle : std::uint8_t { solid, dashed, double_line, dotted };

/// The quantity in which a defect differs, for the key below the names.
struct DefectKind {
    std::string name;  ///< "speed"
    Rgb rgb{0, 0, 0};
    StrokeStyle style = StrokeStyle::solid;
};

struct DefectMark {
    std::vector<PointRange> sections;  ///< of the passes with the defect
    PointIndex point = -1;             ///< the strongest point; −1: not known
    std::size_t kind = 0;              ///< index into DefectMap::kinds
    double strength = 1;               ///< 0 light … 1 dark
    bool region = false;               ///< thin lines, a hatched region: many adjacent passes
    std::string number;                ///< "4"
    std::string label;                 ///< "−87 % speed"
    std::string lines;                 ///< "lines 3065–3228"
    std::string place = {};            ///< "X 1.5  Y −4.7  Z 4.9"; shown if there is room
    std::string cause = {};            ///< likewise
};

struct DefectMap {
    std::vector<DefectKind> kinds;
    std::vector<DefectMark> marks;  ///< in decreasing order of strength
};

/// The most defects that are named next to the part: every region, and the strongest of the others.
inline constexpr std::size_t most_named_defects = 12;

}  // namespace clsurf::viz
