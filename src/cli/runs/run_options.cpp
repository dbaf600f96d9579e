#include <functional>
#include <memory>

#include "cli/options/part.h"
#include "cli/options/work_frames.h"
#include "cli/runs/runs.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"

namespace clsurf::cli {

void declare_runs(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("program", po::value<std::string>()->value_name("FILE"), "the program of the logs; gives lines and rapids")
        ("machine", po::value<std::string>()->value_name("FILE"), "machine file for programs, which are simulated (default: that of clsurf machine --defaults); its kinematics convert five-axis positions into tool tips")
        ("start", po::value<std::string>()->value_name("X,Y,Z"), "position of the axes before a simulated program, mm (default: 0,0,0)")
        ("surface", po::value<std::string>()->value_name("commanded|feedback|actual"), "positions by which runs are aligned (default: commanded, else what all have)");
    // clang-format on
    declare_program_options(options);
    declare_log_options(options);
    declare_work_offset(options);
    declare_force(options);
    declare_tool(options);
    declare_derivative(options);
}

namespace {

/// Reads the program of a log.
std::function<ProgramOfLog(const Log&)> reader_of(const std::string& path, const io::ProgramOptions& options) {
    if (path.empty()) return {};
    return [=](const Log& log) {
        const io::Source source = io::open_source(path);
        ProgramOfLog read{io::read_program(source, options)};
        read.identity = io::check_identity(source, log, read.program.diagnostics);
        return read;
    };
}

}  // namespace

RunOptions read_run_options(const po::variables_map& values) {
    RunOptions options;
    options.program_options = read_program_options(values);
    options.program_options.coordinates.reset();  // a run is placed by its pose
    options.log_options = read_log_options(values);
    options.placing.poses = read_work_offset(values);
    options.tool = read_tool(values);
    options.placing.accept_foreign = values.count("force") > 0;
    if (values.count("program") > 0) options.program = values["program"].as<std::string>();
    options.placing.program_of = reader_of(options.program, options.program_options);
    if (values.count("machine") > 0) {
        options.machine = io::read_machine(values["machine"].as<std::string>());
        if (options.machine.kinematics.has_rotary())
            options.placing.kinematics = std::make_shared<const Kinematics>(options.machine.kinematics);
    }
    if (values.count("surface") > 0) options.role = parse_role(values["surface"].as<std::string>());
    options.placing.derivative = read_derivative(values);
    options.start = read_start(values);
    return options;
}

}  // namespace clsurf::cli
