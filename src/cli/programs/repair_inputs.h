#pragma once
// What `optimize` repairs, with which machine, and on which runs.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"
#include "io/readers/fitted_machine.h"
#include "repair/controller_repair.h"

namespace clsurf::cli {

/// What a program is repaired from.
struct RepairInputs {
    OptimizeRules rules;
    Machine machine;
    std::string machine_origin;  ///< a clause
    std::optional<Log> measured;
    std::vector<EarlierRound> rounds;
    io::TextReader reader;
    Program program;
};

/// Throws UsageError and InputError.
[[nodiscard]] RepairInputs read_repair_inputs(const po::variables_map& values, Diagnostics& diagnostics);

/// By simulation, on the user's controller, or with the logs of earlier rounds, as the options ask.
[[nodiscard]] Optimized run_repair(const po::variables_map& values, RepairInputs& in, const Progress& progress,
                                   Diagnostics& diagnostics);

}  // namespace clsurf::cli
