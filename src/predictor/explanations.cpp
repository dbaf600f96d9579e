#include "predictor/explanations.h"

#include <algorithm>
#include <map>

namespace clsurf {

void Explanations::add(const std::vector<DefectRun>& runs, PointIndex room) {
    for (const DefectRun& run : runs) sections_.push_back({run.points.first - room, run.points.last + room, 0, added_});
    ++added_;
    sorted_ = false;
}

void Explanations::sort() {
    if (sorted_) return;
    std::sort(sections_.begin(), sections_.end(), [](const Section& a, const Section& b) { return a.first < b.first; });
    PointIndex farthest = 0;
    for (Section& s : sections_) s.farthest = farthest = std::max(farthest, s.last);
    sorted_ = true;
}

bool Explanations::explain(std::span<const DefectCandidate* const> sites) {
    sort();
    struct Inside {
        std::size_t sites = 0;
        PointIndex last = -1;  ///< that was counted
    };
    std::map<std::size_t, Inside> inside;
    for (const DefectCandidate* s : sites) {
        auto at = std::upper_bound(sections_.begin(), sections_.end(), s->point,
                                   [](PointIndex p, const Section& b) { return p < b.first; });
        while (at != sections_.begin() && (--at)->farthest >= s->point) {
            Inside& in = inside[at->found];
            if (at->last < s->point || in.last == s->point) continue;
            in.last = s->point;
            if (2 * ++in.sites >= sites.size()) return true;
        }
    }
    return false;
}

}  // namespace clsurf
