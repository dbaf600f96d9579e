#include "io/page/page_data.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/block.h"
#include "core/units.h"
#include "io/reports/defect_fingerprint.h"
#include "io/reports/quality_words.h"
#include "predictor/severity.h"
#include "program/frame_placement.h"

namespace clsurf::io {
namespace {

constexpr double position_quantum = 1e-4;  ///< [mm]
constexpr double time_quantum = 1e-6;      ///< [s]
constexpr double before_steps = 16;        ///< steps in the distance between two points
constexpr double field_steps = 32768;      ///< steps in the shown range
constexpr double class_quantum = 1e-3;     ///< step of classes that have a unit

/// Collects columns and packs them in parallel once all are known.
class Blocks {
public:
    using Make = std::function<PackedColumn()>;

    /// `where`: the position in the manifest; `make`: packs the column.
    void add(Json::json_pointer where, Make make) { columns_.push_back({std::move(where), std::move(make), {}}); }

    void pack(PageData& data) {
        parallel_for(static_cast<std::int64_t>(columns_.size()), 1, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t i = first; i < last; ++i) {
                Planned& column = columns_[static_cast<std::size_t>(i)];
                column.packed = column.make();
            }
        });
        for (Planned& column : columns_) {
            const PackedColumn& p = column.packed;
            data.manifest[column.where] = {{"block", data.blocks.size()},
                                           {"count", p.count},
                                           {"order", p.order},
                                           {"stride", p.stride},
                                           {"planes", p.planes}};
            data.blocks.push_back(std::move(column.packed.base64));
        }
    }

private:
    struct Planned {
        Json::json_pointer where;
        Make make;
        PackedColumn packed;
    };
    std::vector<Planned> columns_;
};

/// One value per kept point, in steps of `quantum`.
template <typename Value>
PackedColumn pack_kept(const KeptPoints& kept, double quantum, Value&& value) {
    std::vector<std::int64_t> steps(kept.points.size());
    std::int64_t before = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const double v = value(kept.points[k]) / quantum;
        if (std::abs(v) < 4e15) before = std::llround(v);  // a missing value repeats the previous one
        steps[k] = before;
    }
    return pack_integers(steps);
}

template <typename T>
PackedColumn pack_numbers(std::span<const T> numbers, int stride) {
    return pack_integers(std::vector<std::int64_t>(numbers.begin(), numbers.end()), stride);
}

/// First and last point of each range.
PackedColumn pack_ranges(std::span<const PointRange> ranges) {
    std::vector<std::int64_t> ends;
    for (const PointRange& range : ranges) ends.insert(ends.end(), {range.first, range.last});
    return pack_integers(ends, 2);
}

Json::json_pointer at(const std::string& base, const std::string& name) { return Json::json_pointer(base) / name; }

/// The step to which the values of a field are rounded.
double quantum_of(const FieldInfo& info, const ShownRange& range) {
    // A class is identified by its value.
    if (has_classes(info)) return info.unit.name.empty() ? 1 : class_quantum;
    const double quantum = (range.high - range.low) / field_steps;
    if (quantum > 0) return quantum;
    return std::max({std::abs(range.low), std::abs(range.lowest), std::abs(range.highest), 1e-9}) / field_steps;
}

Json classes_json(const std::vector<PageClass>& classes, double quantum) {
    Json all = Json::array();
    for (const PageClass& c : classes)
        all.push_back(
            {{"name", c.name}, {"step", std::llround(c.value / quantum)}, {"rgb", c.rgb}, {"share", c.share}});
    return all;
}

