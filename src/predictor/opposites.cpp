#include "predictor/opposites.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/point_ranges.h"
#include "predictor/defect_core.h"

namespace clsurf {
namespace {

constexpr std::size_t fewest_alternating = 3;
constexpr double alternating_share = 0.9;
constexpr float clear_share = 0.5F;  ///< share of the run's peak; a weaker site takes the sign of the one before it
constexpr int changes_of_swing =
    2;  ///< changes of sign of a height along a pass (three half-waves); for a speed one is enough: it falls and rises
constexpr float isolated_share = 0.5F;  ///< share of its residual by which a pass differs from the passes on both sides

/// Connected sites of one pass with one sign.
struct SignedRun {
    std::size_t first = 0, end = 0;  ///< indices into the core
    bool above = false;
    std::size_t strongest = 0;
};

class Splitter {
public:
    Splitter(const DefectCandidates& core, Quantity quantity, const Signals& signals, const ArcLength& arc_length,
             double along)
        : core_(core), quantity_(index_of(quantity)), signals_(signals), arc_length_(arc_length), along_(along) {}

    std::vector<DefectCandidates> split() {
        std::size_t first = 0;
        for (const CandidateSpan run : runs_of(core_, arc_length_, along_)) {
            const std::size_t end = first + run.size();
            if (cut_at_signs(first, end) >= (quantity_ == index_of(Quantity::speed) ? 1 : changes_of_swing))
                return {core_};
            first = end;
        }
        const std::array<float, 2> peak{peak_of(false), peak_of(true)};
        if (peak[0] == 0 || peak[1] == 0) return {core_};
        const bool weaker = peak[1] < peak[0];
        if (is_edge(weaker) || alternates()) return {core_};
        std::vector<DefectCandidates> parts(2);
        for (const SignedRun& run : runs_) {
            DefectCandidates& part = parts[run.above ? 1 : 0];
            part.insert(part.end(), core_.begin() + static_cast<std::ptrdiff_t>(run.first),
                        core_.begin() + static_cast<std::ptrdiff_t>(run.end));
        }
        return parts;
    }

private:
    [[nodiscard]] float residual(std::size_t k) const { return core_[k]->comparison.residual[quantity_]; }

    /// Appends the runs of one sign within a run of sites. Returns how often the sign changes.
    int cut_at_signs(std::size_t first, std::size_t end) {
        float peak = 0;
        for (std::size_t k = first; k < end; ++k) peak = std::max(peak, std::abs(residual(k)));
        int changes = -1;
        for (std::size_t k = first; k < end; ++k) {
            const bool clear = std::abs(residual(k)) >= clear_share * peak;
            if (changes < 0 || (clear && (residual(k) > 0) != runs_.back().above)) {
                runs_.push_back({k, k, residual(k) > 0, k});
                ++changes;
            }
            SignedRun& run = runs_.back();
            run.end = k + 1;
            if (std::abs(residual(k)) > std::abs(residual(run.strongest))) run.strongest = k;
        }
        return changes;
    }

    /// Whether the sign alternates with the direction of travel, on three runs or more: the lag of a zigzag.
    [[nodiscard]] bool alternates() const {
        const auto forward = signals_.feed(core_[runs_.front().strongest]->point);
        std::size_t as_first = 0;
        for (const SignedRun& run : runs_) {
            const bool along = signals_.feed(core_[run.strongest]->point).dot(forward) > 0;
            if (along == (run.above == runs_.front().above)) ++as_first;
        }
        return runs_.size() >= fewest_alternating &&
               static_cast<double>(as_first) >= alternating_share * static_cast<double>(runs_.size());
    }

    [[nodiscard]] float peak_of(bool above) const {
        float peak = 0;
        for (const SignedRun& run : runs_) {
            if (run.above == above) peak = std::max(peak, std::abs(residual(run.strongest)));
        }
        return peak;
    }

    /// Whether the runs of that sign are the other side of an edge: each is adjacent to one of the opposite sign and agrees
    /// with the pass on its other side.
    [[nodiscard]] bool is_edge(bool above) const {
        std::vector<PointRange> others;  // ascending, as the core
        for (const SignedRun& run : runs_) {
            if (run.above != above) others.push_back({core_[run.first]->point, core_[run.end - 1]->point});
        }
        const auto touches = [&](const PathLocation& at) { return at.exists() && any_has(others, at.nearest()); };
        return std::all_of(runs_.begin(), runs_.end(), [&](const SignedRun& run) {
            if (run.above != above) return true;
            const Comparison& c = core_[run.strongest]->comparison;
            if (c.lesser_step[quantity_] >= isolated_share * std::abs(c.residual[quantity_])) return false;
            return touches(c.adjacent_left) || touches(c.adjacent_right);
        });
    }

    const DefectCandidates& core_;
    std::size_t quantity_;
    const Signals& signals_;
    const ArcLength& arc_length_;
    double along_;
    std::vector<SignedRun> runs_;
};

}  // namespace

std::vector<DefectCandidates> split_opposites(const DefectCandidates& core, Quantity quantity, const Signals& signals,
                                              const ArcLength& arc_length, double along) {
    return Splitter(core, quantity, signals, arc_length, along).split();
}

}  // namespace clsurf
