#include "cli/report/report_pictures.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "cli/pictures/defect_card.h"
#include "cli/pictures/defect_map.h"
#include "cli/pictures/map_content.h"
#include "core/file_name.h"
#include "core/not_finite.h"
#include "core/point_ranges.h"
#include "io/reports/quality_words.h"
#include "pipeline/shards.h"
#include "program/frame_placement.h"
#include "surface/surface_part.h"
#include "viz/field_colours.h"
#include "viz/map_texts.h"

namespace clsurf::cli {
namespace {

viz::Look map_look(const PicturedPart& shown) {
    viz::Look look;
    look.width = 1200;
    look.height = 840;
    look.gl = shown.gl;
    return look;
}

std::size_t index_of_field(const PicturedPart& shown, const std::string& name) {
    const auto found =
        std::find_if(shown.fields.begin(), shown.fields.end(), [&](const Field& f) { return f.info.name == name; });
    return found == shown.fields.end() ? 0 : static_cast<std::size_t>(found - shown.fields.begin());
}

std::string draw(const viz::MapPanel& panel, const ShownRange& range, const viz::MapTexts& texts,
                 const viz::Look& look) {
    const viz::ColourScale scale = viz::scale_of(panel.field->info, range.low, range.high);
    const viz::Image image = viz::draw_map({panel}, viz::placed_map({panel}, look), scale, texts, look);
    return viz::encode_image(image, texts.title, "png");
}

/// The shards of a panel, one at a time.
class PartsOfPanel {
public:
    PartsOfPanel(const viz::MapPanel& whole, int shards) : whole_(whole), shards_(shards) {}

    std::optional<viz::PanelPart> next() {
        const ClSurface& surface = *whole_.surface;
        PointRange own;
        while (own.size() <= 0) {
            if (number_ == shards_) return std::nullopt;
            own = points_of_shard(surface.passes, surface.positions.size(), {++number_, shards_});
        }
        part_ = part_with_neighbours(surface, own);
        field_.info = whole_.field->info;
        field_.values = Column<float>(part_.points.size(), missing<float>);
        for (std::size_t k = 0; k < part_.points.size(); ++k) {
            const PointIndex point = part_.points[k];
            if (point >= 0) field_.values[k] = whole_.field->values[static_cast<std::size_t>(point)];
        }
        viz::PanelPart part;
        part.panel.surface = &part_.surface;
        part.panel.field = &field_;
        part.panel.pale = pale_of_part();
        part.own = part_.own;
        return part;
    }

private:
    /// The pale points of the whole panel that are in the part, which may contain an adjacent pass without its ends.
    [[nodiscard]] std::vector<PointRange> pale_of_part() const {
        std::vector<PointRange> pale;
        for (std::size_t k = 0; k < part_.points.size(); ++k) {
            if (part_.points[k] < 0 || !any_has(whole_.pale, part_.points[k])) continue;
            const auto here = static_cast<PointIndex>(k);
            if (!pale.empty() && pale.back().last + 1 == here)
                pale.back().last = here;
            else
                pale.push_back({here, here});
        }
        return pale;
    }

    const viz::MapPanel& whole_;
    int shards_;
    int number_ = 0;  ///< number of the last shard that was drawn
    SurfacePart part_;
    Field field_;
};

std::string draw_in_shards(const viz::MapPanel& panel, int shards, const ShownRange& range, const viz::MapTexts& texts,
                           const viz::Look& look) {
    PartsOfPanel parts(panel, shards);
    const viz::ColourScale scale = viz::scale_of(panel.field->info, range.low, range.high);
    const viz::PlacedMap placed = viz::placed_map({panel}, look);
    const viz::DrawnParts drawn = viz::draw_parts(
        panel, [&] { return parts.next(); }, placed, scale, look);
    return viz::encode_image(viz::draw_map(drawn, panel, placed, scale, texts, look), texts.title, "png");
}

/// "part.ngc · run.csv"
std::string program_and_log(const PicturedPart& shown) {
    return fmt::format("{} · {}", file_name(shown.part->program.main().name()), file_name(shown.part->log.name));
}

viz::MapTexts texts_of(const PicturedPart& shown, const FieldInfo& info, const ShownRange& range) {
    viz::MapTexts texts;
    texts.title = fmt::format("{}, {} surface", info.label, name_of(shown.part->path.role));
    texts.subtitle = program_and_log(shown);
    texts.frame = common_work_system(shown.part->program.motions);
    if (is_speed(info)) texts.notes.emplace_back(viz::ramps_note);
    if (!range.note.empty()) texts.notes.push_back(range.note);
    return texts;
}

}  // namespace

io::PagePicture picture_of_defects(const PicturedPart& shown) {
    const viz::DefectMap defects = defect_map_of(*shown.report);
    viz::MapPanel panel{shown.surface, &shown.fields.front(), "", {}, {}, {}};
    panel.defects = &defects;
    viz::Look look = map_look(shown);
    look.names = true;
    const viz::MapTexts texts = defect_map_texts(
        *shown.report, *shown.part, fmt::format("{} · {}", program_and_log(shown), viz::counts_of(*shown.surface)));
    return {"Defects", "Numbers are those of the table of all defects.", draw(panel, {}, texts, look)};
}

io::PagePicture picture_of_part(const PicturedPart& shown, const std::string& name) {
    const std::size_t k = index_of_field(shown, name);
    const viz::Look look = map_look(shown);
    viz::MapPanel panel{shown.surface, &shown.fields[k], "", {}, {}, shown.outlines};
    panel.pale = shown.ramps[k];
    const FieldInfo& info = shown.fields[k].info;
    viz::MapTexts texts = texts_of(shown, info, shown.ranges[k]);
    if (shown.part->tool) texts.notes.emplace_back(viz::tool_tip_note);
    return {info.label, shown.outlines.empty() ? "" : "Defects are outlined; 1 stands out most.",
            shown.shards > 0 ? draw_in_shards(panel, shown.shards, shown.ranges[k], texts, look)
                             : draw(panel, shown.ranges[k], texts, look)};
}

io::PagePicture picture_of_defect(const PicturedPart& shown, const Signals& signals, std::size_t defect) {
    constexpr int width = 1200;
    constexpr int height = 570;
    const viz::Image card =
        draw_defect_card({*shown.part, *shown.surface, signals, *shown.report}, defect, width, height, shown.gl);
    const std::string name = fmt::format("Defect {}", defect + 1);
    return {name, io::sentence_of(shown.report->defects[defect]), viz::encode_image(card, name, "png")};
}

io::PagePicture picture_of_height_map(const PicturedPart& shown, const viz::HeightMap& height_map, const Field& field,
                                      const ShownRange& range) {
    const viz::Look look = map_look(shown);
    viz::MapPanel panel{shown.surface, &field, "", {}, {}, {}};
    panel.height_map = &height_map;
    viz::MapTexts texts = texts_of(shown, field.info, range);
    texts.title = field.info.label;
    return {field.info.label, field.info.note, draw(panel, range, texts, look)};
}

}  // namespace clsurf::cli
