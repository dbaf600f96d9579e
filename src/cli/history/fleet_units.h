#pragma once
// The units of a fleet: for each run the words of `clsurf history DB add …`.

#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/options.h"

namespace clsurf::cli {

struct FleetUnit {
    std::string program, log;
    std::vector<std::string> words;  ///< options, as words: those of its judging, --param and --time
    std::uint64_t bytes = 0;         ///< of the log's file; 0: not there
};

/// The options of a judged run and of its recording.
void declare_unit(po::options_description& options);

/// Those that the arguments name: RUNS.toml, a folder, or --program and --log. Options of the command line come before
/// those of a run, and these before those at the top of the file. Throws UsageError, InputError.
[[nodiscard]] std::vector<FleetUnit> read_fleet_units(const po::variables_map& values);

/// The words after `clsurf history` that judge and record a unit.
[[nodiscard]] std::vector<std::string> words_of_unit(const FleetUnit& unit, const std::string& database);

/// Commands that do the same on any machine that sees the files, one a line: each makes a database of its own in `folder`.
[[nodiscard]] std::string task_lines(const std::vector<FleetUnit>& units, const std::string& folder);

}  // namespace clsurf::cli
