#pragma once
// What a log says of the simulation that made it.

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

/// `metadata`, the text of a JSON object, with the key `simulation`.
[[nodiscard]] std::string with_simulation(const std::string& metadata, const Machine& machine);

/// nullopt: the log is not of a simulation, or does not say so in a form that is understood.
[[nodiscard]] std::optional<SimulationOrigin> simulation_origin(const Log& log);

/// Two lines for people, with their ends; empty: not of a simulation.
[[nodiscard]] std::string origin_text(const std::optional<SimulationOrigin>& origin);

}  // namespace clsurf::io
