// clsurf moves: the motions of a program as CSV.

#include "cli/options.h"
#include "io/moves_csv.h"
#include "io/program_file.h"

namespace clsurf::cli {
namespace {

ExitCode run(const po::variables_map& values) {
    const Program program = io::read_program(required(values, "PROGRAM"), read_program_options(values));
    print(program.diagnostics, values);
    io::write_moves_csv(program.motions, write_to_stdout);
    return ExitCode::done;
}

}  // namespace

Subcommand moves_subcommand() {
    return {
        .name = "moves",
        .arguments = "PROGRAM",
        .summary = "the motions of a program as CSV",
        .description =
            "One row per motion, in the active work coordinate system, mm and deg:\n"
            "line,kind,x,y,z,a,b,c,ci,cj,ck,turns,plane,feed. Kinds are rapid, feed, cw, ccw,\n"
            "dwell and spline; the centre (ci, cj, ck) is absolute; a field is empty where it\n"
            "means nothing. PROGRAM may be - for standard input.",
        .declare = [](po::options_description& options) { declare_program_options(options); },
        .positional = {"PROGRAM"},
        .run = run,
    };
}

}  // namespace clsurf::cli
