#include "python/picture.h"

#include <mutex>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file_name.h"
#include "field/pass_ramps.h"
#include "field/range.h"
#include "program/frame_placement.h"
#include "viz/field_colours.h"
#include "viz/image.h"
#include "viz/map_texts.h"
#include "viz/scene.h"

namespace clsurf::python {
namespace {

viz::Look look_of(const PictureRequest& request) {
    constexpr int least = 64, most = 16384;
    if (std::min(request.width, request.height) < least || std::max(request.width, request.height) > most)
        throw UsageError(fmt::format("size {} x {}: pictures have {} to {} pixels a side", request.width,
                                     request.height, least, most));
    viz::Look look;
    look.width = request.width;
    look.height = request.height;
    look.view = viz::parse_view(request.view);
    look.gl = "egl";
    return look;
}

viz::ColourScale scale_of_picture(const Field& field, const ClSurface& surface, const PictureRequest& request,
                                  viz::MapTexts& texts) {
    RangeRule rule;
    if (request.range) {
        rule.kind = RangeRule::Kind::fixed;
        rule.low = request.range->first;
        rule.high = request.range->second;
        if (!(rule.low <= rule.high)) throw UsageError("range: the lower end must not be above the upper one");
    }
    const ShownRange range = find_range(field, surface, rule);
    for (std::string& note : viz::notes_of(range)) texts.notes.push_back(std::move(note));
    if (request.colour_map.empty()) return viz::scale_of(field.info, range.low, range.high);
    return viz::scale_of(field.info, range.low, range.high, 0, viz::make_colour_map(request.colour_map));
}

}  // namespace

std::string draw_picture(const LoadedPart& loaded, const PictureRequest& request) {
    static std::mutex drawing;
    viz::Look look = look_of(request);
    const Part& part = loaded.part();
    const std::string usual = loaded.fields().can_compute("feed_share") ? "feed_share" : "speed";
    const Field field = loaded.fields().get(request.field.empty() ? usual : request.field);

    viz::MapPanel panel;
    panel.surface = &loaded.surface();
    panel.field = &field;
    viz::MapTexts texts;
    texts.title = fmt::format("{}, {} surface", field.info.label, name_of(part.path.role));
    texts.frame = common_work_system(part.program.motions);
    texts.subtitle = fmt::format("{} · {} · {}", file_name(part.program.main().name()), file_name(part.log.name),
                                 viz::counts_of(loaded.surface()));
    if (!field.info.note.empty()) texts.notes.push_back(field.info.note);
    viz::FieldClasses classes;
    viz::ColourScale scale;
    if (has_classes(field.info)) {
        if (request.range || !request.colour_map.empty())
            throw UsageError("'" + field.info.name + "' has names for values: no range and no colour map apply");
        classes = viz::FieldClasses(field.info, field.values, panel.surface->passes);
        panel.classes = &classes;
        look.names = true;
        scale = classes.scale();
        texts.notes.emplace_back(viz::shares_note);
    } else {
        if (field.info.preference == FieldPreference::higher) {
            panel.pale = pass_ramps(field, panel.surface->passes, part.log.period);
            texts.notes.emplace_back(viz::ramps_note);
        }
        scale = scale_of_picture(field, *panel.surface, request, texts);
    }
    if (part.tool && look.scales) texts.notes.emplace_back(viz::tool_tip_note);
    const std::scoped_lock lock(drawing);
    const viz::Image image = viz::draw_map({panel}, viz::placed_map({panel}, look), scale, texts, look);
    return viz::encode_image(image, "clsurf map of " + texts.subtitle + ": " + field.info.name, "png");
}

}  // namespace clsurf::python
