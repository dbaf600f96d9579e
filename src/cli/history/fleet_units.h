#pragma once
// The units of a fleet: for each run the arguments of `clsurf history DB add …`.

#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/options.h"

namespace clsurf::cli {

struct FleetUnit {
    std::string program, log;
    std::vector<std::string> words;  ///< options: those for judging, --param and --time
    std::uint64_t bytes = 0;         ///< size of the log's file; 0: missing
};

/// The options for judging and recording a run.
void declare_unit(po::options_description& options);

/// The units that the arguments name: RUNS.toml, a folder, or --program and --log. Options of the command line override
/// those of a run, and these override those at the top of the file. Throws UsageError, InputError.
[[nodiscard]] std::vector<FleetUnit> read_fleet_units(const po::variables_map& values);

/// The words after `clsurf history` that judge and record a unit.
[[nodiscard]] std::vector<std::string> words_of_unit(const FleetUnit& unit, const std::string& database);

/// Commands that do the same on any machine with access to the files, one per line. Each makes its own database in `folder`.
[[nodiscard]] std::string task_lines(const std::vector<FleetUnit>& units, const std::string& folder);

}  // namespace clsurf::cli
