#pragma once
// The simulation that a log comes from, as stated in its metadata.

#include <optional>
#include <string>

#include "log/log.h"
#include "machine/machine.h"

namespace clsurf::io {

/// The machine file of a simulation.
struct SimulationOrigin {
    std::string machine;  ///< its name
    std::optional<Fidelity> fidelity;
};

/// Adds the key `simulation` to `metadata`, the text of a JSON object.
[[nodiscard]] std::string with_simulation(const std::string& metadata, const Machine& machine);

/// nullopt: not a simulated log, or the key is not understood.
[[nodiscard]] std::optional<SimulationOrigin> simulation_origin(const Log& log);

/// Two lines of text, with line ends; empty: not a simulated log.
[[nodiscard]] std::string origin_text(const std::optional<SimulationOrigin>& origin);

}  // namespace clsurf::io