void add_field(Blocks& blocks, Json& json, const std::string& base, const PageSurface& surface, std::size_t index,
               const ShownRange& range) {
    const Field& field = surface.fields[index];
    const double unit = field.info.unit.per_inside;
    const double quantum = quantum_of(field.info, range);
    const KeptPoints& kept = *surface.kept;
    const float* values = field.values.data();
    const auto value = [values, unit](PointIndex i) { return static_cast<double>(values[i]) * unit; };
    json.push_back({{"name", field.info.name}, {"quantum", quantum}});
    if (has_classes(field.info)) json.back()["classes"] = classes_json(surface.classes[index], quantum);
    const std::string here = base + "/fields/" + std::to_string(json.size() - 1);
    blocks.add(at(here, "values"), [&kept, quantum, value] { return pack_kept(kept, quantum, value); });
    if (index < surface.ramps.size() && !surface.ramps[index].empty())
        blocks.add(at(here, "ramps"), [&ramps = surface.ramps[index]] { return pack_ranges(ramps); });
    std::string missing(kept.points.size(), '\0');
    for (std::size_t k = 0; k < missing.size(); ++k) missing[k] = std::isfinite(value(kept.points[k])) ? '\0' : '\1';
    if (missing.find('\1') == std::string::npos) return;
    blocks.add(at(here, "missing"), [flags = std::move(missing)] { return pack_bytes(flags); });
}

void add_positions(Blocks& blocks, const std::string& base, const PageSurface& s) {
    const KeptPoints& kept = *s.kept;
    const Positions& p = s.surface->positions;
    const Column<float>* axes[] = {&p.x, &p.y, &p.z};
    const char* names[] = {"x", "y", "z"};
    for (std::size_t k = 0; k < 3; ++k) {
        const float* values = axes[k]->data();
        blocks.add(at(base + "/columns", names[k]), [&kept, values] {
            return pack_kept(kept, position_quantum, [values](PointIndex i) { return values[i]; });
        });
    }
}

/// Positions of the other roles, as differences from the positions of the surface.
void add_roles(Blocks& blocks, Json& surface_json, const std::string& base, const PageSurface& s) {
    Json roles = Json::array();
    const char* names[] = {"x", "y", "z"};
    for (const Trajectory& other : s.other_roles) {
        const std::string here = base + "/roles/" + std::to_string(roles.size());
        roles.push_back({{"name", name_of(other.role)}});
        for (int axis = 0; axis < 3; ++axis) {
            blocks.add(at(here, names[axis]), [&s, &other, axis] {
                return pack_kept(*s.kept, position_quantum,
                                 [&](PointIndex i) { return other.at(i)[axis] - s.path->at(i)[axis]; });
            });
        }
    }
    surface_json["roles"] = std::move(roles);
}

/// The first point of each run of points with the same line, kept or not, and the line.
struct LineRuns {
    std::vector<std::int64_t> points, lines;
};
LineRuns line_runs(const LineMap& map) {
    LineRuns runs;
    std::vector<LineNumber> block;
    for (PointIndex begin = 0; begin < map.count(); begin += block_points) {
        block.resize(static_cast<std::size_t>(std::min(block_points, map.count() - begin)));
        map.read(begin, block);
        for (std::size_t i = 0; i < block.size(); ++i) {
            if (!runs.lines.empty() && runs.lines.back() == block[i]) continue;
            runs.points.push_back(begin + static_cast<PointIndex>(i));
            runs.lines.push_back(block[i]);
        }
    }
    return runs;
}

/// Per kept point: the kind of its pass, plus 4 if it is joined to the previous point.
std::string kinds_of(const PageSurface& s) {
    std::string kinds(s.kept->points.size(), '\0');
    std::size_t at = 0;
    for (const Pass& pass : s.surface->passes) {
        for (; at < kinds.size() && s.kept->points[at] <= pass.last; ++at)
            kinds[at] = static_cast<char>(static_cast<int>(pass.kind) | (s.joined[at] != 0 ? 4 : 0));
    }
    return kinds;
}

/// Why the tool is slow: phrases, one per line, and for each kept point which of them apply. Nothing without slow points.
void add_slow_words(Blocks& blocks, Json& json, const std::string& base, const PageSurface& s) {
    if (s.slow == nullptr || s.slow->columns.empty()) return;
    json["slow"]["columns"] = Json::array();
    blocks.add(at(base + "/slow", "speed"), [&s] { return pack_integers(s.slow->speeds); });
    blocks.add(at(base + "/slow", "pieces"), [&s] {
        std::string text;
        for (const std::string& piece : s.slow->pieces) text += piece + '\n';
        return pack_bytes(text);
    });
    for (const std::vector<std::uint32_t>& column : s.slow->columns) {
        const std::string here = std::to_string(json["slow"]["columns"].size());
        json["slow"]["columns"].push_back(nullptr);
        blocks.add(at(base + "/slow/columns", here),
                   [&column] { return pack_numbers(std::span<const std::uint32_t>(column), 1); });
    }
}

