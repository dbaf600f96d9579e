#pragma once
// BrokenPlaces: finds where the speeds of an AxisSpeedProblem exceed a limit between the samples of the cells. On a
// FiveAxisPath derivatives vary within a cell, at every rounded joint.

#include <cstddef>
#include <span>
#include <vector>

#include "simulation/path/path_stream.h"
#include "simulation/plan/five_axis_limits.h"
#include "simulation/plan/speed_problem.h"

namespace clsurf {

/// A cell of the path parameter u [mm]; `why`: the factor that limits its speed.
struct FiveAxisCell {
    double begin = 0, length = 0;
    LimitingFactor why = LimitingFactor::none;
};

inline constexpr std::size_t samples_of_cell = 4;  ///< equally spaced, the end of the cell not counted

class BrokenPlaces {
public:
    using Between = AxisSpeedProblem<5>::Between;

    /// All arguments must outlive the object. `cells`: the cells of the problem, in order; `places`: the places of the path
    /// from the first to the last cell.
    BrokenPlaces(const FiveAxisLimits& limits, const AxisSpeedProblem<5>& problem, std::span<const FiveAxisCell> cells,
                 std::span<const LimitPlace> places);

    /// The places in the order of the cells. The values of the problem may change between calls. Examined are samples,
    /// places of the path, the points halfway between them, minima of the pace, and the surroundings of the greatest shares
    /// of a limit.
    [[nodiscard]] std::vector<Between> find() const;

private:
    struct Seen {
        Between place;
        double share = 0;  ///< greatest share of a limit that the values use
    };
    /// Consecutive places.
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
    std::vector<Between> places_;      ///< places to examine
    std::vector<Sequence> sequences_;  ///< of each cell, then of each minimum of the pace
};

}  // namespace clsurf
