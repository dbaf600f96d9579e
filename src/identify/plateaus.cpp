#include "identify/plateaus.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clsurf {
namespace {

constexpr double level_width = 0.003;    ///< the values of a plateau differ by at most this share plus rounding
constexpr double most_exceeding = 0.01;  ///< share of the large values that may exceed a level
constexpr double least_large = 0.25;     ///< share of a level from which a value is large
constexpr double most_of_level = 1.02;   ///< factor of a level from which a value exceeds it

/// Whether values rise to [first, last) and fall after it no faster than within it. The top of a ramp up and a ramp down,
/// which a jerk limit causes, is not a level.
bool is_peak(const std::vector<double>& values, std::size_t first, std::size_t last) {
    constexpr double steeper = 4;
    const std::size_t reach = (last - first) / 2;
    if (reach == 0 || first < reach || last + reach > values.size()) return false;
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first),
               end = values.begin() + static_cast<std::ptrdiff_t>(last);
    const auto [low, high] = std::minmax_element(begin, end);
    const double sign = *low + *high < 0 ? -1 : 1;
    const double top = sign > 0 ? *high : -*low, inside = *high - *low;
    const double before = top - sign * values[first - reach], after = top - sign * values[last - 1 + reach];
    return before > inside && after > inside && std::max(before, after) < steeper * inside;
}

/// Equal moves have equal plateaus, for any reason.
bool at_varied_speeds(const std::vector<Plateau>& plateaus) {
    constexpr double varied = 0.05;
    const auto [slowest, fastest] = std::minmax_element(
        plateaus.begin(), plateaus.end(), [](const Plateau& a, const Plateau& b) { return a.speed < b.speed; });
    return fastest->speed - slowest->speed > varied * fastest->speed;
}

}  // namespace

void PlateauFinder::add(std::span<const std::vector<double>> all, std::size_t own, std::span<const double> speeds,
                        std::span<const char> allowed) {
    const std::vector<double>& values = all[own];
    for (const double value : values) {
        const double share = greatest_ > 0 ? std::abs(value) / greatest_ : 0;
        ++bins_[std::min(bin_count - 1, static_cast<std::size_t>(share * (bin_count - 1)))];
    }
    std::size_t first = 0;
    while (first < values.size()) {
        double sum = values[first];
        std::size_t last = first + 1;
        const auto counts = [&](std::size_t i) { return allowed.empty() || allowed[i] != 0; };
        while (last < values.size() && counts(last)) {
            const double mean = sum / static_cast<double>(last - first);
            if (std::abs(values[last] - mean) > error_ + level_width * std::abs(mean)) break;
            sum += values[last++];
        }
        const auto count = static_cast<PointIndex>(last - first);
        // At both ends the values may still change towards the level.
        const auto quarter = static_cast<std::ptrdiff_t>((last - first) / 4);
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first) + quarter;
        const auto end = values.begin() + static_cast<std::ptrdiff_t>(last) - quarter;
        const double level = std::abs(std::accumulate(begin, end, 0.0)) / static_cast<double>(end - begin);
        if (count >= least_ && level > 0.1 * greatest_ && level > 5 * error_ && counts(first) &&
            !(ramps_ && is_peak(values, first, last))) {
            Plateau plateau{level, count, {}, 0};
            const std::size_t middle = first + (last - first) / 2;
            for (std::size_t q = 0; q < all.size(); ++q)
                plateau.at_middle[q] = static_cast<float>(std::abs(all[q][middle]));
            plateau.speed = static_cast<float>(speeds[middle]);
            plateaus_.push_back(plateau);
        }
        first = last;
    }
}

std::size_t PlateauFinder::bin_of(double value) const {
    return std::min(bin_count - 1, static_cast<std::size_t>(std::ceil(value / greatest_ * (bin_count - 1))));
}

double PlateauFinder::exceeding(double level) const {
    PointIndex above = 0, large = 0;
    for (std::size_t k = bin_of(least_large * level); k < bin_count; ++k) large += bins_[k];
    for (std::size_t k = bin_of(most_of_level * level + 2 * error_) + 1; k < bin_count; ++k) above += bins_[k];
    return large > 0 ? static_cast<double>(above) / static_cast<double>(large) : 0;
}

double PlateauFinder::excess(double level) const {
    constexpr PointIndex one_of = 1000;
    const std::size_t first = bin_of(least_large * level);
    std::size_t bin = bin_of(most_of_level * level + 2 * error_);
    const PointIndex large = std::accumulate(bins_.begin() + static_cast<std::ptrdiff_t>(first),
                                             bins_.begin() + static_cast<std::ptrdiff_t>(bin) + 1, PointIndex{0});
    PointIndex above = 0;
    while (bin > first && (above += bins_[bin]) * one_of <= large) --bin;
    return std::max(0.0, greatest_ * static_cast<double>(bin) / (bin_count - 1) - error_ - level);
}

double PlateauFinder::held() const {
    double greatest = 0;
    for (const Plateau& plateau : plateaus_) greatest = std::max(greatest, plateau.level);
    return greatest;
}

double PlateauFinder::nearly_greatest() const {
    constexpr PointIndex one_of = 1000;
    const PointIndex moving = std::accumulate(bins_.begin() + 1, bins_.end(), PointIndex{0});
    PointIndex above = 0;
    std::size_t bin = bin_count - 1;
    while (bin > 0 && (above += bins_[bin]) * one_of <= moving) --bin;
    return greatest_ * static_cast<double>(bin) / (bin_count - 1);
}

std::optional<PlateauFinder::Level> PlateauFinder::highest(std::size_t places, bool varied) const {
    std::vector<Plateau> sorted = plateaus_;
    std::sort(sorted.begin(), sorted.end(), [](const Plateau& a, const Plateau& b) { return a.level > b.level; });
    for (std::size_t top = 0; top + places <= sorted.size(); ++top) {
        const double low = sorted[top].level * (1 - level_width) - error_;
        if (sorted[top + places - 1].level < low) continue;
        Level found;
        double sum = 0, squares = 0, records = 0;
        for (std::size_t k = top; k < sorted.size() && sorted[k].level >= low; ++k) {
            found.plateaus.push_back(sorted[k]);
            const auto weight = static_cast<double>(sorted[k].count);
            sum += weight * sorted[k].level;
            squares += weight * sorted[k].level * sorted[k].level;
            records += weight;
        }
        found.value = sum / records;
        const double spread = std::sqrt(std::max(0.0, squares / records - found.value * found.value));
        // Differences between levels have causes that averaging does not remove. If the motion slightly exceeds the level,
        // the planner keeps its plateaus below the limit.
        found.standard_error =
            std::max({spread, 0.3 * error_ / std::sqrt(records), 1e-6 * found.value, excess(found.value)});
        if (exceeding(found.value) > most_exceeding) return std::nullopt;
        // A higher level that is kept in other places refutes the limit, however rare it is.
        constexpr std::size_t refuting = 2;
        if (top >= refuting && sorted[refuting - 1].level > most_of_level * found.value + 2 * error_)
            return std::nullopt;
        if (varied && !at_varied_speeds(found.plateaus)) return std::nullopt;
        return found;
    }
    return std::nullopt;
}

}  // namespace clsurf
