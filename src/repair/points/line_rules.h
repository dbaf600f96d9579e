#pragma once
// LineRules: the spacing of new points, and their largest distance from the programmed lines.

namespace clsurf {

struct LineRules {
    double spacing = 0;        ///< [mm] between aligned points
    double usual = 0;          ///< [mm] usual spacing of the program's points, and largest length of new lines
    double shortest_line = 0;  ///< [mm] for the selection of aligned points
    double chord_error = 0;    ///< [mm] largest distance of lines from the curve
    double most = 0;           ///< [mm] largest distance of lines from the old ones, before rounding
    double radius = 0;         ///< [mm] of the tube around the curve: the tolerance minus the chord errors
    double most_turned = 0;    ///< [rad] largest angle between the tool axes of new and old lines
};

}  // namespace clsurf
