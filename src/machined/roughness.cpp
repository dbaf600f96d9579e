#include "machined/roughness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "core/vectorised.h"

namespace clsurf {
namespace {

const double alpha = std::sqrt(std::numbers::ln2 / std::numbers::pi);  ///< a wave as long as the cut-off is halved
// Sampling lengths and cut-offs of ISO 4288, and the tolerance of the step-over: docs/formed.md#definitions, Ra.
constexpr int most_lengths = 5;

struct CutoffClass {
    double above = 0;  ///< [mm] lower limit of the step-over
    double cutoff = 0;
};
constexpr std::array<CutoffClass, 2> wide_cutoffs{{{1.3, 8}, {0.4, 2.5}}};
constexpr double usual_cutoff = 0.8;  ///< [mm]
constexpr double scatter = 1.02;      ///< factor for the error of a step-over that is estimated from positions

/// Adds to each place the values `off` steps before and after it, with a weight.
CLSURF_VECTORISED void add_shifted(std::span<const double> z, std::size_t off, double weight,
                                   std::vector<double>& line) {
    const double* const from = z.data();
    double* const to = line.data();
    const std::size_t count = z.size() - off;
    for (std::size_t k = 0; k < count; ++k) to[k + off] += weight * from[k];
    for (std::size_t k = 0; k < count; ++k) to[k] += weight * from[k + off];
}

/// z(along) at other distances. Both lists increase; except for rounding, the others are within the ends of `along`.
std::vector<double> interpolated(std::span<const double> z, std::span<const double> along,
                                 std::span<const double> others) {
    std::vector<double> result(others.size());
    std::size_t next = 1;
    for (std::size_t k = 0; k < others.size(); ++k) {
        while (next + 1 < along.size() && along[next] < others[k]) ++next;
        const double share = std::clamp((others[k] - along[next - 1]) / (along[next] - along[next - 1]), 0.0, 1.0);
        result[k] = z[next - 1] + share * (z[next] - z[next - 1]);
    }
    return result;
}

/// The same number of places in equal steps, including both ends. Domain: at least two places.
std::vector<double> equal_steps(std::span<const double> along) {
    std::vector<double> places(along.size());
    const double step = (along.back() - along.front()) / static_cast<double>(along.size() - 1);
    for (std::size_t k = 0; k < places.size(); ++k) places[k] = along.front() + static_cast<double>(k) * step;
    return places;
}

}  // namespace

ProfileHeights profile_heights(std::span<const double> z) {
    if (z.empty()) return {};
    const auto n = static_cast<double>(z.size());
    double mean = 0;
    for (const double v : z) mean += v / n;
    ProfileHeights h;
    for (const double v : z) {
        h.ra += std::abs(v - mean) / n;
        h.rq += (v - mean) * (v - mean) / n;
    }
    h.rq = std::sqrt(h.rq);
    const auto [low, high] = std::minmax_element(z.begin(), z.end());
    h.rz = *high - *low;
    return h;
}

std::vector<double> gaussian_mean_line(std::span<const double> z, double step, double cutoff) {
    // Beyond one cut-off the weight is below 10^-6 of that in the middle.
    const auto half = static_cast<std::ptrdiff_t>(cutoff / step);
    std::vector<double> weights(static_cast<std::size_t>(half) + 1);
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const double x = static_cast<double>(k) * step / (alpha * cutoff);
        weights[k] = std::exp(-std::numbers::pi * x * x);
    }
    // Sum of the weights of the places within some steps on one side.
    std::vector<double> beside(weights.size());
    for (std::size_t k = 1; k < weights.size(); ++k) beside[k] = beside[k - 1] + weights[k];
    std::vector<double> line(z.begin(), z.end());
    for (std::size_t k = 1; k < std::min(weights.size(), z.size()); ++k) add_shifted(z, k, weights[k], line);
    for (std::size_t i = 0; i < z.size(); ++i)
        line[i] /= 1 + beside[std::min(i, weights.size() - 1)] + beside[std::min(z.size() - 1 - i, weights.size() - 1)];
    return line;
}

