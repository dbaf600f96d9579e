#pragma once
// The predictor's signals of a part.

#include <optional>
#include <vector>

#include "core/point.h"
#include "pipeline/part.h"
#include "predictor/signals.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// What the predictor reads of a part.
struct PartSignals {
    std::optional<Trajectory> measured;  ///< positions that heights are measured from; nothing: those that are shown
    std::vector<PointRange> pieces;      ///< of smooth path (surface/smoothing_segments.h)
    Signals signals;

    /// Where the tool cuts.
    [[nodiscard]] const Trajectory& swept(const Trajectory& path) const { return measured ? *measured : path; }
};

/// The signals along any path of a log, whose surface that is. Heights are measured from the positions that
/// measured_role() chooses (pipeline/roles.h). `estimate`: as derive_signals() takes it. O(points), parallel.
[[nodiscard]] PartSignals signals_along(const Log& log, const Trajectory& path, const ClSurface& surface,
                                        std::optional<Role> wanted = std::nullopt,
                                        const MotionEstimate* estimate = nullptr);

/// The same of a part and its surface, by the part's derivative method.
[[nodiscard]] PartSignals signals_of(const Part& part, const ClSurface& surface,
                                     std::optional<Role> wanted = std::nullopt);

}  // namespace clsurf
