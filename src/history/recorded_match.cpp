#include "history/recorded_match.h"

#include <algorithm>
#include <limits>

namespace clsurf {
namespace {

constexpr double same_place = 5;  // [mm]

struct Pair {
    double distance = 0;  ///< [mm]
    std::size_t known = 0, defect = 0;
};

bool share_lines(const RecordedDefect& a, const RecordedDefect& b) {
    return std::ranges::any_of(a.sections, [&](const RecordedSection& s) {
        return std::ranges::any_of(b.sections, [&](const RecordedSection& t) {
            return s.first_line != 0 && t.first_line != 0 && s.first_line <= t.last_line && t.first_line <= s.last_line;
        });
    });
}

/// [mm] Infinite: they are different defects.
double distance_between(const RecordedDefect& a, const RecordedDefect& b) {
    if (a.cause != b.cause || a.systematic != b.systematic) return std::numeric_limits<double>::infinity();
    if (a.systematic) return 0;  // a defect of the whole part
    const double distance = (a.tip - b.tip).norm();
    return distance <= same_place || share_lines(a, b) ? distance : std::numeric_limits<double>::infinity();
}

}  // namespace

std::string_view name_of(DefectState state) {
    switch (state) {
        case DefectState::unchanged: return "unchanged";
        case DefectState::worse: return "worse";
        case DefectState::fresh: return "new";
    }
    return {};
}

std::size_t RecordedMatch::worsened() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(states, [](DefectState state) { return state != DefectState::unchanged; }));
}

RecordedMatch match_recorded(std::span<const RecordedDefect> known, std::span<const RecordedDefect> defects) {
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < known.size(); ++k) {
        for (std::size_t d = 0; d < defects.size(); ++d) {
            const double distance = distance_between(known[k], defects[d]);
            if (distance < std::numeric_limits<double>::infinity()) pairs.push_back({distance, k, d});
        }
    }
    std::ranges::stable_sort(pairs, {}, &Pair::distance);
    RecordedMatch match;
    match.known.resize(defects.size());
    match.states.assign(defects.size(), DefectState::fresh);
    std::vector<bool> taken(known.size(), false);
    for (const Pair& pair : pairs) {
        if (taken[pair.known] || match.known[pair.defect]) continue;
        taken[pair.known] = true;
        match.known[pair.defect] = pair.known;
        const bool worse = defects[pair.defect].severity > known[pair.known].severity;
        match.states[pair.defect] = worse ? DefectState::worse : DefectState::unchanged;
    }
    for (std::size_t k = 0; k < known.size(); ++k) {
        if (!taken[k]) match.gone.push_back(k);
    }
    return match;
}

}  // namespace clsurf
