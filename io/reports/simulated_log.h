#pragma once
// What the simulator makes, as a BIIP log and as a JSON report.

#include <optional>
#include <span>
#include <string>

#include "io/formats/biip.h"
#include "machine/fidelity.h"
#include "simulation/run/five_axis_simulator.h"
#include "simulation/run/simulator.h"

namespace clsurf::io {

/// A simulated run written as it is made, in the memory of a block. The file appears with close().
class SimulatedLogWriter {
public:
    /// `metadata` is a JSON object's text. Throws SystemError.
    SimulatedLogWriter(const std::string& path, const Machine& machine, const std::string& metadata);
    /// Throws SystemError (disk full).
    void append(std::span<const SimulatedPoint> points);
    /// Of a machine with rotary axes.
    void append(std::span<const FiveAxisPoint> points);
    void close() { writer_.close(); }

private:
    Kinematics kinematics_;
    BiipWriter writer_;
    std::string records_;
};

/// With rotary axes: theirs beside x, y, z in deg, and orientation_error_deg, rounds.
[[nodiscard]] std::string simulation_json(const FiveAxisSummary& summary, const Kinematics& kinematics,
                                          const Diagnostics& diagnostics, const std::optional<Fidelity>& fidelity = {});

/// The keys: duration_s, points, max, path_deviation_mm, limits_ok, points_ruled_by, limit_share [%], fidelity, diagnostics.
[[nodiscard]] std::string simulation_json(const SimulationSummary& summary, const Diagnostics& diagnostics,
                                          const std::optional<Fidelity>& fidelity = {});

}  // namespace clsurf::io
