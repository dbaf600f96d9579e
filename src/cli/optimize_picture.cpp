#include "cli/optimize_picture.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/file_name.h"
#include "core/units.h"
#include "field/field_set.h"
#include "field/range.h"
#include "viz/field_colours.h"
#include "viz/scene.h"

namespace clsurf::cli {

viz::Image draw_before_and_after(const Optimized& result, const std::string& program) {
    const auto speed = [](const JudgedRun& run) {
        return FieldSet(run.log, run.path, run.surface.passes).get("speed");
    };
    const Field before = speed(result.before), after = speed(result.after);
    viz::MapPanel left{&result.before.surface, &before, "before", {}, {}, {}},
        right{&result.after.surface, &after, "after", {}, {}, {}};
    const std::vector<viz::MapPanel> panels{left, right};
    viz::Look look;
    look.view = viz::parse_view("top");
    look.height = 900;
    const ShownRange a = find_range(before, result.before.surface.passes, {}, {}),
                     b = find_range(after, result.after.surface.passes, {}, {});
    const viz::ColourScale scale = viz::scale_of(before.info, std::min(a.low, b.low), std::max(a.high, b.high));
    viz::MapTexts texts;
    texts.title = "Path speed before and after, simulated";
    const auto summary = [](const JudgedRun& run, std::size_t defects) {
        return fmt::format("{:.1f} s, {:.0f} mm/min between adjacent passes (95th percentile), {} defect{}",
                           run.duration, run.mismatch * seconds_per_minute, defects, defects == 1 ? "" : "s");
    };
    texts.subtitle = file_name(program);
    texts.notes = {"before: " + summary(result.before, result.evaluation.defects_before),
                   "after: " + summary(result.after, result.evaluation.defects_after)};
    return viz::draw_map(panels, viz::map_camera(panels, look), scale, texts, look);
}

}  // namespace clsurf::cli