Json surface_json(Blocks& blocks, const std::string& base, const ReportPage& page, const PageSurface& s,
                  const std::string& name) {
    const ClSurface& surface = *s.surface;
    Json json{{"log", name},
              {"role", name_of(s.path->role)},
              {"records", s.log->records},
              {"period_s", s.log->period},
              {"step_over_mm", surface.step_over},
              {"origin_mm", exact_vector(surface.positions.origin)},
              {"position_quantum_mm", position_quantum},
              {"time_quantum_s", time_quantum},
              {"points", s.kept->all},
              {"window", s.kept->window},
              {"line_starts", s.kept->line_starts}};
    json["columns"] = Json::object();
    blocks.add(at(base + "/columns", "point"),
               [&s] { return pack_numbers(std::span<const PointIndex>(s.kept->points), 1); });
    LineRuns runs = line_runs(*s.lines);
    blocks.add(at(base + "/columns", "run_points"),
               [points = std::move(runs.points)] { return pack_integers(points); });
    blocks.add(at(base + "/columns", "run_lines"), [lines = std::move(runs.lines)] { return pack_integers(lines); });
    blocks.add(at(base + "/columns", "kind"), [&s] { return pack_bytes(kinds_of(s)); });
    blocks.add(at(base + "/columns", "triangles"), [&s] { return pack_numbers(s.triangles, 3); });
    blocks.add(at(base + "/columns", "segments"), [&s] { return pack_numbers(s.segments, 2); });
    if (s.log->find("time") != nullptr) {
        blocks.add(at(base + "/columns", "time"),
                   [&s] { return pack_kept(*s.kept, time_quantum, [&](PointIndex i) { return s.log->time_of(i); }); });
    }
    add_positions(blocks, base, s);
    std::vector<std::int64_t> passes;
    for (const Pass& pass : surface.passes) {
        if (pass.kind == PassKind::cut) passes.insert(passes.end(), {pass.first, pass.last});
    }
    json["pass_count"] = passes.size() / 2;
    blocks.add(at(base + "/columns", "passes"), [passes = std::move(passes)] { return pack_integers(passes, 2); });
    add_roles(blocks, json, base, s);
    json["fields"] = Json::array();
    if (!s.places_before.empty()) {
        // In sixteenths of the distance between points, from 1; 0: not on the earlier path.
        blocks.add(at(base + "/columns", "before"), [&s] {
            return pack_kept(*s.kept, 1.0 / before_steps, [&](PointIndex i) {
                const PathLocation& place = s.places_before[static_cast<std::size_t>(i)];
                return place.exists() ? static_cast<double>(place.point) + static_cast<double>(place.fraction) + 1.0
                                      : 0.0;
            });
        });
    }
    add_slow_words(blocks, json, base, s);
    for (std::size_t k = 0; k < s.fields.size(); ++k) add_field(blocks, json["fields"], base, s, k, page.ranges[k]);
    return json;
}

Json fields_json(const ReportPage& page) {
    Json all = Json::array();
    for (std::size_t k = 0; k < page.surfaces.front().fields.size(); ++k) {
        const FieldInfo& info = page.surfaces.front().fields[k].info;
        const ShownRange& range = page.ranges[k];
        all.push_back({{"name", info.name},
                       {"label", info.label},
                       {"unit", info.unit.name},
                       {"map", page.field_maps[k]},
                       {"slack", number(info.slack * std::abs(info.unit.per_inside))},
                       {"classes", has_classes(info)},
                       {"same_classes", !info.classes.empty()},
                       {"note", info.note},
                       {"low", number(range.low)},
                       {"high", number(range.high)},
                       {"lowest", number(range.lowest)},
                       {"highest", number(range.highest)},
                       {"range_note", range.note}});
    }
    return all;
}

