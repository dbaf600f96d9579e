#include "cli/known_tool.h"

#include <charconv>

#include <fmt/format.h>

#include "io/compressed.h"
#include "io/log_tool.h"
#include "io/tool_table_file.h"

namespace clsurf::cli {
namespace {

std::optional<CuttingTool> tool_of_log(const Log& log) {
    const std::string recorded = io::tool_of_metadata(log.metadata);
    if (recorded.empty()) return std::nullopt;
    try {
        return parse_tool(recorded);
    } catch (const UsageError& error) {
        throw InputError(Place::of_file(log.name), fmt::format("its metadata: {}", error.what()));
    }
}

/// The one shape of all tools that the program calls.
std::optional<CuttingTool> tool_of_table(const ToolTable& table, const Program& program) {
    std::optional<CuttingTool> known;
    for (const ProgramEvent& event : program.events) {
        if (event.name != "tool" || !event.value.starts_with("T")) continue;
        int number = 0;
        const char* end = event.value.data() + event.value.size();
        if (std::from_chars(event.value.data() + 1, end, number).ec != std::errc()) return std::nullopt;
        if (number == 0) continue;
        const Tool* row = table.find(number);
        const std::optional<CuttingTool> tool =
            row != nullptr ? tool_of_remark(row->remark, row->diameter) : std::nullopt;
        if (!tool || (known && *known != *tool)) return std::nullopt;
        known = tool;
    }
    return known;
}

}  // namespace

void declare_tool(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("tool", po::value<std::string>()->value_name("ball:D|bull:D,R|flat:D|none"), "the tool, diameter and corner radius in mm; places are then contact points on the part, without it the tool tip (default: what the log's metadata or --tools tell)");
    // clang-format on
}

ToolChoice read_tool(const po::variables_map& values) {
    ToolChoice choice;
    if (values.count("tools") > 0) choice.table = values["tools"].as<std::string>();
    if (values.count("tool") == 0) return choice;
    const std::string tool = values["tool"].as<std::string>();
    choice.none = tool == "none";
    if (!choice.none) choice.tool = parse_tool(tool);
    choice.by_config = !given(values, "tool");
    return choice;
}

std::optional<CuttingTool> find_tool(const ToolChoice& choice, const Log* log, const Program* program,
                                     Diagnostics& diagnostics) {
    const bool given = choice.tool || choice.none;
    if (given && !choice.by_config) return choice.tool;
    if (const std::optional<CuttingTool> recorded = log != nullptr ? tool_of_log(*log) : std::nullopt) {
        if (given && choice.tool != recorded)
            note_overruled(diagnostics, *log, "tool", choice.tool ? to_text(*choice.tool) : "none", to_text(*recorded));
        return recorded;
    }
    if (given) return choice.tool;
    if (choice.table.empty() || program == nullptr) return std::nullopt;
    return tool_of_table(io::read_tool_table(io::open_source(choice.table)), *program);
}

}  // namespace clsurf::cli
