#include "mapping/path_walk.h"

namespace clsurf {

PathWalk::PathWalk(const Toolpath& path) : path_(path) {
    const auto n = static_cast<std::size_t>(path.size());
    length_.resize(n);
    for (std::size_t i = 0; i < n; ++i) length_[i] = path.length(static_cast<std::int64_t>(i));
}

WalkState PathWalk::advance(const WalkState& from, const Vec3& p, double chord, std::int64_t last) const {
    WalkState best = from;
    WalkWindow<double> window(chord);
    double gone = -from.fraction * length(from.motion);  // arc length to the start of motion m
    for (std::int64_t m = from.motion; m <= last; ++m) {
        const bool moves = length(m) > 0;
        if (moves || m == from.motion) {
            const Projection projection = path_.projection(m, p, m == from.motion ? from.fraction : 0.0);
            if (window.is_better(projection.distance, gone + projection.fraction * length(m)))
                best = {m, projection.fraction, projection.distance};
        }
        gone += length(m);
        if (window.ends_before(gone)) break;
    }
    return best;
}

}  // namespace clsurf