Json sections_json(const std::vector<DefectSection>& sections) {
    Json all = Json::array();
    for (const DefectSection& section : sections) {
        all.push_back({{"pass", section.pass},
                       {"points", {section.points.first, section.points.last}},
                       {"lines", {section.first_line, section.last_line}}});
    }
    return all;
}

Json lines_json(const std::vector<std::vector<Vec3>>& lines) {
    Json all = Json::array();
    for (const std::vector<Vec3>& line : lines) {
        Json corners = Json::array();
        for (const Vec3& corner : line) {
            for (const double c : {corner.x(), corner.y(), corner.z()})
                corners.push_back(std::round(c / position_quantum) * position_quantum);
        }
        all.push_back(std::move(corners));
    }
    return all;
}

Json defects_json(const ReportPage& page) {
    Json all = Json::array();
    const std::vector<std::string> fingerprints = fingerprints_of(page.quality.report->defects);
    for (std::size_t i = 0; i < page.defects.size(); ++i) {
        const Defect& d = page.quality.report->defects[i];
        // All digits: the page rounds once, as the sentences do.
        all.push_back({{"id", i + 1},
                       {"fingerprint", fingerprints[i]},
                       {"severity", d.severity},
                       {"severity_name", name_of_severity(d.severity)},
                       {"cause", name_of(d.cause)},
                       {"quantity", name_of(d.quantity)},
                       {"text", sentence_of(d)},
                       {"bounds_mm", box(d.contact_bounds.isEmpty() ? d.bounds : d.contact_bounds)},
                       {"depth_um", number(d.depth * um_per_mm)},
                       {"score", number(d.score)},
                       {"speed_percent", number(100 * d.speed_mismatch)},
                       {"length_mm", number(d.length)},
                       {"shape", shape_of(d)},
                       {"point", d.point},
                       {"runs", sections_json(strongest_first(d))},
                       {"neighbours", sections_json(d.neighbours)},
                       {"outlines", lines_json(page.defects[i].outlines)}});
        add_place(all.back(), d.place);
        if (page.change) {
            const std::optional<std::size_t>& before = page.change->match.before_of[i];
            all.back()["change"] = before ? "remaining" : "new";
            if (before) all.back()["id_before"] = *before + 1;
        }
        if (page.quality.acceptance != nullptr) {
            const Acceptance::Entry& entry = page.quality.acceptance->of_defect[i];
            all.back()["accepted"] = entry.accepted;
            all.back()["comment"] = entry.comment;
        }
        if (page.quality.as_machined != nullptr)
            all.back()["formed_um"] = number(page.quality.as_machined->marks[i].depth * um_per_mm);
        if (page.defects[i].normal != Vec3::Zero()) all.back()["normal"] = exact_vector(page.defects[i].normal);
        if (!page.defects[i].contact_outlines.empty())
            all.back()["contact_outlines"] = lines_json(page.defects[i].contact_outlines);
    }
    return all;
}

/// `upright`: the tool axis is Z along the whole path.
Json tool_json(const CuttingTool& tool, bool upright) {
    return {{"text", to_text(tool)}, {"radius_mm", tool.radius}, {"corner_mm", tool.corner}, {"upright", upright}};
}

/// Defects of the earlier log that are gone: their description and position.
Json gone_json(const ReportPage& page) {
    Json all = Json::array();
    if (!page.change) return all;
    for (const std::size_t i : page.change->match.gone) {
        const Defect& d = page.change->before->defects[i];
        all.push_back({{"id", i + 1},
                       {"severity", d.severity},
                       {"severity_name", name_of_severity(d.severity)},
                       {"cause", name_of(d.cause)},
                       {"text", sentence_of(d)},
                       {"bounds_mm", box(d.bounds)},
                       {"point", d.point}});
        add_place(all.back(), d.place);
    }
    return all;
}

