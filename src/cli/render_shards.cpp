#include "cli/render_shards.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/map_content.h"
#include "cli/picture_output.h"
#include "cli/survey_options.h"
#include "core/file_name.h"
#include "field/pass_ramps.h"
#include "field/range.h"
#include "pipeline/part_fields.h"
#include "surface/surface_part.h"
#include "viz/map_texts.h"
#include "viz/scene.h"
#include "viz/surface_extent.h"

namespace clsurf::cli {
namespace {

void refuse_what_needs_the_whole(const RenderOptions& options, const po::variables_map& values) {
    for (const char* name :
         {"defects", "before", "programmed", "mark-point", "mark-line", "points", "lines", "passes", "follow"}) {
        if (given(values, name)) throw UsageError(fmt::format("--{} needs the whole log: leave out --survey", name));
    }
    if (options.part.as_machined || options.part.role)
        throw UsageError("--surface does not go with --survey: the map shows the positions that were surveyed");
    if (options.part.log.empty())
        throw UsageError("--survey needs the log that was surveyed: clsurf render part.nc run.biip …");
}

/// The colour range, which must be known before the first shard is drawn.
ShownRange range_of_shards(const FieldInfo& field, const RangeRule& rule) {
    if (rule.kind == RangeRule::Kind::fixed) return {rule.low, rule.high, 0, 0, "range as given"};
    const double unit = field.unit.per_inside;
    if (rule.kind == RangeRule::Kind::automatic && field.usual_range)
        return {field.usual_range->low * unit, field.usual_range->high * unit, 0, 0, "the same range in all pictures"};
    throw UsageError("the range of '" + field.name + "' depends on all points of the log",
                     "give it: --range MIN,MAX, in " + field.unit.name);
}

/// The map of a surveyed log. Reads one shard after the other.
class MapOfShards {
public:
    MapOfShards(const RenderOptions& options, Shown shown, const Survey& survey, int shards)
        : options_(options),
          shown_(std::move(shown)),
          survey_(survey),
          fields_(path_fields_of(shown_.part, shown_.surface)),
          shards_(shards) {
        const std::string usual = fields_.can_compute("feed_share") ? "feed_share" : "speed";
        name_ = options.field.empty() ? usual : options.field;
        if (!fields_.has(name_) && fields_of(shown_.part, shown_.surface).has(name_))
            throw UsageError("'" + name_ + "' is a field of the whole log, not of a shard", "leave out --survey");
        // What it is called and how it is computed is the same at all points.
        shown_.field = std::move(fields_.get_all({name_}, {0, 0}).front());
        if (has_classes(shown_.field.info))
            throw UsageError("'" + name_ + "' has classes, whose colours depend on the whole log",
                             "choose a field of numbers");
        range_ = range_of_shards(shown_.field.info, options.shown.range);
        whole_.surface = &shown_.surface;
        whole_.field = &shown_.field;
        whole_.extent = [this](const viz::ViewAxes& axes) { return extent(axes); };
    }
    MapOfShards(const MapOfShards&) = delete;
    MapOfShards& operator=(const MapOfShards&) = delete;

    [[nodiscard]] const Shown& shown() const { return shown_; }
    [[nodiscard]] const ShownRange& range() const { return range_; }

    [[nodiscard]] viz::Image draw() {
        const viz::Look& look = options_.shown.look;
        const viz::PlacedMap placed = viz::placed_map({whole_}, look);
        camera_ = placed.camera;
        const viz::MapInParts map{whole_, [this] { return next(); }, [this] { return texts(); }};
        return viz::draw_map(map, placed, scale_of(shown_.field.info, range_, options_.shown), look);
    }

private:
    [[nodiscard]] PointRange points_of(int number) const {
        return points_of_shard(shown_.surface.passes, survey_.points, {number, shards_});
    }

    [[nodiscard]] Box3 extent(const viz::ViewAxes& axes) {
        const auto known =
            std::find_if(extents_.begin(), extents_.end(), [&](const auto& e) { return e.first == axes; });
        if (known != extents_.end()) return known->second;
        Box3 all;
        const std::span<const Pass> passes = shown_.surface.passes;
        for (std::size_t first = 0; first < passes.size(); first += passes_at_once) {
            const auto some = passes.subspan(first, std::min(passes_at_once, passes.size() - first));
            all.extend(viz::extent_of(shown_.surface.positions, some, axes));
            shown_.surface.positions.forget();
        }
        extents_.emplace_back(axes, all);
        return all;
    }

