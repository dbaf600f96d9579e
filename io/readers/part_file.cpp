#include "io/readers/part_file.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/error.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/log_tool.h"
#include "io/readers/machine_file.h"
#include "io/readers/tool_table_file.h"

namespace clsurf::io {
namespace {

Log open_log_of(const PartFiles& files) {
    return files.log_source ? open_log(*files.log_source, files.log_options) : open_log(files.log, files.log_options);
}

}  // namespace

std::optional<CuttingTool> tool_of_log(const Log& log) {
    const std::string recorded = tool_of_metadata(log.metadata);
    if (recorded.empty()) return std::nullopt;
    try {
        return parse_tool(recorded);
    } catch (const UsageError& error) {
        throw InputError(Place::of_file(log.name), fmt::format("its metadata: {}", error.what()));
    }
}

std::optional<CuttingTool> tool_of_table(const std::string& path, const Program& program) {
    const ToolTable table = read_tool_table(open_source(path));
    std::optional<CuttingTool> known;
    for (const ProgramEvent& event : program.events) {
        const auto* word = std::get_if<ToolWord>(&event.meaning);
        if (word == nullptr) continue;
        if (!word->number) return std::nullopt;
        const int number = static_cast<int>(std::clamp(*word->number, -1e9, 1e9));
        if (number == 0) continue;
        const Tool* row = table.find(number);
        const std::optional<CuttingTool> tool =
            row != nullptr ? tool_of_remark(row->remark, row->diameter) : std::nullopt;
        if (!tool || (known && *known != *tool)) return std::nullopt;
        known = tool;
    }
    return known;
}

void use_machine(const std::string& path, PartRules& rules) {
    rules.machine = std::make_shared<const Machine>(read_machine(path));
    rules.limits = read_stated_limits(path);
    const Kinematics& kinematics = rules.machine->kinematics;
    rules.kinematics = kinematics.has_rotary() ? std::make_shared<const Kinematics>(kinematics) : nullptr;
}

namespace {

ProgramOptions as_programmed(const PartFiles& files) {
    ProgramOptions options = files.program_options;
    options.coordinates.reset();  // the log may give the position of the program's zero
    return options;
}

}  // namespace

Part read_surveyed_part(const PartFiles& files, const PartRules& rules, const Survey& survey, const Stages& stages) {
    begin_stage(stages, "read the program");
    Program program = read_program(open_source(files.program), as_programmed(files));
    begin_stage(stages, "open the log");
    return surveyed_part(std::move(program), open_log(files.log, files.log_options), rules, survey);
}

Part read_part(const PartFiles& files, PartRules rules, const Stages& stages) {
    if (files.program.empty()) {
        begin_stage(stages, "open the log");
        return assemble(open_log_of(files), rules);
    }
    begin_stage(stages, "read the program");
    const Source source = open_source(files.program);
    Program program = read_program(source, as_programmed(files));
    begin_stage(stages, "open the log");
    Log log = open_log_of(files);
    rules.identity = check_identity(source, log, log.diagnostics);
    begin_stage(stages, "map points to lines");
    Part part = assemble(std::move(program), std::move(log), rules);
    if (!part.tool && files.recorded_tool) {
        part.tool = tool_of_log(part.log);
        const std::string& table = files.program_options.tools;
        if (!part.tool && !table.empty()) part.tool = tool_of_table(table, part.program);
    }
    return part;
}

Part read_part(const std::string& program, const std::string& log, const PartRules& rules) {
    return read_part(PartFiles{program, log, {}, {}, true}, rules);
}

}  // namespace clsurf::io
