#include "cli/part.h"

#include <fmt/format.h>

#include "cli/work_frames.h"
#include "core/spelling.h"
#include "io/compressed.h"
#include "io/program_file.h"
#include "io/program_identity.h"
#include "path/pieces.h"
#include "path/tip_motions.h"

namespace clsurf::cli {

Role parse_role(const std::string& text) {
    const std::string_view names[] = {"commanded", "feedback", "actual"};
    for (const Role role : {Role::commanded, Role::feedback, Role::actual}) {
        if (text == name_of(role)) return role;
    }
    throw UsageError("'" + text + "' is not commanded, feedback or actual", did_you_mean(text, names));
}

namespace {

/// The role that lines are found by: what was commanded, where it is there.
Role mapping_role(const Log& log, Role shown) { return log.has(Role::commanded) ? Role::commanded : shown; }

/// Without the machine's kinematics the path of a five-axis log does not tell whether it belongs to the program.
void forget_path(LineMap& lines) {
    ProgramMatch match = lines.match();
    match.foreign.clear();
    lines.set_match(std::move(match));
}

}  // namespace

void declare_part(po::options_description& options, bool can_form) {
    declare_program_options(options);
    declare_log_options(options);
    declare_work_offset(options);
    declare_kinematics(options);
    // clang-format off
    options.add_options()
        ("surface", po::value<std::string>()->value_name(can_form ? "commanded|feedback|actual|formed" : "commanded|feedback|actual"),
            can_form ? "which positions (default: commanded, else what the log has), or what the tool leaves standing; that needs --tool" : "which positions (default: commanded, else what the log has)")
        ("ignore-lines", "find the lines by geometry even where the log has a line channel");
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
        ("derivative", po::value<std::string>()->value_name("savgol|kalman"), "how speed, acceleration and jerk come about: least squares over a window, or a Kalman smoother over all that the log measures, with its uncertainty (default: savgol)");
    // clang-format on
}

PartOptions read_part_or_log_options(const po::variables_map& values) {
    if (values.count("LOG") > 0) return read_part_options(values);
    const std::string log = required(values, "PROGRAM");
    po::variables_map alone = values;
    alone.insert({"LOG", po::variable_value(log, false)});
    PartOptions options = read_part_options(alone);
    options.program.clear();
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
    options.role_given = values.count("surface") > 0;
    options.formed = options.role_given && values["surface"].as<std::string>() == "formed";
    if (options.formed) options.role_given = false;
    if (options.role_given) options.role = parse_role(values["surface"].as<std::string>());
    options.poses = read_work_offset(values);
    options.program_options.coordinates.reset();  // the log may tell where the program's zero lies
    if (values.count("derivative") > 0) {
        const std::string method = values["derivative"].as<std::string>();
        if (method != "savgol" && method != "kalman")
            throw UsageError("--derivative: '" + method + "' is not savgol or kalman");
        options.derivative = method == "kalman" ? DerivativeMethod::kalman : DerivativeMethod::savgol;
    }
    if (values.count("machine") > 0) options.machine = values["machine"].as<std::string>();
    return options;
}

std::unique_ptr<LineMap> lines_without_program(const Log& log, PointIndex count) {
    static constexpr LineNumber no_line = 0xffffffffU;  // that no program has
    Program none;
    none.files.emplace_back();
    if (const Channel* channel = log.find("line"))
        return std::make_unique<LineMap>(channel->values, none, log.keep_alive);
    ChannelView everywhere;
    everywhere.first = reinterpret_cast<const std::byte*>(&no_line);
    everywhere.count = count;
    everywhere.type = ScalarType::u32;
    return std::make_unique<LineMap>(everywhere, none, nullptr);
}

namespace {

Part load_log_alone(const PartOptions& options, StageClock& clock) {
    Part part;
    part.derivative = options.derivative;
    clock.begin("open the log");
    part.program.files.emplace_back();
    part.log = io::open_log(options.log, options.log_options);
    if (part.log.records == 0) throw InputError(Place::of_file(part.log.name), "holds no records");
    Role role = options.role;
    if (!options.role_given && !part.log.has(role)) role = part.log.has(Role::feedback) ? Role::feedback : Role::actual;
    const Eigen::Isometry3d pose =
        options.poses.zero.value_or(pose_of(part.log).value_or(Eigen::Isometry3d::Identity()));
    part.path = reconstruct(part.log, role, pose, load_kinematics(options.machine));
    part.diagnostics.append(part.log.diagnostics);
    part.lines = lines_without_program(part.log, part.path.count);
    clock.end();
    return part;
}

}  // namespace

Part load_part(const PartOptions& options, StageClock& clock) {
    if (options.program.empty()) return load_log_alone(options, clock);
    Part part;
    part.derivative = options.derivative;
    clock.begin("read the program");
    const io::Source program = io::open_source(options.program);
    part.program = io::read_program(program, options.program_options);
    clock.begin("open the log");
    part.log = io::open_log(options.log, options.log_options);
    if (part.log.records == 0) throw InputError(Place::of_file(part.log.name), "holds no records");
    Role role = options.role;
    if (!options.role_given && !part.log.has(role)) {
        role = part.log.has(Role::feedback) ? Role::feedback : Role::actual;
    }
    const std::shared_ptr<const Kinematics> kinematics = load_kinematics(options.machine);
    const Eigen::Isometry3d pose =
        place_with(part.program, part.log, options.poses, kinematics.get(), part.diagnostics);
    part.path = reconstruct(part.log, role, pose, kinematics);
    if (kinematics) solve_tool_axes(part.program, *kinematics, {}, {}, pose.linear());
    part.diagnostics.append(part.program.diagnostics);
    part.diagnostics.append(part.log.diagnostics);
    const ProgramIdentity identity = io::check_identity(program, part.log, part.diagnostics);
    clock.begin("map points to lines");
    if (kinematics) {
        make_tip_motions(part.program, *kinematics, pose);
        note_poles(part.log, role, *kinematics, part.diagnostics);
    } else {
        note_rotary(part.log, role, part.diagnostics);
    }
    const Trajectory mapped = reconstruct_like(part.log, mapping_role(part.log, role), part.path);
    part.lines = std::make_unique<LineMap>(
        map_lines(mapped, part.log, part.program, options.use_line_channel, part.diagnostics, identity));
    if (!kinematics && part.diagnostics.count("path.rotary") > 0) forget_path(*part.lines);
    refuse_foreign(part.lines->match(), part.program, part.log, options.force, part.diagnostics);
    part.tool = find_tool(options.tool, &part.log, &part.program, part.diagnostics);
    clock.end();
    return part;
}

std::shared_ptr<const MotionEstimate> estimate_motion(const Part& part, const Passes& pieces) {
    if (part.derivative == DerivativeMethod::savgol) return nullptr;
    return std::make_shared<const MotionEstimate>(part.log, part.path,
                                                  split_at_standstills(smooth_pieces(part.log, pieces), part.path));
}

ClSurface stitch(const Part& part) { return clsurf::stitch(gather(part.path), *part.lines); }

}  // namespace clsurf::cli
