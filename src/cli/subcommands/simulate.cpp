// clsurf simulate: simulates the controller.

#include "cli/options/options.h"
#include "cli/options/output_format.h"
#include "cli/options/work_frames.h"
#include "cli/programs/controller_runs.h"
#include "cli/programs/settings_tradeoff.h"
#include "cli/programs/simulation_text.h"
#include "cli/programs/written_run.h"
#include "io/readers/machine_file.h"
#include "io/reports/fidelity_report.h"
#include "io/reports/simulated_log.h"

namespace clsurf::cli {
namespace {

ExitCode run_simulate(const po::variables_map& values) {
    if (trades_off(values)) return trade_off_settings(values);
    refuse_settings_options(values);
    const std::string output = required(values, "output");
    (void)output_format(output, log_formats());
    (void)read_json_with_output(values);
    if (const std::optional<ControllerCommand> command = read_controller(values))
        return record_on_controller(*command, required(values, "PROGRAM"), output, values);
    const Machine machine =
        values.count("machine") > 0 ? io::read_machine(values["machine"].as<std::string>()) : Machine{};
    const WrittenRun run = write_run(machine, output, values);
    const SimulationSummary& summary = run.summary.run;
    if (read_json(values)) {
        write_to_stdout(run.five_axes
                            ? io::simulation_json(run.summary, machine.kinematics, run.diagnostics, machine.fidelity)
                            : io::simulation_json(summary, run.diagnostics, machine.fidelity));
    } else {
        print(run.diagnostics, values);
        write_answer(summary_text(summary) + (run.five_axes ? rotary_text(run.summary, machine.kinematics) : "") +
                         io::fidelity_line(machine.fidelity),
                     values);
    }
    return ExitCode::done;
}

}  // namespace

Subcommand simulate_subcommand() {
    return {
        .name = "simulate",
        .arguments = "PROGRAM -o run.biip",
        .summary = "simulates a controller and writes the log that it would record",
        .description =
            "Plans and interpolates a program as a controller does: limits of speed, acceleration and jerk,\n"
            "corners rounded within the tolerance, a look-ahead, and a servo loop for each axis. Writes\n"
            "commanded and feedback positions, line and speed, and in the channel limit the limiting factor\n"
            "of each point: 0 at rest, 1 feed, 2 axis or path speed, 3 acceleration, 4 jerk, 5 corner\n"
            "tolerance, 6 chord error, 7 the end of the look-ahead, 8 feed override, 9 block time.\n"
            "Positions are in machine coordinates: work offsets that the program sets are used, all others\n"
            "are zero. With a machine file that has rotary axes, the log has all five axes, --work-offset is\n"
            "the position of the program's zero with both angles at zero, and blocks that an axis cannot\n"
            "follow run slower. With --controller, your own controller runs the program instead, and its log is\n"
            "kept.\n"
            "With --tradeoff or --weight the program is simulated at many settings: lower limits of jerk and acceleration,\n"
            "lower feeds, and the feeds of constant-speed intervals. The Pareto front of time, speed\n"
            "difference between adjacent passes and jerk is drawn, and --weight W chooses from it: the settings\n"
            "with the smallest value of (1 - W) t + W (m + j) / 2, where t, m and j are time, difference and jerk (95th percentiles)\n"
            "relative to those of the machine file. -o writes the log of that run, --settings its machine file.\n\n"
            "  clsurf simulate part.nc --machine mill.toml -o run.biip\n"
            "  clsurf simulate part.nc --controller 'run_on_kernel.sh {program} {log}' -o run.biip\n"
            "  clsurf simulate part.nc --machine mill.toml --tradeoff front.png --weight 0.5 --settings finish.toml -o run.biip\n"
            "  clsurf render part.nc run.biip --color limit -o why_slow.png",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the BIIP log");
                // clang-format on
                declare_settings_tradeoff(options);
                declare_simulation(options);
                declare_controller(options);
                declare_work_offset(options, false);
                declare_json(options);
                declare_program_options(options);
            },
        .positional = {"PROGRAM"},
        .run = run_simulate,
    };
}

}  // namespace clsurf::cli
