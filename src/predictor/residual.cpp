#include "predictor/residual.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/not_finite.h"
#include "predictor/median_of.h"

namespace clsurf {
namespace {

constexpr std::size_t most_values = 10;   ///< most values around a place; passes_aside on each side
constexpr std::size_t fewest_values = 2;  ///< fewest values for a median
constexpr std::size_t fewest_clean = 3;   ///< reliefs that outvote one that an adjacent fault has changed
constexpr std::size_t border_passes = 2;  ///< passes on one side; the outermost one has no relief
// The sum over adjacent passes is zero for a displaced pass, and at an edge at least as large as the relief.
constexpr float shape_left = 0.35F;  ///< share of a relief: if more remains in the sum, it is the shape of the part
constexpr float edge_share = 0.6F;   ///< share of the largest relief around: a smaller one is next to an edge
// The reliefs have the ratio 1/2 if the fault is on that pass, and 2 if it is on this one
// (docs/design/predictor.md#at-the-border).
constexpr float nearer_to_border =
    1.33F;  ///< times the opposite relief of the pass towards the border: up to this, the fault is on that pass

float median_of_known(std::span<const float> values, std::size_t fewest = fewest_values) {
    return median_of(values, fewest, [](float v) { return v; });
}

std::size_t known(std::span<const float> values) {
    return static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [](float v) { return v == v; }));
}

/// Passes on both sides that have a value, from the farthest left one to the farthest right one.
struct KnownPasses {
    std::array<float, most_values> value{};
    std::array<float, most_values> place{};  ///< number of passes away, negative on the left
    std::size_t count = 0;

    KnownPasses(std::span<const float> left, std::span<const float> right) {
        for (std::size_t k = left.size(); k > 0; --k) add(left[k - 1], -static_cast<float>(k));
        for (std::size_t k = 0; k < right.size(); ++k) add(right[k], static_cast<float>(k + 1));
    }
    void add(float v, float at) {
        if (!(v == v)) return;
        value[count] = v;
        place[count++] = at;
    }

    /// The change from pass to pass that is nearest to 0 between the quartiles.
    [[nodiscard]] float even_change() const {
        std::array<float, most_values> changes{};
        const std::size_t n = count - 1;
        for (std::size_t k = 0; k < n; ++k) changes[k] = (value[k + 1] - value[k]) / (place[k + 1] - place[k]);
        std::sort(changes.begin(), changes.begin() + static_cast<std::ptrdiff_t>(n));
        const std::size_t cut = (n + 1) / 4;
        return std::clamp(0.0F, changes[cut], changes[n - 1 - cut]);
    }
};

/// A relief and those around it, minus the relief of the part there.
struct Reliefs {
    float own = 0;
    std::array<std::array<float, 2>, 2> adjacent{};  ///< of the nearest two on each side; 0: no chord
    float largest = 0;                               ///< largest relief of all around

    [[nodiscard]] bool is_next_to_larger() const { return std::abs(own) < edge_share * largest; }
    [[nodiscard]] bool adds_up(float sum) const { return std::abs(sum) <= shape_left * std::abs(own); }
};

Reliefs reliefs_from(float base, float own, std::span<const float> left, std::span<const float> right) {
    Reliefs result;
    result.own = own - base;
    for (std::size_t side = 0; side < 2; ++side) {
        const std::span<const float> values = side == 0 ? left : right;
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (!(values[k] == values[k])) continue;
            if (k < 2) result.adjacent[side][k] = values[k] - base;
            result.largest = std::max(result.largest, std::abs(values[k] - base));
        }
    }
    return result;
}

/// Whether a relief is the part's own. If one pass is displaced, its neighbours' reliefs have the opposite sign, and the three
/// reliefs sum to about zero. The same holds for two adjacent displaced passes and for every second pass, with four reliefs.
/// At an edge or a fillet the sum is half a step-over times the angle by which the surface turns. Next to one, reliefs can
/// have any sum, but they are smaller than the relief of the edge. Reliefs count from the mean of all around.
bool is_shape(float relief, std::span<const float> left, std::span<const float> right) {
    float sum = relief;
    int count = 1;
    for (const std::span<const float> side : {left, right}) {
        for (const float value : side) {
            if (!(value == value)) continue;
            sum += value;
            ++count;
        }
    }
    const Reliefs r = reliefs_from(sum / static_cast<float>(count), relief, left, right);
    const float three = r.adjacent[0][0] + r.own + r.adjacent[1][0];
    const bool alone = r.adjacent[0][0] == 0 && r.adjacent[1][0] == 0;
    const bool lies_off =
        alone || r.adds_up(three) || r.adds_up(three + r.adjacent[0][1]) || r.adds_up(three + r.adjacent[1][1]);
    return !lies_off || r.is_next_to_larger();
}

