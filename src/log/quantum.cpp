#include "log/quantum.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "core/units.h"

namespace clsurf {
namespace {

constexpr double least_quantum = 5e-6;  ///< [mm] or [deg]; finer steps are rounding of the file
constexpr double least_change = 1e-9;   ///< rounding of doubles is not a change
constexpr PointIndex examined = 20'000;

}  // namespace

double quantum_of(const ChannelView& channel) {
    std::vector<double> steps;
    const auto n = static_cast<std::size_t>(std::min(channel.count, examined));
    std::vector<double> values(n);
    copy_block(channel, (channel.count - static_cast<PointIndex>(n)) / 2, values);
    // Second differences: at constant speed the distance per period is not a grid.
    for (std::size_t i = 2; i < n; ++i) {
        const double step = std::abs(values[i] - 2 * values[i - 1] + values[i - 2]);
        if (step > least_change && std::isfinite(step)) steps.push_back(step);
    }
    if (steps.size() < 100) return 0;
    const auto hundredth = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 100);
    std::nth_element(steps.begin(), hundredth, steps.end());
    const double smallest = *std::min_element(steps.begin(), hundredth + 1);
    if (*hundredth >= 50 * smallest || smallest <= least_quantum) return 0;
    // A grid means that nearly all steps are whole multiples of the smallest one.
    std::size_t on_grid = 0;
    for (const double step : steps) {
        const double ratio = step / smallest;
        if (std::abs(ratio - std::round(ratio)) < 0.02) ++on_grid;
    }
    return on_grid > steps.size() * 98 / 100 ? smallest : 0;
}

namespace {

/// Whether nearly all values are whole multiples of a step, within `slack`.
bool on_grid(const std::vector<double>& values, double step, double slack) {
    const auto on = std::count_if(values.begin(), values.end(), [&](double value) {
        return std::abs(value - std::round(value / step) * step) <= slack;
    });
    return static_cast<double>(on) > 0.99 * static_cast<double>(values.size());
}

/// The shortest decimal representation of a 32-bit float, as a number.
double shortest_decimal(float value) {
    std::array<char, 32> text{};
    const char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    double read = 0;
    std::from_chars(text.data(), end, read);
    return read;
}

/// Whether a value was a 32-bit float before it was written as a double or as text: with as many digits as a float
/// needs, or rounded to `step`.
bool was_float(double value, double step) {
    const auto narrow = static_cast<float>(value);
    const double place = std::numeric_limits<float>::epsilon() * std::abs(value);
    const double slack = place > 2 * step ? 0.55 * step : 0;
    return std::abs(value - static_cast<double>(narrow)) <= std::max(slack, 1e-3 * place) ||
           std::abs(value - shortest_decimal(narrow)) <= 1e-3 * place;
}

/// Whether nearly all values satisfy the predicate; most columns fail at once.
template <typename Predicate>
bool nearly_all(const std::vector<double>& values, Predicate&& predicate) {
    std::size_t others = 0;
    return std::ranges::all_of(values, [&](double value) {
        return predicate(value) || static_cast<double>(++others) < 0.01 * static_cast<double>(values.size());
    });
}

bool were_floats(const std::vector<double>& values, double step) {
    return nearly_all(values, [&](double value) { return was_float(value, step); });
}

/// The same for unwrapped positions of a modulo axis (log/turns.h): the values within a turn were 32-bit floats.
bool were_floats_of_a_turn(const std::vector<double>& values, double step) {
    return nearly_all(values, [&](double value) {
        const double within = value - deg_per_turn * std::floor(value / deg_per_turn);
        return was_float(within, step) || was_float(within - deg_per_turn, step);
    });
}

/// The spacing of the numbers of this size in a type.
double last_place(ScalarType type, double size) {
    if (type < ScalarType::f32) return 1;
    return size * (type == ScalarType::f32 ? double{std::numeric_limits<float>::epsilon()}
                                           : std::numeric_limits<double>::epsilon());
}

}  // namespace

double resolution_of(const ChannelView& channel) {
    constexpr PointIndex section_count = 64, section_length = 256;  // records
    constexpr double exact = 1e-3;                                  // share of a step
    std::vector<double> stored, changes;                            // as they are stored, while the axis moves
    double low = 0, high = 0;
    std::vector<double> values(static_cast<std::size_t>(std::min(channel.count, section_length)));
    for (PointIndex s = 0; s < section_count && !values.empty(); ++s) {
        const PointIndex room = channel.count - static_cast<PointIndex>(values.size());
        copy_block(channel, room * s / (section_count - 1), values);
        for (std::size_t i = 1; i < values.size(); ++i) {
            const double value = (values[i] - channel.bias) / channel.scale;
            const double change = (values[i] - values[i - 1]) / channel.scale;
            if (!std::isfinite(value) || !std::isfinite(change) || change == 0) continue;
            low = stored.empty() ? value : std::min(low, value);
            high = stored.empty() ? value : std::max(high, value);
            stored.push_back(value);
            changes.push_back(change);
        }
    }
    // Numbers with few significant digits have a coarser step the greater they are.
    const double size = std::max(std::abs(low), std::abs(high));
    std::vector<double> great;
    std::copy_if(stored.begin(), stored.end(), std::back_inserter(great),
                 [&](double value) { return std::abs(value) >= 0.5 * size; });
    const double place = last_place(channel.type, size);
    double step = place;
    // A step coarser than a tenth of the travel is not a grid.
    for (double decimal = 1e4; decimal > place; decimal /= 10) {
        if (decimal > 0.1 * (high - low) || !on_grid(great, decimal, exact * decimal + 2 * place)) continue;
        step = decimal;
        break;
    }
    if (channel.type == ScalarType::f64 && were_floats(great, step))
        step = std::max(step, last_place(ScalarType::f32, size));
    const double place_of_turn = last_place(ScalarType::f32, deg_per_turn);
    const bool may_be_turns = channel.type == ScalarType::f64 && size > 0.5 * deg_per_turn && step < place_of_turn;
    if (may_be_turns && were_floats_of_a_turn(great, step)) step = place_of_turn;
    // The steps of an encoder are not decimal.
    const double quantum = quantum_of(channel) / std::abs(channel.scale);
    if (quantum > step && on_grid(changes, quantum, 0.02 * quantum + 2 * place)) step = quantum;
    return step * std::abs(channel.scale);
}

}  // namespace clsurf
