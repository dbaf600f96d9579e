#include "cli/options/part.h"

#include <memory>
#include <utility>

#include "cli/options/look.h"
#include "cli/options/work_frames.h"
#include "core/error.h"
#include "core/spelling.h"
#include "io/files/compressed.h"
#include "io/readers/machine_file.h"
#include "io/readers/part_file.h"

namespace clsurf::cli {

Role parse_role(const std::string& text) {
    const std::string_view names[] = {"commanded", "feedback", "actual"};
    for (const Role role : {Role::commanded, Role::feedback, Role::actual}) {
        if (text == name_of(role)) return role;
    }
    throw UsageError("'" + text + "' is not commanded, feedback or actual", did_you_mean(text, names));
}

void declare_part(po::options_description& options, MachineUse use) {
    const bool of_render = use == MachineUse::simulation;
    declare_program_options(options);
    declare_log_options(options);
    declare_work_offset(options);
    declare_kinematics(options, use);
    // clang-format off
    options.add_options()
        ("surface", po::value<std::string>()->value_name(of_render ? "commanded|feedback|actual|formed" : "commanded|feedback|actual"),
            of_render ? "positions to use (default: commanded, else what the log has), or the as-machined surface, which needs --tool" : "positions to use (default: commanded, else what the log has)")
        ("ignore-lines", "find lines by geometry even if the log has a line channel");
    declare_force(options);
    // clang-format on
}

CuttingTool required_tool(const Part& part, const std::string& what, const std::string& example) {
    if (!part.tool) throw UsageError(what + " needs to know the tool", "say it with --tool: " + example);
    return *part.tool;
}

void declare_derivative(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("derivative", po::value<std::string>()->value_name("savgol|kalman"), "how derivatives are estimated: least squares in a window, or a Kalman smoother over all measured channels, with uncertainty (default: savgol)");
    // clang-format on
}

DerivativeMethod read_derivative(const po::variables_map& values) {
    return text_of(values, "derivative", "savgol") == "kalman" ? DerivativeMethod::kalman : DerivativeMethod::savgol;
}

bool is_log(const io::Source& source, const io::LogOptions& options) {
    const bool is_program = io::forces_log(options) && io::looks_like_program(source);
    return !is_program && io::recognise_log(source, options) != nullptr;
}

namespace {

/// The options for a single file, read as a log without a program.
PartOptions read_options_of_one_file(const po::variables_map& values) {
    const std::string log = required(values, "PROGRAM");
    po::variables_map alone = values;
    alone.insert({"LOG", po::variable_value(log, false)});
    PartOptions options = read_part_options(alone);
    options.program.clear();
    return options;
}

constexpr const char* both_needed = "give both: PROGRAM LOG";

}  // namespace

PartOptions read_part_or_log_options(const po::variables_map& values) {
    if (values.count("LOG") > 0) return read_part_options(values);
    refuse_program_options(values, both_needed);
    return read_options_of_one_file(values);
}

PartOptions read_part_or_program_options(const po::variables_map& values) {
    if (values.count("LOG") > 0) return read_part_options(values);
    PartOptions options = read_options_of_one_file(values);
    if (options.log == "-" || !is_log(io::open_source(options.log), options.log_options))
        options.program = std::exchange(options.log, {});
    else
        refuse_program_options(values, both_needed);
    return options;
}

PartOptions read_part_options(const po::variables_map& values) {
    PartOptions options;
    options.program = required(values, "PROGRAM");
    options.log = first_value(values, "LOG");
    options.program_options = read_program_options(values);
    options.log_options = read_log_options(values);
    options.use_line_channel = values.count("ignore-lines") == 0;
    options.force = values.count("force") > 0;
    options.tool = read_tool(values);
    if (values.count("surface") > 0) {
        const std::string surface = values["surface"].as<std::string>();
        options.as_machined = surface == "formed";
        if (!options.as_machined) options.role = parse_role(surface);
    }
    options.poses = read_work_offset(values);
    options.derivative = read_derivative(values);
    if (values.count("machine") > 0) options.machine = values["machine"].as<std::string>();
    return options;
}

std::optional<Role> take_measured_role(PartOptions& options) { return std::exchange(options.role, std::nullopt); }

PartRules rules_of(const PartOptions& options) {
    PartRules rules;
    rules.role = options.role;
    rules.poses = options.poses;
    if (!options.machine.empty()) io::use_machine(options.machine, rules);
    rules.use_line_channel = options.use_line_channel;
    rules.accept_foreign = options.force;
    rules.accept_unknown_tips = options.accept_unknown_tips;
    rules.derivative = options.derivative;
    return rules;
}

Part load_part(const PartOptions& options, StageClock& clock) {
    const io::PartFiles files{options.program,     options.log, options.program_options,
                              options.log_options, false,       options.log_source};
    PartRules rules = rules_of(options);
    Part part = io::read_part(files, std::move(rules), clock.stages());
    if (!options.program.empty()) part.tool = find_tool(options.tool, &part.log, &part.program, part.diagnostics);
    clock.end();
    return part;
}

}  // namespace clsurf::cli
