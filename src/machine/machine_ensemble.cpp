#include "machine/machine_ensemble.h"

#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "machine/planning_value.h"

namespace clsurf {
namespace {

bool is_acceleration(std::string_view key) { return key == "max_acceleration" || key == "max_normal_acceleration"; }

/// Assumed uncertainties of a machine whose file gives none.
std::vector<ParameterUncertainty> assumed_uncertainty(const Kinematics& kinematics) {
    std::vector<std::string> axes(axis_names.begin(), axis_names.end());
    if (kinematics.has_rotary()) {
        axes.emplace_back(1, kinematics.tilt.letter);
        axes.emplace_back(1, kinematics.rotation.letter);
    }
    std::vector<ParameterUncertainty> rows;
    for (const std::string& axis : axes) {
        rows.push_back({"max_acceleration", axis, assumed_acceleration_error});
        rows.push_back({"max_jerk", axis, assumed_jerk_error});
    }
    rows.push_back({"max_acceleration", "path", assumed_acceleration_error});
    rows.push_back({"max_normal_acceleration", "path", assumed_acceleration_error});
    rows.push_back({"max_jerk", "path", assumed_jerk_error});
    return rows;
}

/// Standard normal, the same on every platform: the sum of twelve uniform numbers, minus six.
double draw_normal(std::mt19937_64& random) {
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += static_cast<double>(random() >> 11) * 0x1p-53;
    return sum;
}

/// Index of a machine among `count` machines.
struct Turn {
    std::size_t number, count;
};

/// The index of a machine's alternative among `size`: each in turn, or, if there are more alternatives than machines, evenly
/// spaced ones.
std::size_t alternative(Turn turn, std::size_t size) {
    const auto [number, count] = turn;
    return count >= size ? number % size : (2 * (number % count) + 1) * size / (2 * count);
}

void draw(const ParameterUncertainty& known, double speed_error, Turn turn, std::mt19937_64& random, Machine& machine) {
    const double normal = draw_normal(random);
    const std::optional<double> value = planning_value(machine, known.key, known.of);
    if (!value) return;
    const double now = *value;
    const auto set = [&](double drawn) { set_planning_value(machine, known.key, known.of, drawn); };
    if (!known.alternatives.empty()) return set(known.alternatives[alternative(turn, known.alternatives.size())]);
    if (known.lower_bound > 0 && known.lower_bound < now) {
        const double share = 0.5 * std::erfc(-normal / std::sqrt(2.0));
        set(known.lower_bound * std::pow(now / known.lower_bound, share));
        return;
    }
    const double added = is_acceleration(known.key) ? speed_error : 0;
    set(now * std::exp(std::hypot(known.relative_error, added) * normal));
}

}  // namespace

std::vector<Machine> machines_drawn_from(const Machine& machine, int count) {
    const std::vector<ParameterUncertainty> rows =
        machine.uncertainty.empty() ? assumed_uncertainty(machine.kinematics) : machine.uncertainty;
    const double speed_error = machine.fidelity ? machine.fidelity->speed_error_p95_ratio : 0;
    std::vector<Machine> drawn(static_cast<std::size_t>(count), machine);
    for (std::size_t k = 0; k < drawn.size(); ++k) {
        std::mt19937_64 random(k + 1);
        // The offset by the row avoids one machine with the lowest alternatives of all values.
        for (std::size_t row = 0; row < rows.size(); ++row)
            draw(rows[row], speed_error, {k + row, drawn.size()}, random, drawn[k]);
    }
    return drawn;
}

}  // namespace clsurf
