#include "pipeline/log_verdict.h"

#include <cstdint>

#include <fmt/format.h>

#include "core/counted.h"

namespace clsurf {

LogVerdict log_verdict(const Log& log, const Diagnostics& diagnostics, const std::string& program,
                       ProgramIdentity identity) {
    const std::uint64_t errors = diagnostics.count(Severity::error), warnings = diagnostics.count(Severity::warning);
    if (errors > 0) return {false, fmt::format("not usable as it is: {}, see below", counted(errors, "error"))};
    if (warnings > 0) return {false, fmt::format("usable with care: {}, see below", counted(warnings, "warning"))};
    std::string text = "OK: ";
    if (!program.empty() && diagnostics.count("map.distance") > 0) {
        // If the log covered only a part of the program, or belonged to another program, there would be a warning.
        text += fmt::format("a run of {}{}, all of it, ", identity == ProgramIdentity::same ? "the unmodified " : "",
                            program);
    } else if (!program.empty()) {
        text += fmt::format("not compared with {}, ", program);
    }
    // Without a clock, lost records are visible as jumps only.
    text +=
        fmt::format("a record every {:g} ms, no {}", log.period * 1e3, log.find("time") != nullptr ? "gaps" : "jumps");
    return {true, text};
}

}  // namespace clsurf
