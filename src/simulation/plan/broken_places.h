#pragma once
// BrokenPlaces: where the speeds of an AxisSpeedProblem break a limit between the samples of their cells. On a FiveAxisPath
// derivatives vary within a cell, with every rounded joint.

#include <cstddef>
#include <span>
#include <vector>

#include "simulation/path/path_stream.h"
#include "simulation/plan/five_axis_limits.h"
#include "simulation/plan/speed_problem.h"

namespace clsurf {

/// Of the parameter u of a path [mm]; `why`: what limits its speed.
struct FiveAxisCell {
    double begin = 0, length = 0;
    LimitingFactor why = LimitingFactor::none;
};

inline constexpr std::size_t samples_of_cell = 4;  ///< its end not counted, equally far apart

class BrokenPlaces {
public:
    using Between = AxisSpeedProblem<5>::Between;

    /// All must outlive it. `cells`: those of the problem, in order; `places`: those of the path from the first to the last.
    BrokenPlaces(const FiveAxisLimits& limits, const AxisSpeedProblem<5>& problem, std::span<const FiveAxisCell> cells,
                 std::span<const LimitPlace> places);

    /// In the order of cells. The problem's values may change from call to call. Looked at are samples, places of the path, what
    /// lies halfway between them, dips of the pace, and what is around the greatest shares of a limit among these.
    [[nodiscard]] std::vector<Between> find() const;

private:
    struct Seen {
        Between place;
        double share = 0;  ///< of the limit that the values take most of
    };
    /// Places that follow each other.
    struct Sequence {
        std::size_t begin, end;
    };

    [[nodiscard]] double u_of(const Between& place) const { return cells_[place.cell].begin + place.sample.at; }
    [[nodiscard]] Between place_at(std::size_t cell, double u) const;
    [[nodiscard]] Between place_between(const Between& before, const Between& after, double u) const;
    void add_cell(std::size_t cell, std::span<const LimitPlace> places);
    void add_dip(const Between& before, const Between& after);
    [[nodiscard]] Seen see(const Between& place) const;
    [[nodiscard]] Seen look_around(Seen before, Seen peak, Seen after) const;

    const FiveAxisLimits* limits_;
    const AxisSpeedProblem<5>* problem_;
    std::span<const FiveAxisCell> cells_;
    std::vector<Between> places_;      ///< where it is looked
    std::vector<Sequence> sequences_;  ///< of each cell, then of each dip
};

}  // namespace clsurf