std::vector<double> gaussian_mean_line(std::span<const double> z, std::span<const double> along, double cutoff) {
    if (z.size() < 2) return {z.begin(), z.end()};
    const std::vector<double> places = equal_steps(along);
    const std::vector<double> line = gaussian_mean_line(interpolated(z, along, places), places[1] - places[0], cutoff);
    return interpolated(line, places, along);
}

double cutoff_for(double step_over) {
    for (const CutoffClass& c : wide_cutoffs)
        if (step_over > scatter * c.above) return c.cutoff;
    return usual_cutoff;
}

std::string cutoff_text(double cutoff) {
    for (const CutoffClass& c : wide_cutoffs)
        if (cutoff == c.cutoff)
            return fmt::format("cut-off {:g} mm (ISO 4288, step-over above {:g} mm)", cutoff, c.above);
    return fmt::format("cut-off {:g} mm (ISO 4288, step-over up to {:g} mm)", cutoff, wide_cutoffs.back().above);
}

Roughness roughness_of(std::span<const double> z, double step, double cutoff) {
    Roughness result;
    result.cutoff = cutoff;
    if (z.size() < 2) return result;
    const std::vector<double> line = gaussian_mean_line(z, step, cutoff);
    std::vector<double> rough(z.size());
    for (std::size_t k = 0; k < z.size(); ++k) rough[k] = z[k] - line[k];
    const double length = step * static_cast<double>(z.size());
    const int whole = std::min(most_lengths, static_cast<int>(std::floor(length / cutoff - 1 + 1e-9)));
    result.sampling_lengths = std::max(1, whole);
    const auto each = whole >= 1 ? static_cast<std::size_t>(std::lround(cutoff / step)) : z.size();
    const std::size_t used = std::min(z.size(), each * static_cast<std::size_t>(result.sampling_lengths));
    const std::size_t first = (z.size() - used) / 2;
    for (std::size_t k = first; k < first + used; ++k) {
        result.ra += std::abs(rough[k]);
        result.rq += rough[k] * rough[k];
    }
    result.ra /= static_cast<double>(used);
    result.rq = std::sqrt(result.rq / static_cast<double>(used));
    for (int s = 0; s < result.sampling_lengths; ++s) {
        const std::size_t begin = first + static_cast<std::size_t>(s) * each;
        const std::size_t end = std::min(first + used, begin + each);
        result.rz += profile_heights(std::span(rough).subspan(begin, end - begin)).rz / result.sampling_lengths;
    }
    result.length = step * static_cast<double>(used);
    return result;
}

Roughness roughness_of(std::span<const double> z, std::span<const double> along, double cutoff) {
    if (z.size() < 2) return roughness_of(z, cutoff, cutoff);
    const std::vector<double> places = equal_steps(along);
    return roughness_of(interpolated(z, along, places), places[1] - places[0], cutoff);
}

AreaHeights area_heights(std::span<const float> z, std::span<const float> weights) {
    AreaHeights h;
    // As in docs/formed.md#definitions, Sz.
    constexpr float counts = 0.5F;
    const auto weight = [&](std::size_t k) { return weights.empty() ? 1.0F : weights[k]; };
    double sum = 0;
    double all = 0;
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (std::size_t k = 0; k < z.size(); ++k) {
        const float v = z[k], w = weight(k);
        if (!(v == v) || !(w > 0)) continue;
        if (w >= counts) {
            low = std::min(low, v);
            high = std::max(high, v);
        }
        sum += static_cast<double>(w) * v;
        all += w;
        ++h.cells;
    }
    if (!(all > 0)) return {};
    const double mean = sum / all;
    for (std::size_t k = 0; k < z.size(); ++k) {
        if (!(z[k] == z[k])) continue;
        const double share = weight(k) / all;
        h.sa += share * std::abs(z[k] - mean);
        h.sq += share * (z[k] - mean) * (z[k] - mean);
    }
    h.sq = std::sqrt(h.sq);
    h.sz = high > low ? static_cast<double>(high) - low : 0;
    return h;
}

}  // namespace clsurf
