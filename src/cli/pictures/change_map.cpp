#include "cli/pictures/change_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "compare/defect_match.h"
#include "compare/field_difference.h"
#include "field/range.h"
#include "io/reports/roughness_words.h"
#include "pipeline/roughness_gauge.h"
#include "viz/field_colours.h"
#include "viz/scene.h"

namespace clsurf::cli {
namespace {

constexpr double least_share = 0.1;  ///< share of the range of both maps: smaller differences are pale

DefectMatch match_of(const Shown& before, const Shown& after) {
    return match_defects({&before.defects.report.defects, &before.surface.positions, before.surface.step_over},
                         {&after.defects.report.defects, &after.surface.positions, after.surface.step_over});
}

/// The outlines of the later run's defects, and of those that are gone.
std::vector<viz::OutlineMark> outlines_of_change(const Shown& before, const Shown& after, const DefectMatch& match) {
    std::vector<viz::OutlineMark> marks;
    for (std::size_t i = 0; i < after.defects.outlines.size(); ++i) {
        marks.push_back(after.defects.outlines[i]);
        marks.back().label = fmt::format("{}{}", match.before_of[i] ? "" : "new ", i + 1);
    }
    for (const std::size_t i : match.gone) {
        marks.push_back(before.defects.outlines[i]);
        marks.back().label = fmt::format("gone {}", i + 1);
    }
    return marks;
}

}  // namespace

std::string changed_defects_text(const Shown& before, const Shown& after) {
    const DefectMatch match = match_of(before, after);
    return fmt::format("{} gone, {} new, {} remaining", match.gone.size(), match.fresh(), match.remaining());
}

std::string changed_roughness_text(const Shown& before, const Shown& after) {
    const std::optional<RoughnessChange> change =
        roughness_change(before.part, before.surface, after.part, after.surface);
    return change ? io::roughness_change_text(*change) : std::string();
}

std::optional<viz::Image> draw_change(const Shown& before, const Shown& after, double range,
                                      const RenderOptions& options) {
    if (has_classes(after.field.info) || after.height_map || before.height_map) return std::nullopt;
    const RunAlignment alignment = align_runs(after.surface.positions, before.surface.positions);
    if (alignment.aligned <= 0) return std::nullopt;
    const Field change = difference_of(after.field, before.field, alignment);
    viz::MapPanel panel;
    panel.surface = &after.surface;
    panel.field = &change;
    viz::MapTexts texts;
    texts.title = change.info.label;
    if (options.defects) {
        const DefectMatch match = match_of(before, after);
        panel.outlines = outlines_of_change(before, after, match);
        texts.subtitle = "Defects: " + changed_defects_text(before, after);
    }
    const ShownRange shown = find_range(change, after.surface, {});
    const double most = std::max({std::abs(shown.low), std::abs(shown.high), least_share * range});
    if (alignment.aligned < alignment.arc_length)
        texts.notes.push_back(fmt::format("the runs share {:.0f} % of the path",
                                          std::floor(100 * alignment.aligned / alignment.arc_length)));
    const viz::Look& look = options.shown.look;
    return viz::draw_map({panel}, viz::placed_map({panel}, look), viz::scale_of(change.info, -most, most), texts, look);
}

viz::Image draw_with_change(const Shown& before, const Shown& after, double range, RenderOptions options,
                            const std::function<viz::Image(const viz::Look&)>& draw) {
    const viz::Look whole = options.shown.look;
    const bool wide = viz::is_wide(whole);
    viz::Look& part = options.shown.look;
    if (wide)
        part.width = whole.width / 3;
    else
        part.height = whole.height / 2;
    const std::optional<viz::Image> change = draw_change(before, after, range, options);
    if (!change) return draw(whole);
    viz::Look rest = whole;
    if (wide)
        rest.width -= part.width;
    else
        rest.height -= part.height;
    return wide ? viz::beside(draw(rest), *change) : viz::stacked(draw(rest), *change);
}

}  // namespace clsurf::cli
