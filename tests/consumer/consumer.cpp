// Which lines of a program leave marks on the cut part, and how long a simulated machine would take.

#include <cstdio>
#include <exception>

#include <clsurf/field/field_set.h>
#include <clsurf/field/range.h>
#include <clsurf/io/readers/part_file.h>
#include <clsurf/pipeline/judge.h>
#include <clsurf/pipeline/simulated_log.h>

int main(int count, char** arguments) try {
    if (count != 3) {
        std::fputs("usage: consumer PROGRAM LOG\n", stderr);
        return 2;
    }
    const clsurf::Part part = clsurf::io::read_part(arguments[1], arguments[2]);
    const clsurf::ClSurface surface = clsurf::stitch(part);
    const clsurf::Quality quality = clsurf::judge(part, surface);
    for (const clsurf::Defect& defect : quality.report.defects) {
        const clsurf::DefectSection& section = defect.sections.front();
        std::printf("lines %u to %u: %.0f mm/min, adjacent passes %.0f mm/min\n", section.first_line, section.last_line,
                    60 * defect.speed, 60 * defect.adjacent_speed);
    }

    const clsurf::Field speed = clsurf::FieldSet(part.log, part.path, surface.passes).get("speed");
    const clsurf::ShownRange range = clsurf::find_range(speed, surface.passes, {});
    std::printf("%.0f to %.0f %s\n", range.low, range.high, speed.info.unit.name.c_str());

    const clsurf::Program program = clsurf::io::read_program(arguments[1]);
    const clsurf::SimulatedRun run = clsurf::simulate_to_log(program, clsurf::Machine{});
    std::printf("%.1f s simulated\n", run.summary.duration);
} catch (const std::exception& error) {  // a file cannot be read, for example: which one, and where
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
