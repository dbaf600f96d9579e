#include "simulation/plan/broken_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clsurf {
namespace {

constexpr double near_limit = 0.95;  ///< share from which a maximum is refined
// Without these halvings, 24 of 60 random programs exceeded a limit at 0.25 ms, by up to 3 %.
constexpr int peak_halvings = 3;  ///< halvings of the two intervals next to a local maximum of the share
constexpr int dip_halvings = 24;  ///< halvings to find the minimum of the pace
// 33 places within 2 widths of the minimum. Without places in dips, 9 of 12 random programs exceeded a limit at 0.5 ms.
constexpr double dip_step = 0.125;  ///< distance of places, as a share of the width of the dip
constexpr int dip_places = 16;      ///< places on each side of the minimum

}  // namespace

BrokenPlaces::BrokenPlaces(const FiveAxisLimits& limits, const AxisSpeedProblem<5>& problem,
                           std::span<const FiveAxisCell> cells, std::span<const LimitPlace> places)
    : limits_(&limits), problem_(&problem), cells_(cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const double end = cells[i].begin + cells[i].length;
        std::size_t inside = 0;
        while (inside < places.size() && places[inside].u < end) ++inside;
        add_cell(i, places.first(inside));
        places = places.subspan(inside);
    }
    const std::size_t of_cells = places_.size();
    for (std::size_t k = 1; k < of_cells; ++k) {
        if (places_[k - 1].sample.pace.slope < 0 && places_[k].sample.pace.slope > 0)
            add_dip(Between(places_[k - 1]), Between(places_[k]));  // copies, because places are added
    }
}

/// A place within a cell, with the limits there.
BrokenPlaces::Between BrokenPlaces::place_at(std::size_t cell, double u) const {
    Between place{cell, {}};
    place.sample.cap = limits_->at(u, place.sample).free_cap;
    place.sample.at = u - cells_[cell].begin;
    return place;
}

/// In one of two consecutive cells.
BrokenPlaces::Between BrokenPlaces::place_between(const Between& before, const Between& after, double u) const {
    return place_at(u < cells_[after.cell].begin ? before.cell : after.cell, u);
}

/// Adds the samples of a cell, the places within it, and the points halfway between them.
void BrokenPlaces::add_cell(std::size_t cell, std::span<const LimitPlace> places) {
    const double begin = cells_[cell].begin, length = cells_[cell].length;
    const std::size_t first = places_.size();
    double before = begin;
    places_.push_back(place_at(cell, begin));
    const auto add = [&](double u) {
        places_.push_back(place_at(cell, 0.5 * (before + u)));
        places_.push_back(place_at(cell, u));
        before = u;
    };
    auto place = places.begin();
    for (std::size_t k = 1; k <= samples_of_cell; ++k) {
        const double next = begin + length * static_cast<double>(k) / samples_of_cell;
        for (; place != places.end() && place->u < next; ++place) {
            if (place->u > before) add(place->u);
        }
        add(next);
    }
    sequences_.push_back({first, places_.size()});
}

/// If the tip nearly reverses, its pace falls almost to 0 over a distance that may be far shorter than that between the
/// places. At the distance d from the minimum it is √(m² + k² d²), and the width of the dip is √(m/its second derivative).
void BrokenPlaces::add_dip(const Between& before, const Between& after) {
    const double begin = u_of(before), end = u_of(after);
    double from = begin, to = end;
    for (int k = 0; k < dip_halvings; ++k) {
        const double middle = 0.5 * (from + to);
        (place_between(before, after, middle).sample.pace.slope < 0 ? from : to) = middle;
    }
    const double least = 0.5 * (from + to);
    const Pace pace = place_between(before, after, least).sample.pace;
    if (!(pace.curve > 0)) return;
    const double width = std::sqrt(pace.value / pace.curve);
    if (width > 4 * (end - begin)) return;  // the places are close enough
    const std::size_t first = places_.size();
    const double cells_begin = cells_[before.cell].begin,
                 cells_end = cells_[after.cell].begin + cells_[after.cell].length;
    for (int k = -dip_places; k <= dip_places; ++k) {
        const double u = least + dip_step * k * width;
        if (u > cells_begin && u < cells_end) places_.push_back(place_between(before, after, u));
    }
    sequences_.push_back({first, places_.size()});
}

BrokenPlaces::Seen BrokenPlaces::see(const Between& place) const {
    return {place, problem_->greatest_share(place.cell, place.sample)};
}

/// Finds the greatest share near a local maximum of the share. The limit may be exceeded on a small section of the path
/// between two places that keep it.
BrokenPlaces::Seen BrokenPlaces::look_around(Seen before, Seen peak, Seen after) const {
    const auto halfway = [this](const Seen& a, const Seen& b) {
        return see(place_between(a.place, b.place, 0.5 * (u_of(a.place) + u_of(b.place))));
    };
    for (int k = 0; k < peak_halvings; ++k) {
        const Seen left = halfway(before, peak), right = halfway(peak, after);
        if (left.share > std::max(peak.share, right.share)) {
            after = std::exchange(peak, left);
        } else if (right.share > peak.share) {
            before = std::exchange(peak, right);
        } else {
            before = left, after = right;
        }
    }
    return peak;
}

std::vector<BrokenPlaces::Between> BrokenPlaces::find() const {
    std::vector<Between> broken;
    std::vector<double> shares;
    for (const Sequence& sequence : sequences_) {
        const std::span places = std::span(places_).subspan(sequence.begin, sequence.end - sequence.begin);
        shares.clear();
        for (const Between& place : places) shares.push_back(problem_->greatest_share(place.cell, place.sample));
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, places.size() - 1);
            if (shares[i] < std::max({near_limit, shares[before], shares[after]})) continue;
            const Seen peak =
                look_around({places[before], shares[before]}, {places[i], shares[i]}, {places[after], shares[after]});
            if (peak.share > 1) broken.push_back(peak.place);
        }
    }
    // Dips were added after the cells that contain them.
    std::ranges::stable_sort(broken, {}, &Between::cell);
    return broken;
}

}  // namespace clsurf
