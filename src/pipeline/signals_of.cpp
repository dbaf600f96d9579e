#include "pipeline/signals_of.h"

#include "pipeline/roles.h"
#include "surface/smoothing_segments.h"

namespace clsurf {

PartSignals signals_along(const Log& log, const Trajectory& path, const ClSurface& surface, std::optional<Role> wanted,
                          const MotionEstimate* estimate) {
    PartSignals result{std::nullopt, smoothing_segments(log, surface.passes), {}};
    if (const std::optional<Role> role = measured_role(log, path, wanted))
        result.measured = reconstruct_like(log, *role, path);
    result.signals = derive_signals(surface, path, result.measured ? &*result.measured : nullptr, result.pieces,
                                    usual_end_zone(surface.step_over), estimate);
    return result;
}

PartSignals signals_of(const Part& part, const ClSurface& surface, std::optional<Role> wanted) {
    const std::shared_ptr<const MotionEstimate> estimate = estimate_motion(part, surface.passes);
    return signals_along(part.log, part.path, surface, wanted, estimate.get());
}

}  // namespace clsurf
