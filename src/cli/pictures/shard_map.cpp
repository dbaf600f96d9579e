#include "cli/pictures/shard_map.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "cli/pictures/map_content.h"
#include "field/pass_ramps.h"
#include "field/range.h"
#include "pipeline/part_fields.h"
#include "viz/map_texts.h"

namespace clsurf::cli {
namespace {

/// The colour range, which must be known before the first shard is drawn.
ShownRange range_of_shards(const FieldInfo& field, const RangeRule& rule) {
    if (rule.kind == RangeRule::Kind::fixed) return {rule.low, rule.high, 0, 0, "range as given"};
    const double unit = field.unit.per_inside;
    if (rule.kind == RangeRule::Kind::automatic && field.usual_range)
        return {field.usual_range->low * unit, field.usual_range->high * unit, 0, 0, "the same range in all pictures"};
    throw UsageError("the range of '" + field.name + "' depends on all points of the log",
                     "give it: --range MIN,MAX, in " + field.unit.name);
}

}  // namespace

ShardMap::ShardMap(const RenderOptions& options, Shown shown, const Survey& survey)
    : options_(options),
      shown_(std::move(shown)),
      survey_(survey),
      fields_(path_fields_of(shown_.part, shown_.surface)),
      range_(choose_field()),
      scale_(scale_of(shown_.field.info, range_, options.shown)),
      whole_{&shown_.surface, &shown_.field, "", {}, {}, {}},
      placed_(viz::placed_map({whole_}, options.shown.look)) {
    shown_.surface.positions.forget();  // used only for the extent of the surface
}

ShownRange ShardMap::choose_field() {
    const std::string usual = fields_.can_compute("feed_share") ? "feed_share" : "speed";
    const std::string name = options_.field.empty() ? usual : options_.field;
    if (!fields_.has(name) && fields_of(shown_.part, shown_.surface).has(name))
        throw UsageError("'" + name + "' is a field of the whole log, not of a shard", "leave out --survey");
    // Name and kernel of a field are the same at all points.
    shown_.field = std::move(fields_.get_all({name}, {0, 0}).front());
    if (has_classes(shown_.field.info))
        throw UsageError("'" + name + "' has classes, whose colours depend on the whole log",
                         "choose a field of numbers");
    return range_of_shards(shown_.field.info, options_.shown.range);
}

void ShardMap::Drawn::add(const Drawn& later) {
    parts.add(later.parts);
    lowest = std::min(lowest, later.lowest);
    highest = std::max(highest, later.highest);
}

/// The shards of a map, one in memory at a time.
class ShardMap::Shards {
public:
    Shards(ShardMap& map, int first, int last, int count, Drawn& drawn)
        : map_(map), drawn_(drawn), number_(first - 1), last_(last), count_(count) {}

    std::optional<viz::PanelPart> next() {
        PointRange own;
        while (own.size() <= 0) {
            if (number_ == last_) return std::nullopt;
            own = points_of_shard(map_.shown_.surface.passes, map_.survey_.points, {++number_, count_});
        }
        part_ = part_with_neighbours(map_.shown_.surface, own);
        map_.shown_.surface.positions.forget();
        take_field();
        note_values();
        viz::PanelPart part;
        part.panel.surface = &part_.surface;
        part.panel.field = &field_;
        if (is_speed(field_.info))
            part.panel.pale = pass_ramps(field_, part_.surface.passes, map_.shown_.part.log.period);
        part.own = part_.own;
        return part;
    }

private:
    /// Sets the values of the field at the points of the part; NaN for points outside its ranges.
    void take_field() {
        field_.info = map_.shown_.field.info;
        field_.values = Column<float>(part_.points.size(), missing<float>);
        std::size_t next = 0;
        for (const PointRange& range : part_.ranges) {
            while (part_.points[next] != range.first) ++next;
            const Field some = std::move(map_.fields_.get_all({field_.info.name}, range).front());
            std::copy(some.values.begin(), some.values.end(), field_.values.begin() + next);
        }
    }

    void note_values() {
        const viz::Look& look = map_.options_.shown.look;
        const viz::Zoom& zoom = look.zoom;
        const bool whole = zoom.x0 <= 0 && zoom.y0 <= 0 && zoom.x1 >= 1 && zoom.y1 >= 1 && look.box.isEmpty();
        const double unit = field_.info.unit.per_inside;
        for (const Pass& pass : part_.surface.passes) {
            if (pass.kind != PassKind::cut) continue;
            // A pass belongs to a shard completely, or not at all.
            if (pass.first < part_.own.first || pass.last > part_.own.last) continue;
            for (PointIndex i = pass.first; i <= pass.last; ++i) {
                const float value = field_.values[static_cast<std::size_t>(i)];
                if (!std::isfinite(value)) continue;
                if (!whole && !viz::shows(map_.camera(), look, part_.surface.positions.absolute(i))) continue;
                drawn_.lowest = std::min(drawn_.lowest, value * unit);
                drawn_.highest = std::max(drawn_.highest, value * unit);
            }
        }
    }

    ShardMap& map_;
    Drawn& drawn_;
    int number_;  ///< number of the last shard that was read
    int last_, count_;
    SurfacePart part_;
    Field field_;
};

ShardMap::Drawn ShardMap::draw(int first, int last, int count) {
    Drawn drawn;
    Shards shards(*this, first, last, count, drawn);
    drawn.parts = viz::draw_parts(
        whole_, [&] { return shards.next(); }, placed_, scale_, options_.shown.look);
    return drawn;
}

viz::Image ShardMap::picture(const Drawn& all) const {
    ShownRange range = range_;
    range.lowest = all.lowest;
    range.highest = all.highest;
    return viz::draw_map(all.parts, whole_, placed_, scale_,
                         texts_of(shown_, std::nullopt, options_, viz::notes_of(range)), options_.shown.look);
}

}  // namespace clsurf::cli
