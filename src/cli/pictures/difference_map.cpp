#include "cli/pictures/difference_map.h"

#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file_name.h"
#include "core/listed.h"
#include "core/spelling.h"
#include "field/range.h"
#include "viz/map_texts.h"

namespace clsurf::cli {

RunQuantity parse_quantity(const std::string& text) {
    std::vector<std::string> names;
    for (const RunQuantityInfo& info : run_quantity_table()) {
        if (info.name == text) return info.quantity;
        names.emplace_back(info.name);
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw UsageError(fmt::format("--color: '{}' is not {}", text, listed(names, "or")), did_you_mean(text, known));
}

DrawnDifference drawn_difference(RunDifferences& differences, RunQuantity quantity) {
    const RunQuantityInfo& info = run_quantity_table()[index_of(quantity)];
    if (!differences.has(quantity))
        throw UsageError(fmt::format("--color {}: the runs do not have measured positions in common", info.name));
    DrawnDifference shown;
    shown.field.info = {
        std::string(info.name), fmt::format("{}, difference", info.label), info.unit, FieldScale::diverging, {}};
    shown.field.info.threshold = differences.threshold[index_of(quantity)];
    shown.field.info.least_span = 2 * shown.field.info.threshold;  // equal runs must not look different
    shown.field.values = std::move(differences.of[index_of(quantity)]);
    return shown;
}

void draw_difference(const DrawnDifference& shown, const Trajectory& path, const ClSurface& surface,
                     const LookOptions& look, PictureOutput& output) {
    const viz::MapPanel panel{&surface, &shown.field, "", {}, {}, {}};
    const ShownRange range = find_range(shown.field, surface, look.range);
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
