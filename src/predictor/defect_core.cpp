#include "predictor/defect_core.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr float weak_peak = 0.25F;  ///< share of the strongest peak of its group
constexpr float dip_share = 0.5F;   ///< share of the lower of two peaks: a deeper dip separates them
// With one threshold instead of three, a repaired program had 15 more defects, and none of them said anything new.
constexpr float peak_of_its_own =
    3.0;  ///< share of the threshold that a second peak must reach; weaker ones are after-effects of strong ones

float peak_of(CandidateSpan sites, Quantity quantity) {
    float peak = 0;
    for (const DefectCandidate* s : sites) peak = std::max(peak, s->share[index_of(quantity)]);
    return peak;
}

class CoreFinder {
public:
    CoreFinder(CandidateSpan group, Quantity quantity, const ArcLength& arc_length, double joined)
        : group_(group), quantity_(quantity), arc_length_(arc_length), joined_(joined) {}

    CoreSites find() {
        const float peak = peak_of(group_, quantity_);
        // A pass with a lower peak does not cause the defect.
        const float enough = std::max(std::min(1.0F, half_of_peak * peak), weak_peak * peak);
        CoreSites sites;
        for (const CandidateSpan run : runs_of(group_, arc_length_, joined_)) {
            for (const CandidateSpan bump : bumps_of(run)) {
                if (peak_of(bump, quantity_) < enough)
                    sites.rest.insert(sites.rest.end(), bump.begin(), bump.end());
                else
                    append_strong(bump, sites.core);
            }
        }
        return sites;
    }

private:
    [[nodiscard]] float share(const DefectCandidate* s) const { return s->share[index_of(quantity_)]; }
    [[nodiscard]] bool near(const DefectCandidate* a, const DefectCandidate* b) const {
        return !arc_length_.at_least(a->point, b->point, joined_);
    }

    /// The shares of a run, with dips shorter than joined_ filled (a morphological closing).
    [[nodiscard]] std::vector<float> filled(CandidateSpan run) const {
        std::vector<float> shares;
        shares.reserve(run.size());
        for (const DefectCandidate* s : run) shares.push_back(share(s));
        for (std::size_t i = 0; i < run.size(); ++i) {
            for (std::size_t j = i + 2; j < run.size() && near(run[i], run[j]); ++j) {
                const float level = std::min(share(run[i]), share(run[j]));
                for (std::size_t k = i + 1; k < j; ++k) shares[k] = std::max(shares[k], level);
            }
        }
        return shares;
    }

    /// A run of a motion, cut at the bottom of each dip between two peaks. Heights are not cut, because they oscillate after
    /// their cause.
    [[nodiscard]] std::vector<CandidateSpan> bumps_of(CandidateSpan run) const {
        if (quantity_ == Quantity::normal_deviation || quantity_ == Quantity::relief) return {run};
        const std::vector<float> shares = filled(run);
        std::vector<CandidateSpan> bumps;
        std::size_t first = 0, bottom = 0;
        float peak = 0;
        for (std::size_t k = 0; k < run.size(); ++k) {
            const float level = dip_share * std::min(peak, shares[k]);
            if (shares[k] >= peak_of_its_own && shares[bottom] <= level) {
                bumps.push_back(run.subspan(first, bottom - first));
                first = bottom;
                peak = 0;
            }
            if (shares[k] >= peak || shares[k] < shares[bottom]) bottom = k;  // the lowest since the peak
            peak = std::max(peak, shares[k]);
        }
        bumps.push_back(run.subspan(first));
        return bumps;
    }

    void append_strong(CandidateSpan bump, DefectCandidates& core) const {
        const float least = half_of_peak * peak_of(bump, quantity_);
        for (std::size_t k = 0; k < bump.size(); ++k) {
            if (share(bump[k]) < least) continue;
            std::size_t last = k;
            for (std::size_t j = k + 1; j < bump.size() && near(bump[last], bump[j]); ++j) {
                if (share(bump[j]) >= least) last = j;
            }
            core.insert(core.end(), bump.begin() + static_cast<std::ptrdiff_t>(k),
                        bump.begin() + static_cast<std::ptrdiff_t>(last) + 1);
            k = last;
        }
    }

    CandidateSpan group_;
    Quantity quantity_;
    const ArcLength& arc_length_;
    double joined_;  ///< [mm]
};

/// The sites of a run on one side of its strongest one.
class Flank {
public:
    Flank(Quantity quantity, const ArcLength& arc_length, double joined)
        : quantity_(quantity), arc_length_(arc_length), joined_(joined) {}

    /// The arc length [mm] from `from` to the last of the sites `next` that belongs to the flank, up to `enough`.
    template <class Iterator>
    [[nodiscard]] double length(const DefectCandidate* from, Iterator next, Iterator end, float peak,
                                double enough) const {
        const double begin = arc_length_.to(from->point);
        double length = 0;
        for (const DefectCandidate* at = from; next != end && length < enough; at = *next++) {
            if (!goes_on(at, *next, peak)) break;
            length = std::abs(arc_length_.to((*next)->point) - begin);
        }
        return length;
    }

private:
    [[nodiscard]] bool goes_on(const DefectCandidate* at, const DefectCandidate* next, float peak) const {
        const std::size_t q = index_of(quantity_);
        return next->pass == at->pass && next->share[q] >= 1 && next->share[q] <= peak &&
               (at->comparison.residual[q] < 0) == (next->comparison.residual[q] < 0) &&
               !arc_length_.at_least(at->point, next->point, joined_);
    }

    Quantity quantity_;
    const ArcLength& arc_length_;
    double joined_;  ///< [mm]
};

}  // namespace

double length_above_threshold(CandidateSpan core, CandidateSpan sites, Quantity quantity, const ArcLength& arc_length,
                              double joined, double enough) {
    const Flank flank(quantity, arc_length, joined);
    double length = 0;
    for (const CandidateSpan run : runs_of(core, arc_length, joined)) {
        if (length >= enough) break;
        length += arc_length.to(run.back()->point) - arc_length.to(run.front()->point);
        const float peak = peak_of(run, quantity);
        const auto first = static_cast<std::ptrdiff_t>(index_by_point(sites, run.front()->point));
        const auto after = static_cast<std::ptrdiff_t>(index_by_point(sites, run.back()->point + 1));
        length += flank.length(run.back(), sites.begin() + after, sites.end(), peak, enough - length);
        length += flank.length(run.front(), sites.rend() - first, sites.rend(), peak, enough - length);
    }
    return length;
}

std::vector<CandidateSpan> runs_of(CandidateSpan sites, const ArcLength& arc_length, double joined) {
    std::vector<CandidateSpan> runs;
    for (std::size_t k = 0; k < sites.size();) {
        std::size_t end = k + 1;
        while (end < sites.size() && sites[end]->pass == sites[k]->pass &&
               !arc_length.at_least(sites[end - 1]->point, sites[end]->point, joined))
            ++end;
        runs.push_back(sites.subspan(k, end - k));
        k = end;
    }
    return runs;
}

CoreSites core_of(CandidateSpan group, Quantity quantity, const ArcLength& arc_length, double joined) {
    return CoreFinder(group, quantity, arc_length, joined).find();
}

}  // namespace clsurf
