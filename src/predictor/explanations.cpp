#include "predictor/explanations.h"

#include <algorithm>
#include <map>

namespace clsurf {

void Explanations::add(const std::vector<DefectRun>& runs, PointIndex room) {
    for (const DefectRun& run : runs)
        stretches_.push_back({run.points.first - room, run.points.last + room, 0, added_});
    ++added_;
    sorted_ = false;
}

void Explanations::sort() {
    if (sorted_) return;
    std::sort(stretches_.begin(), stretches_.end(),
              [](const Stretch& a, const Stretch& b) { return a.first < b.first; });
    PointIndex farthest = 0;
    for (Stretch& s : stretches_) s.farthest = farthest = std::max(farthest, s.last);
    sorted_ = true;
}

bool Explanations::explain(std::span<const Suspect* const> sites) {
    sort();
    struct Inside {
        std::size_t sites = 0;
        PointIndex last = -1;  ///< that was counted
    };
    std::map<std::size_t, Inside> inside;
    for (const Suspect* s : sites) {
        auto at = std::upper_bound(stretches_.begin(), stretches_.end(), s->point,
                                   [](PointIndex p, const Stretch& b) { return p < b.first; });
        while (at != stretches_.begin() && (--at)->farthest >= s->point) {
            Inside& in = inside[at->found];
            if (at->last < s->point || in.last == s->point) continue;
            in.last = s->point;
            if (2 * ++in.sites >= sites.size()) return true;
        }
    }
    return false;
}

}  // namespace clsurf
