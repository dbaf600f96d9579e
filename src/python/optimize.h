#pragma once
// The repair of a program.

#include <optional>
#include <string>

#include "python/calls.h"

namespace clsurf::python {

struct RepairOptions {
    double tolerance = 0.005;      ///< [mm] from the programmed path
    double more_time_percent = 0;  ///< that the new program may take longer
    int machines = 4;              ///< others that it must be better on
    int decimals = 0;              ///< least, of new coordinates; 0: as in the program
    std::string feeds = "searched";
    bool tradeoff = false;           ///< the front of the candidates is reported
    std::optional<double> weight{};  ///< of the surface, 0 … 1: chooses from the front; nothing: the objective does
};

/// What a repair gives.
struct RepairedProgram {
    std::string report;  ///< of `clsurf optimize`, JSON
    std::string text;    ///< of the new program; empty: none was accepted
    std::string front;   ///< the JSON of `clsurf optimize --tradeoff`; empty: neither it nor a weight was asked for
};

/// With a log but no machine file, the machine is fitted to the log. Throws UsageError; InputError: the program cannot be
/// run, or has no adjacent passes.
[[nodiscard]] RepairedProgram optimize_program(const PartOptions& options, const RepairOptions& repair);

}  // namespace clsurf::python
