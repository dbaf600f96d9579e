#pragma once
// The repair of a program.

#include <string>
#include <utility>

#include "python/calls.h"

namespace clsurf::python {

struct RepairOptions {
    double tolerance = 0.005;      ///< [mm] from the programmed path
    double more_time_percent = 0;  ///< that the new program may take longer
    int machines = 4;              ///< others that it must be better on
    int decimals = 0;              ///< least, of new coordinates; 0: as in the program
    std::string feeds = "searched";
};

/// The report of `clsurf optimize`, as JSON, and the text of the new program; empty: none was accepted. With a log but no
/// machine file, the machine is fitted to the log. Throws UsageError; InputError: the program cannot be run, or has no
/// adjacent passes.
[[nodiscard]] std::pair<std::string, std::string> optimize_program(const PartOptions& options,
                                                                   const RepairOptions& repair);

}  // namespace clsurf::python