/// The median relief of the passes on one side. A pass that is off by d has the relief d, and each adjacent pass −d/2. If these
/// cannot be outvoted, this share of the fault is subtracted: a third of the difference.
float side_median(float relief, std::span<const float> side) {
    if (side.size() >= fewest_clean && known(side) != fewest_values) return median_of_known(side);
    std::array<float, most_values> clean{};
    std::copy(side.begin(), side.end(), clean.begin());
    clean[0] += (relief - side[0]) / 3;
    return median_of_known(std::span(clean).first(side.size()));
}

/// How far a relief is above or below (−) the interval between the medians of its two sides. At the transition from a flat face
/// to a fillet the curvature changes from one pass to the next, and the relief is that of one side or between both. Next to a
/// displaced pass, reliefs have the opposite sign, and those beyond are zero.
float beyond_sides(float relief, std::span<const float> left, std::span<const float> right) {
    const float one = side_median(relief, left), other = side_median(relief, right);
    if (one == one && other == other) return relief - std::clamp(relief, std::min(one, other), std::max(one, other));
    std::array<float, most_values> all{};
    const auto end = std::copy(right.begin(), right.end(), std::copy(left.begin(), left.end(), all.begin()));
    return relief - median_of_known(std::span(all.begin(), end));
}

/// The same next to the border, where the outermost pass has no chord, so that its relief is not known. A relief is a mark if
/// it and the reliefs farther in, `inner`, have the pattern of a fault of this pass (docs/design/predictor.md#at-the-border).
/// `outer`: the relief of the pass between this one and the outermost one; NaN: there is none.
float mark_at_border(float relief, float outer, std::span<const float> inner) {
    const bool few = known(inner) < fewest_values;
    const float base = few ? (outer + inner[0] + relief) / 3 : side_median(relief, inner);
    if (!(base == base)) return missing<float>;
    const Reliefs r = reliefs_from(base, relief, std::span(&outer, 1), inner);
    const auto [next, beyond] = r.adjacent[1];
    const float towards = r.adjacent[0][0];
    if (r.is_next_to_larger()) return 0;
    bool lies_off = false;
    if (outer == outer) {
        const auto of = [&](float beside) {
            return beside * r.own < 0 && std::abs(r.own) < nearer_to_border * std::abs(beside);
        };
        const float three = towards + r.own + next;
        // Displaced: this pass; it and the next one farther in; it and the one towards the border.
        lies_off = !of(towards) && !(few && of(next)) &&
                   (r.adds_up(three) || r.adds_up(three + beyond) || r.adds_up(three + next));
    } else {
        // Displaced: this pass; it and the outermost one; it and the next one farther in.
        lies_off = r.adds_up(r.own + 2 * next) || (r.adds_up(r.own + next) && r.adds_up(beyond)) ||
                   r.adds_up(r.own + next + 2 * beyond);
    }
    return lies_off ? r.own : 0;
}

}  // namespace

float usual_around(float own, std::span<const float> left, std::span<const float> right, float clear_of_scatter) {
    const KnownPasses passes(left, right);
    if (passes.count < fewest_values) return missing<float>;
    std::array<float, most_values> values = passes.value;
    if (passes.count == 2) return std::clamp(own, std::min(values[0], values[1]), std::max(values[0], values[1]));
    const std::span<float> all(values.data(), passes.count);
    if (left.size() == right.size() && passes.count == left.size() + right.size()) return median_of_known(all);
    const float change = passes.even_change();
    for (std::size_t k = 0; k < passes.count; ++k) values[k] -= change * passes.place[k];
    const float middle = median_of_known(all);
    if (left.empty() || right.empty()) return middle;  // other passes cannot confirm that it is a change, not a fault
    for (float& value : all) value = std::abs(value - middle);
    return std::abs(own - middle) <= clear_of_scatter * median_of_known(all) ? own : middle;
}

float relief_mark(float own, std::span<const float> left, std::span<const float> right) {
    if (!(own == own) || left.empty() || right.empty()) return missing<float>;
    const bool outer_left = left.size() < right.size() || (left.size() == right.size() && known(left) < known(right));
    const std::span<const float> outer = outer_left ? left : right, inner = outer_left ? right : left;
    if (outer.size() <= border_passes && known(outer) < fewest_values) return mark_at_border(own, outer[0], inner);
    const std::size_t even = std::min(left.size(), right.size());
    const std::span<const float> one = left.first(even), other = right.first(even);
    return is_shape(own, one, other) ? 0 : beyond_sides(own, one, other);
}

}  // namespace clsurf
