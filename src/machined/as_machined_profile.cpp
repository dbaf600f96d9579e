#include "machined/as_machined_profile.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "machined/across_feed.h"

namespace clsurf {

AsMachinedProfile measure_profile(const AsMachinedSurface& as_machined, const Vec2& from, const Vec2& to) {
    return measure_profile(as_machined, as_machined, from, to);
}

AsMachinedProfile measure_profile(const AsMachinedSurface& as_machined, const AsMachinedSurface& form_of,
                                  const Vec2& from, const Vec2& to) {
    AsMachinedProfile profile;
    const double length = (to - from).norm();
    const double spacing =
        as_machined.surface().step_over > 0 ? as_machined.surface().step_over : 20 * as_machined.usual_cell();
    const auto pieces = static_cast<std::int64_t>(std::max(1.0, std::ceil(length * steps_per_pass / spacing)));
    profile.step = length / static_cast<double>(pieces);
    RowDeviations row = deviations_along(as_machined, form_of, {from, (to - from) / length, profile.step, pieces + 1});
    profile.deviation = std::move(row.deviation);
    profile.along = std::move(row.along);
    std::size_t run = 0;
    for (std::size_t k = 0; k < profile.deviation.size(); ++k) {
        run = std::isfinite(profile.deviation[k]) ? run + 1 : 0;
        if (run > profile.count) {
            profile.count = run;
            profile.first = k + 1 - run;
        }
    }
    profile.roughness = roughness_of(std::span(profile.deviation).subspan(profile.first, profile.count),
                                     std::span(profile.along).subspan(profile.first, profile.count),
                                     cutoff_for(form_of.surface().step_over));
    return profile;
}

}  // namespace clsurf
