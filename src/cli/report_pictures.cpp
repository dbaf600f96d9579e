#include "cli/report_pictures.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/defect_card.h"
#include "core/file_name.h"
#include "io/reports/quality_words.h"
#include "viz/field_colours.h"

namespace clsurf::cli {
namespace {

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

viz::MapTexts texts_of(const PicturedPart& shown, const FieldInfo& info, const ShownRange& range) {
    viz::MapTexts texts;
    texts.title = fmt::format("{}, {} surface", info.label, name_of(shown.part->path.role));
    const std::string& log = shown.part->log.name;
    const std::string& program = shown.part->program.main().name();
    texts.subtitle = fmt::format("{} · {}", file_name(program), file_name(log));
    if (!range.note.empty()) texts.notes.push_back(range.note);
    return texts;
}

}  // namespace

io::PagePicture picture_of_part(const PicturedPart& shown, const std::string& name) {
    const std::size_t k = index_of_field(shown, name);
    viz::Look look;
    look.width = 1200;
    look.height = 840;
    look.gl = shown.gl;
    const viz::MapPanel panel{shown.surface, &shown.fields[k], "", {}, {}, shown.outlines};
    const FieldInfo& info = shown.fields[k].info;
    return {info.label, shown.outlines.empty() ? "" : "Defects are outlined; 1 stands out most.",
            draw(panel, shown.ranges[k], texts_of(shown, info, shown.ranges[k]), look)};
}

io::PagePicture picture_of_defect(const PicturedPart& shown, const Signals& signals, std::size_t defect) {
    constexpr int width = 1200;
    constexpr int height = 570;
    const viz::Image card =
        draw_defect_card({*shown.part, *shown.surface, signals, *shown.report}, defect, width, height, shown.gl);
    const std::string name = fmt::format("Defect {}", defect + 1);
    return {name, io::sentence_of(shown.report->defects[defect]), viz::encode_image(card, name, "png")};
}

io::PagePicture picture_of_relief(const PicturedPart& shown, const viz::Relief& relief, const Field& field,
                                  const ShownRange& range) {
    viz::Look look;
    look.width = 1200;
    look.height = 840;
    look.gl = shown.gl;
    viz::MapPanel panel{shown.surface, &field, "", {}, {}, {}};
    panel.relief = &relief;
    viz::MapTexts texts = texts_of(shown, field.info, range);
    texts.title = field.info.label;
    return {field.info.label, field.info.note, draw(panel, range, texts, look)};
}

}  // namespace clsurf::cli
