#pragma once
// A part from files: program, log, and the references between them.

#include <optional>
#include <string>

#include "io/formats/log_format.h"
#include "io/readers/program_file.h"
#include "pipeline/part.h"
#include "pipeline/stages.h"
#include "pipeline/survey.h"

namespace clsurf::io {

struct PartFiles {
    std::string program;  ///< empty: the log has no program
    std::string log;
    ProgramOptions program_options;  ///< `coordinates` is ignored: a part is in workpiece coordinates
    LogOptions log_options;
    bool recorded_tool = true;  ///< if the rules name no tool, take it from the metadata or the tool table
    std::optional<Source> log_source = std::nullopt;  ///< content of the log; nullopt: read the file `log`
};

/// The tool in a log's metadata; nullopt: none is given. Throws InputError: not a tool.
[[nodiscard]] std::optional<CuttingTool> tool_of_log(const Log& log);
/// The common shape of all tools that a program calls, from a tool table; nullopt: several shapes, or not known. Throws
/// InputError: the table cannot be read.
[[nodiscard]] std::optional<CuttingTool> tool_of_table(const std::string& path, const Program& program);

/// Sets kinematics, limits and machine from a machine file. Throws InputError.
void use_machine(const std::string& path, PartRules& rules);

/// Reads both and assembles them (pipeline/part.h). `rules.identity` is set from the hashes in the log. Throws
/// InputError: a file that cannot be read or used, a log of another program; UsageError: an unknown dialect or format.
[[nodiscard]] Part read_part(const PartFiles& files, PartRules rules = {}, const Stages& stages = {});
[[nodiscard]] Part read_part(const std::string& program, const std::string& log, const PartRules& rules = {});

/// Reads the files of a surveyed part (pipeline/survey.h). Throws as read_part() and surveyed_part() do.
[[nodiscard]] Part read_surveyed_part(const PartFiles& files, const PartRules& rules, const Survey& survey,
                                      const Stages& stages = {});

}  // namespace clsurf::io
