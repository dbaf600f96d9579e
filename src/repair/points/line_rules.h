#pragma once
// LineRules: the spacing of new points, and their largest distance from the programmed lines.

namespace clsurf {

inline constexpr double least_corner_angle = 0.5;  ///< [rad] where a pass turns by more, its point stays

/// Lines of the same lengths at the ends of all passes.
struct EndLines {
    double first = 0;  ///< [mm] of the first and of the last line of a pass; 0: there are no such lines
    double step = 0;   ///< [mm] of the lines next to these …
    double reach = 0;  ///< … up to this arc length from the end of the pass [mm]
};

struct LineRules {
    double spacing = 0;        ///< [mm] between aligned points
    double usual = 0;          ///< [mm] usual spacing of the program's points, and largest length of new lines
    double shortest_line = 0;  ///< [mm] for the selection of aligned points
    double chord_error = 0;    ///< [mm] largest distance of lines from the curve
    double most = 0;           ///< [mm] largest distance of lines from the old ones, before rounding
    double radius = 0;         ///< [mm] of the tube around the curve: the tolerance minus the chord errors
    double most_turned = 0;    ///< [rad] largest angle between the tool axes of new and old lines
    EndLines ends{};           ///< at the ends of passes
};

}  // namespace clsurf
