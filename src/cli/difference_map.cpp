#include "cli/difference_map.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file_name.h"
#include "core/spelling.h"
#include "field/range.h"
#include "viz/map_texts.h"

namespace clsurf::cli {
namespace {

/// Ends of the colours: nearly all of what differs, however short the section is.
constexpr double shown_percentile = 99.9;

/// Even about 0, and never narrower than what counts as a difference: equal runs are not to look different.
ShownRange range_of(const DrawnDifference& shown, const ClSurface& surface, const LookOptions& options) {
    RangeRule rule = options.range;
    const bool automatic = rule.kind == RangeRule::Kind::automatic;
    if (automatic) rule = {RangeRule::Kind::percentiles, 100 - shown_percentile, shown_percentile};
    ShownRange range = find_range(shown.field, surface, rule);
    if (!automatic) return range;
    const double most =
        std::max({std::abs(range.low), std::abs(range.high), shown.threshold * shown.field.info.unit.per_inside});
    range.high = most > 0 ? round_up(most) : most;
    range.low = -range.high;
    range.note += ", even about 0, with round ends";
    return range;
}

}  // namespace

RunQuantity parse_quantity(const std::string& text) {
    std::vector<std::string_view> names;
    for (const RunQuantityInfo& info : run_quantity_table()) {
        if (info.name == text) return info.quantity;
        names.push_back(info.name);
    }
    throw UsageError("--color: '" + text + "' is not speed, acceleration, lag or height", did_you_mean(text, names));
}

DrawnDifference drawn_difference(RunDifferences& differences, RunQuantity quantity) {
    const RunQuantityInfo& info = run_quantity_table()[index_of(quantity)];
    if (!differences.has(quantity))
        throw UsageError(fmt::format("--color {}: the runs do not have measured positions in common", info.name));
    DrawnDifference shown;
    shown.threshold = differences.threshold[index_of(quantity)];
    shown.field.info = {
        std::string(info.name), fmt::format("{}, difference", info.label), info.unit, FieldScale::diverging, {}};
    shown.field.values = std::move(differences.of[index_of(quantity)]);
    return shown;
}

void draw_difference(const DrawnDifference& shown, const Trajectory& path, const ClSurface& surface,
                     const LookOptions& look, PictureOutput& output) {
    const viz::MapPanel panel{&surface, &shown.field, "", {}, {}, {}};
    const ShownRange range = range_of(shown, surface, look);
    viz::MapTexts texts;
    texts.title =
        fmt::format("{}: {} minus {}", shown.field.info.label, file_name(shown.run), file_name(shown.reference));
    texts.subtitle =
        fmt::format("{} points of {}, {} path", path.count, file_name(shown.reference), name_of(path.role));
    texts.notes = viz::notes_of(range);
    if (!shown.note.empty()) texts.notes.insert(texts.notes.begin(), shown.note);
    const viz::Image image = viz::draw_map({panel}, viz::placed_map({panel}, look.look),
                                           scale_of(shown.field.info, range, look), texts, look.look);
    output.write(image, fmt::format("clsurf difference of {} and {}: {} {:g} to {:g} {}", file_name(shown.run),
                                    file_name(shown.reference), shown.field.info.name, range.low, range.high,
                                    shown.field.info.unit.name));
}

}  // namespace clsurf::cli
