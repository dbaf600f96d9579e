#include "predictor/explanations.h"

#include <algorithm>

#include "core/point_ranges.h"

namespace clsurf {

void Explanations::add(const std::vector<DefectRun>& runs, PointIndex room) {
    for (const DefectRun& run : runs) sections_.push_back({run.points.first - room, run.points.last + room, 0});
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
    const auto inside = [&](const DefectCandidate* s) {
        const auto section = range_at(sections_, s->point);
        return section != sections_.end() && section->first <= s->point && s->point <= section->farthest;
    };
    return 2 * std::count_if(sites.begin(), sites.end(), inside) >= static_cast<std::ptrdiff_t>(sites.size());
}

}  // namespace clsurf
