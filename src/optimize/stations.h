#pragma once
// Stations: places along neighbour passes that lie side by side. A phase runs along every pass; where it
// passes a whole number there is a station, and the phase of a place is that of the place beside it on a
// pass that was programmed before. Points put at stations are therefore in step with the neighbours'.

#include <vector>

#include "optimize/programmed_surface.h"

namespace clsurf {

struct Phases {
    std::vector<double> of_point;  ///< per point of the surface; NaN: not on a cut pass
    double spacing = 0;            ///< [mm] of way between whole numbers where no pass lies beside
};

/// Phases of all cut passes in the order of the program. Where passes fan out or in, the phase is
/// doubled or halved from pass to pass, so that stations stay between 0.7 and 1.4 spacings apart on the
/// whole. O(points).
[[nodiscard]] Phases run_phases(const ProgrammedSurface& laid, double spacing);

}  // namespace clsurf
