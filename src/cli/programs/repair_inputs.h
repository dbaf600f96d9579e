#pragma once
// The inputs of `optimize`: the program, its machine, and its runs.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"
#include "io/readers/fitted_machine.h"
#include "repair/controller_repair.h"

namespace clsurf::cli {

/// The inputs of the repair of a program.
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

/// Repairs by simulation, on the user's controller, or with the logs of earlier rounds, depending on the options.
[[nodiscard]] Optimized run_repair(const po::variables_map& values, RepairInputs& in, const Progress& progress,
                                   Diagnostics& diagnostics);

}  // namespace clsurf::cli
