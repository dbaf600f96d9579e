#include "predictor/chord_effect.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/block_portions.h"

namespace clsurf {
namespace {

constexpr std::size_t of_relief = index_of(Quantity::relief);
/// Share of the stronger relief: a relief h causes −h/2 next to it; with some margin for noise.
/// A pass that is itself off by −p has a share of (p + h/2) / (h + p/2).
constexpr float most_of_chord = 0.6F;

class ChordEffects {
public:
    /// `reliefs`: the candidates with a relief, in the order of their points.
    ChordEffects(const DefectCandidates& reliefs, const Passes& passes, const ArcLength& arc_length, double along)
        : reliefs_(reliefs), passes_(passes), arc_length_(arc_length), along_(along) {}

    [[nodiscard]] bool is_one(const DefectCandidate& candidate) const {
        const Comparison& c = candidate.comparison;
        const bool pit = c.residual[of_relief] < 0;
        const float most =
            most_of_chord * std::max(peak_near(c.adjacent_left, !pit), peak_near(c.adjacent_right, !pit));
        return most > 0 && peak_near({candidate.point, 0}, pit) <= most;
    }

private:
    /// The largest relief of one sign on the pass of a place, up to `along` from it [mm].
    [[nodiscard]] float peak_near(const PathLocation& place, bool pit) const {
        if (!place.exists()) return 0;
        const std::size_t pass = pass_of(passes_, place.nearest());
        float peak = 0;
        for (const DefectCandidate* s : candidates_near(reliefs_, place.nearest(), arc_length_, along_)) {
            const float relief = s->comparison.residual[of_relief];
            if (s->pass == pass && (relief < 0) == pit) peak = std::max(peak, std::abs(relief));
        }
        return peak;
    }

    const DefectCandidates& reliefs_;
    const Passes& passes_;
    const ArcLength& arc_length_;
    double along_;  ///< [mm]
};

}  // namespace

void take_chord_effects(const Passes& passes, const ArcLength& arc_length, double along, FoundCandidates& found,
                        const ForgetBlocks& forget) {
    const std::vector<DefectCandidate*> all = found.with_share_of(Quantity::relief);
    const DefectCandidates reliefs(all.begin(), all.end());
    const ChordEffects effects(reliefs, passes, arc_length, along);
    std::vector<DefectCandidate*> taken;  // removed after the search, so that one removal does not change the others
    for_each_portion(
        all.size(), forget, [&](std::size_t k) { return all[k]->point; },
        [&](std::size_t first, std::size_t end) {
            std::copy_if(all.begin() + static_cast<std::ptrdiff_t>(first),
                         all.begin() + static_cast<std::ptrdiff_t>(end), std::back_inserter(taken),
                         [&](const DefectCandidate* c) { return effects.is_one(*c); });
        });
    for (DefectCandidate* candidate : taken)
        candidate->share[of_relief] = candidate->score[of_relief] = candidate->comparison.residual[of_relief] = 0;
}

}  // namespace clsurf
