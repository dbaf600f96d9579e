#include "cli/pictures/identify_picture.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "cli/pictures/difference_map.h"
#include "core/decimal_text.h"
#include "core/error.h"
#include "core/units.h"
#include "identify/run_fidelity.h"

namespace clsurf::cli {

void draw_speed_residual(const Identification& result, std::span<const Part> parts, std::span<const Part> tests,
                         PictureOutput& output) {
    const bool tested = !result.tests.empty();
    const std::vector<RunFidelity>& runs = tested ? result.tests : result.fit;
    const std::span<const Part> logged = tested ? tests : parts;
    if (runs.empty())
        throw InputError(Place::of_file(parts.front().log.name), "cannot be compared with a simulation: no picture");
    const auto worst = std::max_element(runs.begin(), runs.end(), [](const RunFidelity& a, const RunFidelity& b) {
        return a.speed_error_p95 < b.speed_error_p95;
    });
    // Runs that cannot be simulated are missing in `runs`.
    const auto part =
        std::find_if(logged.begin(), logged.end(), [&](const Part& p) { return p.log.name == worst->log; });
    const RecordedRun run(*part);
    const Part simulation = run.simulated(result.machine);
    RunDifferences differences = run.differences(simulation);
    DrawnDifference shown = drawn_difference(differences, RunQuantity::speed);
    shown.run = "simulation";
    shown.reference = run.part().log.name;
    shown.note = fmt::format("{}: time {} %, speed within {:.3g} mm/min over 95 % of the path",
                             tested ? "not used for the fit" : "used for the fit",
                             signed_text(100 * worst->time_error, 2), worst->speed_error_p95 * seconds_per_minute);
    LookOptions look;
    look.look.view = viz::parse_view("top");
    look.look.keep_drawing = output.wants_drawing();
    draw_difference(shown, run.part().path, run.surface(), look, output);
}

}  // namespace clsurf::cli
