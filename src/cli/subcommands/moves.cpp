// clsurf moves: the motions of a program as CSV.

#include <optional>

#include "cli/options/options.h"
#include "cli/options/output_format.h"
#include "io/files/atomic_file.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "io/reports/moves_csv.h"
#include "toolpath/tip_motions.h"

namespace clsurf::cli {
namespace {

ExitCode run_moves(const po::variables_map& values) {
    std::optional<io::AtomicFile> output;
    if (values.count("output") > 0) {
        const std::string path = required(values, "output");
        (void)output_format(path, motion_formats());
        output.emplace(path);
    }
    io::ProgramOptions options = read_program_options(values);
    options.coordinates.reset();
    Program program = io::read_program(required(values, "PROGRAM"), options);
    std::optional<Machine> machine;
    if (values.count("machine") > 0) {
        machine = io::read_machine(values["machine"].as<std::string>());
        const bool rotary = machine->kinematics.has_rotary();
        if (!rotary && given(values, "machine")) throw UsageError("--machine: the machine has no rotary axes");
        if (rotary)
            solve_tool_axes(program, *machine);
        else
            machine.reset();
    }
    print(program.diagnostics, values);
    const Kinematics* const kinematics = machine ? &machine->kinematics : nullptr;
    if (output) {
        io::write_moves_csv(program.motions, kinematics, [&](std::string_view text) { output->write(text); });
        output->commit();
    } else {
        io::write_moves_csv(program.motions, kinematics, write_to_stdout);
    }
    return ExitCode::done;
}

}  // namespace

Subcommand moves_subcommand() {
    return {
        .name = "moves",
        .arguments = "PROGRAM",
        .summary = "writes the motions of a program as CSV",
        .description =
            "One row per motion, in the active work coordinate system, mm and deg:\n"
            "line,kind,x,y,z,a,b,c,ci,cj,ck,turns,plane,feed. Kinds are rapid, feed, cw, ccw,\n"
            "dwell and spline; the centre (ci, cj, ck) is absolute; a field is empty where it\n"
            "means nothing. A spline has a row for each of its chords, which stay within 0.1 µm of it.\n"
            "PROGRAM may be - for standard input. With --machine a, b, c are also those\n"
            "of tool axes given as vectors (G43.5, A3=), and ti,tj,tk at the end is the tool axis.",
        .declare =
            [](po::options_description& options) {
                options.add_options()("output,o", po::value<std::string>()->value_name("FILE"),
                                      "the motions' file, .csv (default: standard output)");
                declare_program_options(options);
                options.add_options()("machine", po::value<std::string>()->value_name("FILE"),
                                      "machine file with rotary axes: adds the tool axis in the workpiece");
            },
        .positional = {"PROGRAM"},
        .run = run_moves,
    };
}

}  // namespace clsurf::cli