void add_height_map(Blocks& blocks, Json& manifest, const PageHeightMap& height_map) {
    constexpr double quantum_um = 1e-2;
    manifest["relief"] = {{"origin_mm", exact_vector(height_map.origin)},
                          {"pitch_mm", height_map.pitch},
                          {"columns", height_map.columns},
                          {"rows", height_map.rows},
                          {"z_quantum_mm", position_quantum},
                          {"deviation_quantum_um", quantum_um},
                          {"low", number(height_map.range.low)},
                          {"high", number(height_map.range.high)},
                          {"lowest", number(height_map.range.lowest)},
                          {"highest", number(height_map.range.highest)},
                          {"note", height_map.note}};
    const auto steps = [](std::span<const float> values, double quantum) {
        std::vector<std::int64_t> out;
        std::int64_t before = 0;
        for (const float v : values) out.push_back(before = std::isfinite(v) ? std::llround(v / quantum) : before);
        return pack_integers(out);
    };
    std::string missing;
    for (std::size_t k = 0; k < height_map.z.size(); ++k)
        missing += !std::isfinite(height_map.z[k]) ? '\1' : !std::isfinite(height_map.deviation[k]) ? '\2' : '\0';
    blocks.add(at("/relief", "z"), [&height_map, steps] { return steps(height_map.z, position_quantum); });
    blocks.add(at("/relief", "deviation"),
               [&height_map, steps] { return steps(height_map.deviation, quantum_um / um_per_mm); });
    blocks.add(at("/relief", "missing"), [flags = std::move(missing)] { return pack_bytes(flags); });
}

void add_programmed(Blocks& blocks, Json& manifest, const PageProgrammed& programmed) {
    manifest["programmed"] = {{"quantum_mm", position_quantum}};
    const char* names[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        blocks.add(at("/programmed", names[axis]), [&programmed, axis] {
            std::vector<std::int64_t> steps;
            for (const Vec3& corner : programmed.corners)
                steps.push_back(std::llround(corner[axis] / position_quantum));
            return pack_integers(steps);
        });
    }
    blocks.add(at("/programmed", "begin"),
               [&programmed] { return pack_bytes(std::string(programmed.begin.begin(), programmed.begin.end())); });
}

}  // namespace

PageData page_data(const ReportPage& page) {
    PageData data;
    Blocks blocks;
    const SourceText& text = page.quality.program->main();
    Json& m = data.manifest;
    m = {{"version", 1},
         {"program", {{"name", text.name()}, {"lines", text.line_count()}}},
         {"command",
          {{"program", page.program},
           {"log", page.log},
           {"before", page.before},
           {"options", page.reading_options},
           {"formed", page.as_machined_options}}},
         {"first_field", page.first_field},
         {"work_system", common_work_system(page.quality.program->motions)},
         {"judged", page.quality.report->judgement.judged()}};
    if (page.quality.tool) {
        const PageSurface& shown = page.surfaces.front();
        m["tool"] = tool_json(*page.quality.tool, !tilts(*shown.log, *shown.path));
    }
    m["colour_maps"] = Json::array();
    for (const PageColourMap& map : page.colour_maps)
        m["colour_maps"].push_back({{"name", map.name},
                                    {"summary", map.summary},
                                    {"centred", map.centred},
                                    {"below", map.below},
                                    {"above", map.above},
                                    {"rgb", to_base64(map.rgb)}});
    m["fields"] = fields_json(page);
    m["defects"] = defects_json(page);
    m["gone"] = gone_json(page);
    m["surfaces"] = Json::array();
    const std::string names[] = {page.log, page.before};
    for (std::size_t k = 0; k < page.surfaces.size(); ++k)
        m["surfaces"].push_back(
            surface_json(blocks, "/surfaces/" + std::to_string(k), page, page.surfaces[k], names[k]));
    if (page.height_map) add_height_map(blocks, m, *page.height_map);
    if (page.programmed) add_programmed(blocks, m, *page.programmed);
    blocks.add(at("/program", "text"), [&text] { return pack_bytes(text.text()); });
    blocks.pack(data);
    return data;
}

}  // namespace clsurf::io
