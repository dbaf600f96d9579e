#pragma once
// Plateaus of a quantity: where it stays at one level over consecutive records. A limit shows as the highest level that is
// held in several places and hardly ever exceeded.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/point.h"

namespace clsurf {

inline constexpr std::size_t most_quantities = 7;  ///< six axes and the path

/// Consecutive records at one level.
struct Plateau {
    double level = 0;  ///< mean of the absolute values
    PointIndex count = 0;
    std::array<float, most_quantities> beside{};  ///< absolute values of all quantities in its middle
    float speed = 0;                              ///< of the path in its middle
};

/// The plateaus of one quantity and how its values are distributed.
class PlateauFinder {
public:
    /// `error`: the most that a value is off by rounding; `least`: records of a plateau; `greatest`: of all values.
    /// `ramps`: the next derivative has a limit, too, so that the top of two ramps may look like a plateau.
    PlateauFinder(double error, PointIndex least, double greatest, bool ramps)
        : error_(error), least_(least), greatest_(greatest), ramps_(ramps), bins_(bin_count, 0) {}

    /// A piece of consecutive values. `all[q][i]`: every quantity, of which this is number `own`; `speeds` of the path.
    /// `allowed`: where a plateau counts; empty: everywhere. O(values).
    void add(std::span<const std::vector<double>> all, std::size_t own, std::span<const double> speeds,
             std::span<const char> allowed);

    struct Level {
        double value = 0, standard_error = 0;
        std::vector<Plateau> plateaus;
    };
    /// The highest level that at least `places` plateaus share, that hardly a value exceeds, and beyond which the motion stays
    /// at no other level; nullopt: none. `varied`:
    /// and that is held at different speeds of the path.
    [[nodiscard]] std::optional<Level> highest(std::size_t places, bool varied) const;
    /// The value that one of a thousand others exceeds, zeros not counted: outliers are no evidence.
    [[nodiscard]] double nearly_greatest() const;
    /// The highest level of a single plateau; 0: there is none.
    [[nodiscard]] double held() const;

private:
    static constexpr std::size_t bin_count = 4096;
    [[nodiscard]] std::size_t bin_of(double value) const;
    [[nodiscard]] double exceeding(double level) const;  ///< share of the large values that exceed it
    /// How far the values go beyond a level that hardly one exceeds, without rounding and the greatest of a thousand.
    [[nodiscard]] double excess(double level) const;

    double error_;
    PointIndex least_;
    double greatest_;
    bool ramps_;
    std::vector<PointIndex> bins_;
    std::vector<Plateau> plateaus_;
};

}  // namespace clsurf