    std::optional<viz::PanelPart> next() {
        PointRange own;
        while (own.size() <= 0) {
            if (number_ == shards_) return std::nullopt;
            own = points_of(++number_);
        }
        part_ = part_with_neighbours(shown_.surface, own);
        shown_.surface.positions.forget();
        take_field();
        note_values(own);
        viz::PanelPart part;
        part.panel.surface = &part_.surface;
        part.panel.field = &field_;
        if (is_speed(field_.info)) part.panel.pale = pass_ramps(field_, part_.surface.passes, shown_.part.log.period);
        part.points = &part_.points;
        part.own = own;
        return part;
    }

    /// The values of the field at the points of the part; NaN for points outside of its ranges.
    void take_field() {
        field_.info = shown_.field.info;
        field_.values = Column<float>(part_.points.size(), missing<float>);
        std::size_t next = 0;
        for (const PointRange& range : part_.ranges) {
            while (part_.points[next] != range.first) ++next;
            const Field some = std::move(fields_.get_all({name_}, range).front());
            std::copy(some.values.begin(), some.values.end(), field_.values.begin() + next);
        }
    }

    /// The least and the largest value on cut passes that are shown.
    void note_values(const PointRange& own) {
        const viz::Look& look = options_.shown.look;
        const viz::Zoom& zoom = look.zoom;
        const bool whole = zoom.x0 <= 0 && zoom.y0 <= 0 && zoom.x1 >= 1 && zoom.y1 >= 1 && look.box.isEmpty();
        const double unit = field_.info.unit.per_inside;
        for (const Pass& pass : part_.surface.passes) {
            if (pass.kind != PassKind::cut) continue;
            for (PointIndex i = pass.first; i <= pass.last; ++i) {
                const auto at = static_cast<std::size_t>(i);
                const PointIndex point = part_.points[at];
                const float value = field_.values[at];
                if (point < own.first || point > own.last || !std::isfinite(value)) continue;
                if (!whole && !viz::shows(camera_, look, part_.surface.positions.absolute(i))) continue;
                lowest_ = std::min(lowest_, value * unit);
                highest_ = std::max(highest_, value * unit);
            }
        }
    }

    [[nodiscard]] viz::MapTexts texts() const {
        ShownRange range = range_;
        range.lowest = lowest_;
        range.highest = highest_;
        return texts_of(shown_, std::nullopt, options_, viz::notes_of(range));
    }

    static constexpr std::size_t passes_at_once = 64;

    const RenderOptions& options_;
    Shown shown_;  ///< its field has no values
    const Survey& survey_;
    FieldSet fields_;
    std::string name_;
    ShownRange range_;
    viz::MapPanel whole_;
    viz::Camera camera_;
    std::vector<std::pair<viz::ViewAxes, Box3>> extents_;
    int shards_;
    int number_ = 0;  ///< of the last shard that was read
    SurfacePart part_;
    Field field_;
    double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
};

}  // namespace

void declare_render_with_shards(po::options_description& options) {
    declare_render(options);
    // clang-format off
    options.add_options()
        ("survey", po::value<std::string>()->value_name("FILE"), "the survey of the log (`clsurf survey`): the map is drawn shard by shard, with the memory of one")
        ("shards", po::value<int>()->default_value(8)->value_name("N"), "with --survey: how many parts the log is cut into");
    // clang-format on
}

bool draw_in_shards(const RenderOptions& options, const po::variables_map& values) {
    if (values.count("survey") == 0) {
        if (given(values, "shards")) throw UsageError("--shards goes with --survey");
        return false;
    }
    refuse_what_needs_the_whole(options, values);
    RenderOptions wanted = options;
    PictureOutput output(wanted.output, "-o", PictureKind::drawing);
    wanted.shown.look.keep_drawing = output.wants_drawing();
    StageClock clock(read_common(values), 6);
    const SurveyedLog log = read_surveyed_log(wanted.part, values);
    Shown shown;
    shown.part = load_surveyed_part(wanted.part, log.survey, clock);
    shown.surface = surveyed_surface(shown.part, log.survey);
    print(shown.part.diagnostics, values);
    clock.begin("draw");
    MapOfShards map(wanted, std::move(shown), log.survey, read_shard_count(values));
    const viz::Image image = map.draw();
    clock.begin("write the picture");
    output.write(image, fmt::format("clsurf map of {} from {}: {} {:g} to {:g} {}", file_name(wanted.part.program),
                                    run_name(map.shown(), wanted), map.shown().field.info.name, map.range().low,
                                    map.range().high, map.shown().field.info.unit.name));
    clock.end();
    return true;
}

}  // namespace clsurf::cli
