#pragma once
// The runs of a fleet: a TOML file that lists them, or a folder that is searched for them (docs/howto/fleet.md).

#include <string>
#include <vector>

#include "io/readers/config_entry.h"

namespace clsurf::io {

struct FleetRun {
    std::string program, log;             ///< program empty: none was found for the log
    std::vector<ConfigEntry> options;     ///< options of this run only
    std::vector<std::string> parameters;  ///< "tool=D6R3"
    std::string time;                     ///< empty: the time of the log's file
};

struct FleetFile {
    std::vector<ConfigEntry> options;  ///< options for all runs
    std::vector<FleetRun> runs;
};

/// A file with a table `[[run]]` per run: program, log, time, parameters, and names of options. Options at the top apply
/// to all runs. File names are relative to its folder. Throws InputError with file and line.
[[nodiscard]] FleetFile read_fleet_file(const std::string& path);

/// Every log in a folder and its subfolders, each with its program: the one whose name without extension is the longest
/// prefix of the log's name, preferably in the log's folder; otherwise the only program of that folder. Sorted by
/// name. Throws InputError: no such folder, no log in it.
[[nodiscard]] FleetFile find_fleet_runs(const std::string& folder);

}  // namespace clsurf::io
