#pragma once
// The result of the simulation as a BIIP log and as a JSON report.

#include <optional>
#include <span>
#include <string>

#include "io/formats/biip.h"
#include "machine/fidelity.h"
#include "simulation/run/five_axis_simulator.h"
#include "simulation/run/simulator.h"

namespace clsurf::io {

/// Writes a simulated run block by block, in the memory of one block. The file appears with close().
class SimulatedLogWriter {
public:
    /// `metadata`: the text of a JSON object. Throws SystemError.
    SimulatedLogWriter(const std::string& path, const Machine& machine, const std::string& metadata);
    /// Throws SystemError (disk full).
    void append(std::span<const SimulatedPoint> points);
    /// For a machine with rotary axes.
    void append(std::span<const FiveAxisPoint> points);
    void close() { writer_.close(); }

private:
    Kinematics kinematics_;
    BiipWriter writer_;
    std::string records_;
};

/// With rotary axes: their values in deg next to x, y, z, and orientation_error_deg, rounds.
[[nodiscard]] std::string simulation_json(const FiveAxisSummary& summary, const Kinematics& kinematics,
                                          const Diagnostics& diagnostics, const std::optional<Fidelity>& fidelity = {});

/// Keys: duration_s, points, max, path_deviation_mm, limits_ok, points_ruled_by, limit_share [%], fidelity, diagnostics.
[[nodiscard]] std::string simulation_json(const SimulationSummary& summary, const Diagnostics& diagnostics,
                                          const std::optional<Fidelity>& fidelity = {});

}  // namespace clsurf::io
