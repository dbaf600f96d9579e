#pragma once
// The tool that cut, from whatever states it: --tool, the log's metadata, the config file, the tool table.

#include <optional>
#include <string>

#include "cli/options/options.h"
#include "log/log.h"
#include "machined/tool.h"
#include "program/program.h"

namespace clsurf::cli {

struct ToolChoice {
    std::optional<CuttingTool> tool;  ///< --tool
    bool none = false;                ///< --tool none: whatever else tells one
    bool by_config = false;           ///< not on the command line but in the config file: the log knows better
    std::string table;                ///< --tools; empty: none
};

/// --tool.
void declare_tool(po::options_description& options);
/// The same where it does not tell places; `meaning`: what it is for.
void declare_tool(po::options_description& options, const char* meaning);
/// Throws UsageError: not a tool.
[[nodiscard]] ToolChoice read_tool(const po::variables_map& values);

/// The first of: the command line, the log's metadata, the config file, the tool table where all tools that the
/// program calls have one shape. `log`, `program`: nullptr where there is none. A config file that says something
/// else than the log adds a note. Throws InputError: the metadata or the table cannot be read.
[[nodiscard]] std::optional<CuttingTool> find_tool(const ToolChoice& choice, const Log* log, const Program* program,
                                                   Diagnostics& diagnostics);

}  // namespace clsurf::cli
