#pragma once
// Plateaus of a quantity: consecutive records at one level. A limit is visible as the highest level that is kept in several
// places and hardly ever exceeded.

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
    std::array<float, most_quantities> at_middle{};  ///< absolute values of all quantities in its middle
    float speed = 0;                                 ///< path speed in its middle
};

/// The plateaus of one quantity and the distribution of its values.
class PlateauFinder {
public:
    /// `error`: greatest error of a value by rounding; `least`: fewest records of a plateau; `greatest`: of all values.
    /// `ramps`: the next derivative also has a limit, so the top of two ramps may look like a plateau.
    PlateauFinder(double error, PointIndex least, double greatest, bool ramps)
        : error_(error), least_(least), greatest_(greatest), ramps_(ramps), bins_(bin_count, 0) {}

    /// Adds a piece of consecutive values. `all[q][i]`: every quantity; `own`: the number of this quantity; `speeds`: speeds
    /// along the path. `allowed`: where a plateau counts; empty: everywhere. O(values).
    void add(std::span<const std::vector<double>> all, std::size_t own, std::span<const double> speeds,
             std::span<const char> allowed);

    struct Level {
        double value = 0, standard_error = 0;
        std::vector<Plateau> plateaus;
    };
    /// The highest level that at least `places` plateaus share, that hardly any value exceeds, and above which there is no
    /// other level. nullopt: there is none. `varied`: the level must also be kept at different path speeds.
    [[nodiscard]] std::optional<Level> highest(std::size_t places, bool varied) const;
    /// The value that is exceeded by one in a thousand, without zeros: outliers are no evidence.
    [[nodiscard]] double nearly_greatest() const;
    /// The highest level of a single plateau; 0: there is none.
    [[nodiscard]] double held() const;

private:
    // 1/4096 of the greatest value is a twelfth of level_width.
    static constexpr std::size_t bin_count = 4096;
    [[nodiscard]] std::size_t bin_of(double value) const;
    [[nodiscard]] double exceeding(double level) const;  ///< share of the large values above it
    /// The greatest excess of values over a level that is hardly exceeded, without rounding and outliers.
    [[nodiscard]] double excess(double level) const;

    double error_;
    PointIndex least_;
    double greatest_;
    bool ramps_;
    std::vector<PointIndex> bins_;
    std::vector<Plateau> plateaus_;
};

}  // namespace clsurf
