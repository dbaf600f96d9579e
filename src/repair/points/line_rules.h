#pragma once
// LineRules: the spacing of new points, and their largest distance from the programmed lines.

namespace clsurf {

struct LineRules {
    double spacing = 0;        ///< [mm] between aligned points
    double usual = 0;          ///< [mm] spacing of the program's own points, and how long lines get at most
    double shortest_line = 0;  ///< [mm] that aligned points are chosen for
    double chord_error = 0;    ///< [mm] of lines against the curve
    double most = 0;           ///< [mm] that lines may leave the old ones by, before they are rounded
    double radius = 0;         ///< [mm] of the tube that the curve lies in: what chords leave of the tolerance
    double most_turned = 0;    ///< [rad] that lines may turn the tool axis away from the old ones
};

}  // namespace clsurf
