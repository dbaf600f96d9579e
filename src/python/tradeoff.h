#pragma once
// Time against surface: a program at many settings of its machine.

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "python/calls.h"
#include "tradeoff/front.h"

namespace clsurf::python {

struct TradeoffOptions {
    std::array<double, 3> start{};   ///< where the axes stand before the program [mm]
    double more_time_percent = 50;   ///< settings that take longer than this more are left out
    int runs = 48;                   ///< simulations at most
    std::optional<double> weight{};  ///< of the surface, 0 … 1: chooses
};

/// Throws UsageError unless it is nothing or 0 … 1.
void require_weight(const std::optional<double>& weight);

/// The JSON that `clsurf simulate --tradeoff` writes, and the machine file of the settings that the weight chooses; empty: no weight.
/// Throws UsageError; InputError: the program cannot be run, or has no adjacent passes.
[[nodiscard]] std::pair<std::string, std::string> trade_off_settings(const PartOptions& options,
                                                                     const TradeoffOptions& tradeoff);

}  // namespace clsurf::python
