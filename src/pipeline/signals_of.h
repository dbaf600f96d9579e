#pragma once
// The predictor's signals of a part.

#include <optional>
#include <vector>

#include "core/point.h"
#include "pipeline/part.h"
#include "predictor/signals.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// The data of a part that the predictor reads.
struct PartSignals {
    std::optional<Trajectory> measured;  ///< positions from which heights are measured; nullopt: the displayed ones
    std::vector<PointRange> pieces;      ///< of smooth path (surface/smoothing_segments.h)
    Signals signals;

    /// The positions at which the tool cuts.
    [[nodiscard]] const Trajectory& swept(const Trajectory& path) const { return measured ? *measured : path; }
};

/// The signals along any path of a log, with the surface of that path. measured_role() chooses the positions from which
/// heights are measured (pipeline/roles.h). `estimate`: as for derive_signals(). O(points), parallel.
[[nodiscard]] PartSignals signals_along(const Log& log, const Trajectory& path, const ClSurface& surface,
                                        std::optional<Role> wanted = std::nullopt,
                                        const MotionEstimate* estimate = nullptr);

/// The same for a part and its surface, with the part's derivative method.
[[nodiscard]] PartSignals signals_of(const Part& part, const ClSurface& surface,
                                     std::optional<Role> wanted = std::nullopt);

}  // namespace clsurf
