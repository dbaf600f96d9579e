#include "cli/options/part.h"
#include "cli/options/work_frames.h"
#include "cli/runs/runs.h"
#include "io/readers/machine_file.h"

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

RunOptions read_run_options(const po::variables_map& values) {
    RunOptions options;
    options.program_options = read_program_options(values);
    options.log_options = read_log_options(values);
    options.poses = read_work_offset(values);
    options.tool = read_tool(values);
    options.force = values.count("force") > 0;
    if (values.count("program") > 0) options.program = values["program"].as<std::string>();
    if (values.count("machine") > 0) {
        options.machine = io::read_machine(values["machine"].as<std::string>());
        if (options.machine.kinematics.has_rotary())
            options.kinematics = std::make_shared<const Kinematics>(options.machine.kinematics);
    }
    if (values.count("surface") > 0) options.role = parse_role(values["surface"].as<std::string>());
    options.derivative = read_derivative(values);
    options.start = read_start(values);
    return options;
}

}  // namespace clsurf::cli
