#pragma once
// The difference between a recorded run and its simulation.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/run_difference.h"
#include "machine/machine.h"
#include "pipeline/part.h"
#include "predictor/defect.h"

namespace clsurf {

struct RunFidelity {
    std::string log;
    double duration = 0, simulated_duration = 0;  ///< [s] from the first to the last motion, of the aligned sections
    double time_error = 0;                        ///< simulated over recorded time, minus 1
    double compared = 0;                          ///< share of the log's path, 0 … 1
    double usual_speed = 0;                       ///< [mm/s] 95th percentile of the cutting speed
    double speed_error_p50 = 0, speed_error_p95 = 0;         ///< [mm/s] |difference| at the same place
    std::optional<double> following_error_p95;               ///< [mm] |difference| at the same place
    std::optional<double> following_error;                   ///< [mm] of the log, over 95 % of the path
    std::size_t defects_logged = 0, logged_found = 0;        ///< defects of the log; found by the simulation
    std::size_t defects_simulated = 0, simulated_found = 0;  ///< defects of the simulation; found in the log

    [[nodiscard]] std::optional<double> recall() const;
    [[nodiscard]] std::optional<double> precision() const;
};

/// A recorded run with the data that every comparison needs. `part` must outlive the object. On five axes the tip is
/// compared.
class RecordedRun {
public:
    explicit RecordedRun(const Part& part);

    /// Simulates the program on a machine; returns it as a part in the same coordinates. Without feedback if the log has
    /// none. Throws what simulate() throws.
    [[nodiscard]] Part simulated(const Machine& machine) const;
    /// Simulation minus log at the points of the log. O(points of both).
    [[nodiscard]] RunDifferences differences(const Part& simulation) const;
    /// All differences, including defects. O(points of both), parallel.
    [[nodiscard]] RunFidelity fidelity(const Machine& machine) const;

    [[nodiscard]] const Part& part() const { return *part_; }
    [[nodiscard]] const ClSurface& surface() const { return surface_; }

private:
    const Part* part_;
    ClSurface surface_;
};

/// The worst of the runs; recall and precision are those of the defects of all runs; nullopt: there are none.
[[nodiscard]] std::optional<Fidelity> summary_of(std::span<const RunFidelity> runs, FidelityBasis basis);

}  // namespace clsurf
