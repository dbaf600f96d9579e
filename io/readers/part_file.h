#pragma once
// A part from files: program, log, and what they say of each other.

#include <optional>
#include <string>

#include "io/formats/log_format.h"
#include "io/readers/program_file.h"
#include "pipeline/part.h"
#include "pipeline/stages.h"
#include "pipeline/survey.h"

namespace clsurf::io {

struct PartFiles {
    std::string program;  ///< empty: the log comes alone
    std::string log;
    ProgramOptions program_options;  ///< `coordinates` is not asked: a part's are those of the workpiece
    LogOptions log_options;
    bool recorded_tool = true;  ///< where the rules name no tool, the one of the log's metadata or the tool table
    std::optional<Source> log_source = std::nullopt;  ///< bytes of the log; nullopt: those of the file `log`
};

/// The tool that a log's metadata name; nullopt: they name none. Throws InputError: not a tool.
[[nodiscard]] std::optional<CuttingTool> tool_of_log(const Log& log);
/// The one shape of all tools that a program calls, by a tool table's file; nullopt: several, or not known. Throws
/// InputError: the table cannot be read.
[[nodiscard]] std::optional<CuttingTool> tool_of_table(const std::string& path, const Program& program);

/// Kinematics, limits and machine of a machine file. Throws InputError.
void use_machine(const std::string& path, PartRules& rules);

/// Reads both and assembles them (pipeline/part.h). `rules.identity` is set from the hashes that the log carries. Throws
/// InputError: a file that cannot be read or used, a log of another program; UsageError: an unknown dialect or format.
[[nodiscard]] Part read_part(const PartFiles& files, PartRules rules = {}, const Stages& stages = {});
[[nodiscard]] Part read_part(const std::string& program, const std::string& log, const PartRules& rules = {});

/// Reads the files of a part that was surveyed (pipeline/survey.h). Throws as read_part() and surveyed_part() do.
[[nodiscard]] Part read_surveyed_part(const PartFiles& files, const PartRules& rules, const Survey& survey,
                                      const Stages& stages = {});

}  // namespace clsurf::io
