#include "simulation/plan/broken_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clsurf {
namespace {

constexpr int dip_halvings = 24;    ///< of the way in which the pace is least
constexpr double dip_step = 0.125;  ///< between places, of the way over which it is
constexpr int dip_places = 16;      ///< on each side of it

}  // namespace

/// A place within a cell, with what the limits say there.
AxisSample<5> BrokenPlaces::sample_at(std::size_t cell, double u) const {
    AxisSample<5> sample;
    sample.cap = limits_->at(u, sample).free_cap;
    sample.at = u - cells_[cell].begin;
    return sample;
}

BrokenPlaces::Seen BrokenPlaces::see(std::size_t cell, double u) const {
    const AxisSample<5> sample = sample_at(cell, u);
    return {cell, u, problem_->greatest_share(cell, sample), sample.pace.slope};
}

void BrokenPlaces::note_broken(const Seen& seen) {
    if (seen.share > 1) broken_.push_back({seen.cell, sample_at(seen.cell, seen.u)});
}

void BrokenPlaces::look_at(std::size_t cell, double u) {
    const Seen here = see(cell, u);
    note_broken(here);
    if (last_.slope < 0 && here.slope > 0) look_around_dip(here);
    last_ = here;
}

/// Where the tip nearly reverses, its pace falls to next to nothing over a way that may be far shorter than those between
/// the places: it is √(m² + k² d²) at d from where it is least, and √(m/its second derivative) is the length of that way.
void BrokenPlaces::look_around_dip(const Seen& after) {
    const Seen& before = last_;
    double from = before.u, to = after.u;
    for (int k = 0; k < dip_halvings; ++k) {
        const double middle = 0.5 * (from + to);
        (sample_at(cell_of(middle, before.cell, after.cell), middle).pace.slope < 0 ? from : to) = middle;
    }
    const double least = 0.5 * (from + to);
    const Pace pace = sample_at(cell_of(least, before.cell, after.cell), least).pace;
    if (!(pace.curve > 0)) return;
    const double width = std::sqrt(pace.value / pace.curve);
    if (width > 4 * (after.u - before.u)) return;  // the places are close enough
    Seen last, before_last;
    for (int k = -dip_places; k <= dip_places + 1; ++k) {
        const double u = least + dip_step * k * width;
        Seen here;
        if (k <= dip_places && u > cells_[before.cell].begin &&
            u < cells_[after.cell].begin + cells_[after.cell].length)
            here = see(cell_of(u, before.cell, after.cell), u);
        if (last.share >= std::max(here.share, before_last.share)) note_broken(last);
        before_last = std::exchange(last, here);
    }
}

std::vector<BrokenPlaces::Between> BrokenPlaces::find(std::span<const LimitPlace> places) {
    broken_.clear();
    last_ = {};
    auto place = places.begin();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const double begin = cells_[i].begin, length = cells_[i].length;
        double before = begin;
        for (std::size_t k = 1; k <= samples_of_cell; ++k) {
            const double next = begin + length * static_cast<double>(k) / samples_of_cell;
            for (; place != places.end() && place->u < next; ++place) {
                if (place->u <= before) continue;
                look_at(i, 0.5 * (before + place->u));
                look_at(i, place->u);
                before = place->u;
            }
            look_at(i, 0.5 * (before + next));
            before = next;
        }
    }
    // A dip that begins in one cell is looked at from the next one.
    std::ranges::stable_sort(broken_, {}, &Between::cell);
    return std::move(broken_);
}

}  // namespace clsurf
