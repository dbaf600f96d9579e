#include "cli/pictures/optimize_picture.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/file_name.h"
#include "core/units.h"
#include "field/field_set.h"
#include "field/range.h"
#include "predictor/quality_fields.h"
#include "viz/field_colours.h"
#include "viz/scene.h"

namespace clsurf::cli {
namespace {

/// A field of both runs with the same scale.
viz::Image draw_pair(const Optimized& result, const Field& before, const Field& after, const viz::MapTexts& texts,
                     bool keep_drawing) {
    viz::MapPanel left{&result.before.surface, &before, "before", {}, {}, {}},
        right{&result.after.surface, &after, "after", {}, {}, {}};
    const std::vector<viz::MapPanel> panels{left, right};
    viz::Look look;
    look.view = viz::parse_view("top");
    look.height = 720;
    look.keep_drawing = keep_drawing;
    const ShownRange a = find_range(before, result.before.surface, {}, {}, result.before.report.sections()),
                     b = find_range(after, result.after.surface, {}, {}, result.after.report.sections());
    const viz::ColourScale scale = viz::scale_of(before.info, std::min(a.low, b.low), std::max(a.high, b.high));
    return viz::draw_map(panels, viz::placed_map(panels, look), scale, texts, look);
}

Field speed_of(const JudgedRun& run) { return FieldSet(run.log, run.path, run.surface.passes).get("speed"); }

/// The residual, because only the pass that causes a difference has a residual; both adjacent passes have the difference.
Field mismatch_of(const JudgedRun& run) {
    const QualityFields fields(run.surface, [&] { return run.signals; });
    return std::move(
        fields.compute(std::array<std::string_view, 1>{"speed_mismatch"}, {0, run.surface.positions.size() - 1})
            .front());
}

}  // namespace

viz::Image draw_before_and_after(const Optimized& result, const std::string& program, bool keep_drawing) {
    const bool ran = std::any_of(result.controller_runs.begin(), result.controller_runs.end(),
                                 [](const ControllerRun& run) { return run.candidate > 0 && run.measured; });
    viz::MapTexts speed, difference;
    speed.title = fmt::format("Path speed before and after, {}", ran ? "on the controller" : "simulated");
    speed.subtitle = file_name(program);
    const Field before = mismatch_of(result.before), after = mismatch_of(result.after);
    difference.title = before.info.label;
    const auto summary = [](const JudgedRun& run, std::size_t defects, const std::optional<PartRoughness>& roughness) {
        const bool rough = roughness && !roughness->patches.empty();
        return fmt::format("{:.1f} s, {:.0f} mm/min between adjacent passes (95th percentile), {} defect{}{}",
                           run.duration, run.mismatch * seconds_per_minute, defects, defects == 1 ? "" : "s",
                           rough ? fmt::format(", Ra {:.2f} µm", roughness->ra * um_per_mm) : std::string());
    };
    difference.notes = {"before: " + summary(result.before, result.evaluation.defects_before, result.roughness_before),
                        "after: " + summary(result.after, result.evaluation.defects_after, result.roughness_after)};
    return viz::stacked(draw_pair(result, speed_of(result.before), speed_of(result.after), speed, keep_drawing),
                        draw_pair(result, before, after, difference, keep_drawing));
}

}  // namespace clsurf::cli
