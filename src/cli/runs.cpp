#include "cli/runs.h"

#include "cli/part.h"
#include "cli/work_frames.h"
#include "io/compressed.h"
#include "io/machine_file.h"
#include "io/program_file.h"
#include "io/program_identity.h"
#include "io/simulated_run.h"

namespace clsurf::cli {
namespace {

/// machine = pose · workpiece. The simulated run of a program is in the workpiece's coordinates.
Eigen::Isometry3d pose_of_run(const LoadedRun& run, const RunOptions& options) {
    if (run.simulated) return Eigen::Isometry3d::Identity();
    return options.poses.zero.value_or(pose_of(run.log).value_or(Eigen::Isometry3d::Identity()));
}

/// Without a pose all positions stay the machine's.
io::ProgramOptions in_coordinates_of(const RunOptions& options, const Log& log) {
    io::ProgramOptions program = options.program_options;
    const bool told = options.poses.zero || log.work_offset;
    program.coordinates = told ? Coordinates::workpiece : Coordinates::machine;
    return program;
}

Role common_role(const LoadedRun& a, const LoadedRun& b, std::optional<Role> wanted) {
    if (wanted) return *wanted;
    for (const Role role : {Role::commanded, Role::feedback, Role::actual}) {
        if (a.log.has(role) && b.log.has(role)) return role;
    }
    throw InputError(Place::of_file(b.name),
                     "has no positions of a kind that " + a.name + " has too: commanded, feedback or actual");
}

}  // namespace

void declare_runs(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("program", po::value<std::string>()->value_name("FILE"), "the program that the logs are of: tells lines and rapids")
        ("machine", po::value<std::string>()->value_name("FILE"), "machine file for programs, which are simulated (default: that of clsurf machine --defaults)")
        ("start", po::value<std::string>()->value_name("X,Y,Z"), "where the axes stand before a simulated program, mm (default: 0,0,0)")
        ("surface", po::value<std::string>()->value_name("commanded|feedback|actual"), "positions that runs are laid onto each other by (default: commanded, else what all have)");
    // clang-format on
    declare_program_options(options);
    declare_log_options(options);
    declare_work_offset(options);
    declare_force(options);
    declare_tool(options);
}

RunOptions read_run_options(const po::variables_map& values) {
    RunOptions options;
    options.program_options = read_program_options(values);
    options.log_options = read_log_options(values);
    options.poses = read_work_offset(values);
    options.tool = read_tool(values);
    options.force = values.count("force") > 0;
    if (values.count("program") > 0) options.program = values["program"].as<std::string>();
    if (values.count("machine") > 0) options.machine = values["machine"].as<std::string>();
    if (values.count("surface") > 0) options.role = parse_role(values["surface"].as<std::string>());
    options.start = read_start(values);
    return options;
}

LoadedRun load_run(const std::string& path, const RunOptions& options) {
    LoadedRun run;
    run.name = path;
    const io::Source source = io::open_source(path);
    if (source.bytes.empty()) throw InputError(Place::of_file(source.name), "is empty, expected a program or a log");
    const bool is_program = io::forces_log(options.log_options) && io::looks_like_program(source);
    if (!is_program && io::recognise_log(source, options.log_options) != nullptr) {
        run.log = io::open_log(source, options.log_options);
    } else {
        const Machine machine = options.machine.empty() ? Machine{} : io::read_machine(options.machine);
        run.simulated = true;
        run.program = std::make_shared<const Program>(io::read_program(source, in_coordinates_of(options, run.log)));
        run.log = io::simulate_run(*run.program, machine, options.start, {});
    }
    if (run.log.records == 0) throw InputError(Place::of_file(path), "holds no records");
    return run;
}

ComparedRun run_of(const LoadedRun& run, const LoadedRun& other, const RunOptions& options) {
    const Eigen::Isometry3d pose = pose_of_run(run, options);
    const auto both_have = [&](Role role) { return run.log.has(role) && other.log.has(role); };
    ComparedRun made;
    made.log = &run.log;
    made.path = reconstruct(run.log, common_role(run, other, options.role), pose);
    if (both_have(Role::commanded)) made.commanded = reconstruct(run.log, Role::commanded, pose);
    for (const Role role : {Role::actual, Role::feedback}) {
        if (!both_have(role)) continue;
        made.measured = reconstruct(run.log, role, pose);
        if (role != made.path.role) made.truest = made.measured;
        break;
    }
    return made;
}

std::unique_ptr<LineMap> lines_of(LoadedRun& run, const Trajectory& path, const RunOptions& options,
                                  Diagnostics& diagnostics) {
    if (run.simulated) return std::make_unique<LineMap>(map_lines(path, run.log, *run.program, true, diagnostics));
    if (!options.program.empty()) {
        const io::Source source = io::open_source(options.program);
        run.program = std::make_shared<const Program>(io::read_program(source, in_coordinates_of(options, run.log)));
        const Program& program = *run.program;
        diagnostics.append(program.diagnostics);
        const ProgramIdentity identity = io::check_identity(source, run.log, diagnostics);
        auto lines = std::make_unique<LineMap>(map_lines(path, run.log, program, true, diagnostics, identity));
        refuse_foreign(lines->match(), program, run.log, options.force, diagnostics);
        return lines;
    }
    return lines_without_program(run.log, path.count);
}

}  // namespace clsurf::cli
