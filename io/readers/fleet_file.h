#pragma once
// The runs of a fleet: a TOML file that lists them, or a folder in which they are found (docs/howto/fleet.md).

#include <string>
#include <vector>

#include "io/readers/config_entry.h"

namespace clsurf::io {

struct FleetRun {
    std::string program, log;             ///< program empty: none was found for the log
    std::vector<ConfigEntry> options;     ///< its own
    std::vector<std::string> parameters;  ///< "tool=D6R3"
    std::string time;                     ///< empty: that of the log's file
};

struct FleetFile {
    std::vector<ConfigEntry> options;  ///< of all runs
    std::vector<FleetRun> runs;
};

/// A file with a table `[[run]]` for each run: program, log, time, parameters, and names of options; options at the top are
/// for all runs. Names of files are relative to its folder. Throws InputError with file and line.
[[nodiscard]] FleetFile read_fleet_file(const std::string& path);

/// Every log in a folder and those below it, each with its program: the one whose name, without its ending, is the longest
/// beginning of the log's name, one in the log's own folder first; else the only program of that folder. In the order of
/// their names. Throws InputError: no such folder, no log in it.
[[nodiscard]] FleetFile find_fleet_runs(const std::string& folder);

}  // namespace clsurf::io
