#include "cli/options/known_tool.h"

#include <fmt/format.h>

#include "io/readers/part_file.h"

namespace clsurf::cli {

void declare_tool(po::options_description& options) {
    declare_tool(
        options,
        "the tool, diameter and corner radius in mm; places are then contact points on the part, otherwise tool tips (default: from the log's metadata or --tools)");
}

void declare_tool(po::options_description& options, const char* meaning) {
    options.add_options()("tool", po::value<std::string>()->value_name("ball:D|bull:D,R|flat:D|none"), meaning);
}

ToolChoice read_tool(const po::variables_map& values) {
    ToolChoice choice;
    if (values.count("tools") > 0) choice.table = values["tools"].as<std::string>();
    if (values.count("tool") == 0) return choice;
    const std::string tool = values["tool"].as<std::string>();
    choice.none = tool == "none";
    if (!choice.none) {
        try {
            choice.tool = parse_tool(tool);
        } catch (const UsageError& error) { throw UsageError(fmt::format("--tool: {}", error.what()), error.hint()); }
    }
    choice.by_config = !given(values, "tool");
    return choice;
}

std::optional<CuttingTool> find_tool(const ToolChoice& choice, const Log* log, const Program* program,
                                     Diagnostics& diagnostics) {
    const bool given = choice.tool || choice.none;
    if (given && !choice.by_config) return choice.tool;
    if (const std::optional<CuttingTool> recorded = log != nullptr ? io::tool_of_log(*log) : std::nullopt) {
        if (given && choice.tool != recorded)
            note_overruled(diagnostics, *log, "tool", choice.tool ? to_text(*choice.tool) : "none", to_text(*recorded));
        return recorded;
    }
    if (given) return choice.tool;
    if (choice.table.empty() || program == nullptr) return std::nullopt;
    return io::tool_of_table(choice.table, *program);
}

}  // namespace clsurf::cli
