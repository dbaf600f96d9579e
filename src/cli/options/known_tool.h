#pragma once
// The cutting tool, from the first source that states it: --tool, the log's metadata, the config file, the tool table.

#include <optional>
#include <string>

#include "cli/options/options.h"
#include "log/log.h"
#include "machined/tool.h"
#include "program/program.h"

namespace clsurf::cli {

struct ToolChoice {
    std::optional<CuttingTool> tool;  ///< --tool
    bool none = false;                ///< --tool none: overrides all other sources
    bool by_config = false;           ///< from the config file: the log's metadata take precedence
    std::string table;                ///< --tools; empty: none
};

/// --tool.
void declare_tool(po::options_description& options);
/// The same if the tool does not affect positions; `meaning`: its use.
void declare_tool(po::options_description& options, const char* meaning);
/// Throws UsageError: not a tool.
[[nodiscard]] ToolChoice read_tool(const po::variables_map& values);

/// The first of: the command line, the log's metadata, the config file, the tool table if all tools that the
/// program calls have one shape. `log`, `program`: nullptr if there is none. If the config file contradicts
/// the log, a note is added. Throws InputError: the metadata or the table cannot be read.
[[nodiscard]] std::optional<CuttingTool> find_tool(const ToolChoice& choice, const Log* log, const Program* program,
                                                   Diagnostics& diagnostics);

}  // namespace clsurf::cli
