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

    /// All must outlive it; `cells`: those of the problem, in order.
    BrokenPlaces(const FiveAxisLimits& limits, const AxisSpeedProblem<5>& problem, std::span<const FiveAxisCell> cells)
        : limits_(&limits), problem_(&problem), cells_(cells) {}

    /// In the order of cells; looked at are `places`, those of the path from the first to the last cell, and what lies between
    /// them and the samples.
    [[nodiscard]] std::vector<Between> find(std::span<const LimitPlace> places);

private:
    /// A place that was looked at.
    struct Seen {
        std::size_t cell = 0;
        double u = 0, share = 0;  ///< share: of the limit that the solution takes most of
        double slope = 0;         ///< of the pace
    };

    [[nodiscard]] AxisSample<5> sample_at(std::size_t cell, double u) const;
    [[nodiscard]] Seen see(std::size_t cell, double u) const;
    /// The cell of a place in one of two that follow each other.
    [[nodiscard]] std::size_t cell_of(double u, std::size_t first, std::size_t second) const {
        return u < cells_[second].begin ? first : second;
    }
    void note_broken(const Seen& seen);
    void look_at(std::size_t cell, double u);
    void look_around_dip(const Seen& after);

    const FiveAxisLimits* limits_;
    const AxisSpeedProblem<5>* problem_;
    std::span<const FiveAxisCell> cells_;
    std::vector<Between> broken_;
    Seen last_;
};

}  // namespace clsurf
