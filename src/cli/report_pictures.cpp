#include "cli/report_pictures.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/file_name.h"
#include "core/units.h"

namespace clsurf::cli {
namespace {

constexpr double least_surroundings = 6;  ///< step-overs round a defect
constexpr double surroundings = 0.35;     ///< of the defect's size, likewise

std::size_t index_of_field(const PicturedPart& shown, const std::string& name) {
    const auto found =
        std::find_if(shown.fields.begin(), shown.fields.end(), [&](const Field& f) { return f.info.name == name; });
    return found == shown.fields.end() ? 0 : static_cast<std::size_t>(found - shown.fields.begin());
}

std::string draw(const viz::MapPanel& panel, const ShownRange& range, const viz::MapTexts& texts,
                 const viz::Look& look) {
    const viz::ColourScale scale{default_colour_map(panel.field->info), range.low, range.high, 0};
    const viz::Image image = viz::draw_map({panel}, viz::map_camera({panel}, look), scale, texts, look);
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

/// The field that shows a quantity.
std::string field_of(Quantity quantity) {
    switch (quantity) {
        case Quantity::speed: return "speed";
        case Quantity::acceleration: return "acceleration";
        case Quantity::lag:
        case Quantity::relief: return "height";
    }
    return "speed";
}

}  // namespace

viz::ColourMap default_colour_map(const FieldInfo& info) {
    return viz::make_colour_map(info.scale == FieldScale::diverging ? "coolwarm" : "isurface");
}

io::PagePicture picture_of_part(const PicturedPart& shown, const std::string& name) {
    const std::size_t k = index_of_field(shown, name);
    viz::Look look;
    look.width = 1200;
    look.height = 840;
    look.gl = shown.gl;
    const viz::MapPanel panel{shown.surface, &shown.fields[k], "", {}, {}, shown.outlines, nullptr};
    const FieldInfo& info = shown.fields[k].info;
    return {info.label, shown.outlines.empty() ? "" : "Defects are outlined; 1 stands out most.",
            draw(panel, shown.ranges[k], texts_of(shown, info, shown.ranges[k]), look)};
}

io::PagePicture picture_of_defect(const PicturedPart& shown, std::size_t defect) {
    const Defect& d = shown.report->defects[defect];
    const std::size_t k = index_of_field(shown, field_of(d.quantity));
    viz::Look look;
    look.width = 640;
    look.height = 480;
    look.gl = shown.gl;
    look.view = viz::parse_view("top");
    const double room =
        std::max(least_surroundings * shown.surface->step_over, surroundings * d.bounds.sizes().head<2>().maxCoeff());
    look.box = d.bounds;
    look.box.extend(Vec3(d.bounds.min() - Vec3::Constant(room)));
    look.box.extend(Vec3(d.bounds.max() + Vec3::Constant(room)));
    // Outlines far outside the box would only be clipped.
    viz::MapPanel panel{shown.surface, &shown.fields[k], "", {}, {}, {shown.outlines[defect]}, nullptr};
    const FieldInfo& info = shown.fields[k].info;
    viz::MapTexts texts = texts_of(shown, info, shown.ranges[k]);
    texts.title = fmt::format("Defect {}: {}", defect + 1, info.label);
    texts.notes.clear();
    const LineNumber first = d.runs.empty() ? 0 : d.runs.front().first_line;
    return {fmt::format("Defect {}", defect + 1),
            fmt::format("{}, depth {:.1f} µm{}", description_of(d.cause), d.depth * um_per_mm,
                        first > 0 ? fmt::format(", from line {}", first) : ""),
            draw(panel, shown.ranges[k], texts, look)};
}

io::PagePicture picture_of_relief(const PicturedPart& shown, const viz::Relief& relief, const Field& field,
                                  const ShownRange& range) {
    viz::Look look;
    look.width = 1200;
    look.height = 840;
    look.gl = shown.gl;
    viz::MapPanel panel{shown.surface, &field, "", {}, {}, {}, &relief};
    viz::MapTexts texts = texts_of(shown, field.info, range);
    texts.title = field.info.label;
    return {field.info.label, field.info.note, draw(panel, range, texts, look)};
}

}  // namespace clsurf::cli
