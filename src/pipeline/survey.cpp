#include "pipeline/survey.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/block.h"
#include "core/error.h"
#include "core/point_ranges.h"
#include "machined/contact_points.h"
#include "pipeline/placement.h"
#include "pipeline/roles.h"
#include "surface/smoothing_segments.h"
#include "toolpath/stated_axes.h"

namespace clsurf {
namespace {

/// Throws if a survey could not give the same results as the whole log.
void refuse_others(const Part& part) {
    if (part.path.kinematics || find_rotary_motion(part.log, part.path.role))
        throw UsageError("a survey is for machines of three axes: " + part.log.name + " has rotary axes that move");
    if (part.derivative != DerivativeMethod::savgol)
        throw UsageError("--derivative kalman needs the whole log; shards support savgol only");
}

void extend_by(const Trajectory& path, const Vec3& origin, PointIndex first, PointIndex last,
               Eigen::AlignedBox3f& box) {
    const auto n = static_cast<std::size_t>(last - first);
    std::array<std::vector<double>, 3> p;
    for (std::vector<double>& axis : p) axis.resize(n);
    path.read(first, p[0], p[1], p[2]);
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector3f at = (Vec3(p[0][i], p[1][i], p[2][i]) - origin).cast<float>();
        if (at.allFinite()) box.extend(at);
    }
}

std::vector<Eigen::AlignedBox3f> boxes_of(const Trajectory& path, const Trajectory* measured, const Vec3& origin) {
    std::vector<Eigen::AlignedBox3f> boxes(static_cast<std::size_t>((path.count + block_points - 1) / block_points));
    for_each_block(path.count, [&](PointIndex first, PointIndex last) {
        Eigen::AlignedBox3f box;
        extend_by(path, origin, first, last, box);
        if (measured != nullptr) extend_by(*measured, origin, first, last, box);
        boxes[static_cast<std::size_t>(first / block_points)] = box;
    });
    return boxes;
}

std::vector<Eigen::AlignedBox3f> surface_boxes_of(const ClSurface& surface) {
    const PointIndex count = surface.positions.size();
    std::vector<Eigen::AlignedBox3f> boxes(static_cast<std::size_t>((count + block_points - 1) / block_points));
    for_each_block(count, [&](PointIndex first, PointIndex last) {
        Eigen::AlignedBox3f box;
        for (auto pass = range_at(surface.passes, first); pass != surface.passes.end() && pass->first < last; ++pass) {
            if (!is_of_surface(pass->kind)) continue;
            const PointIndex end = std::min(last, pass->last + 1);
            for (PointIndex i = std::max(first, pass->first); i < end; ++i) {
                const Eigen::Vector3f at = surface.positions[i];
                if (at.allFinite()) box.extend(at);
            }
        }
        boxes[static_cast<std::size_t>(first / block_points)] = box;
    });
    return boxes;
}

/// Stores the data from which the line map can be restored.
void note_lines(const Part& part, Survey& survey) {
    const LineMap& map = *part.lines;
    survey.match = map.match();
    survey.motions = map.point_motions();
    survey.confidences = map.confidences();
    if (!map.from_log()) return;
    const Channel* const channel = part.log.find("line");
    survey.lines_of_log = channel != nullptr && channel->values.first == map.channel().first;
    if (survey.lines_of_log) return;
    survey.lines.resize(static_cast<std::size_t>(map.count()));
    for_each_block(map.count(), [&](PointIndex first, PointIndex last) {
        copy_block(map.channel(), first, std::span(survey.lines.data() + first, static_cast<std::size_t>(last - first)),
                   0);
    });
}

/// Throws if a point has a motion that the program does not have.
void check_motions(const Survey& survey, std::size_t known, PointIndex first, PointIndex last) {
    if (survey.motions.empty()) return;
    for (PointIndex i = first; i < last; ++i) {
        const std::uint32_t motion = survey.motions[static_cast<std::size_t>(i)];
        if (motion == LineMap::no_motion || motion < known) continue;
        throw InputError(Place::of_file(survey.file),
                         fmt::format("is damaged: point {} has motion {}, the program has {}", i, motion, known));
    }
}

std::shared_ptr<const LineMap> lines_of(const Program& program, const Log& log, const Survey& survey) {
    Column<std::uint32_t> motions = Column<std::uint32_t>::borrowed(survey.motions);
    std::shared_ptr<LineMap> map;
    if (survey.lines_of_log) {
        map = std::make_shared<LineMap>(log.find("line")->values, program, log.keep_alive, std::move(motions));
    } else if (!survey.lines.empty()) {
        map = std::make_shared<LineMap>(view_of(survey.lines), program, survey.keep_alive, std::move(motions));
    } else {
        map =
            std::make_shared<LineMap>(std::move(motions), Column<std::uint8_t>::borrowed(survey.confidences), program);
    }
    map->set_match(survey.match);
    if (survey.check_lines) {
        map->check_when_read(
            {survey.points, [&survey, motions_known = program.motions.kind.size()](PointIndex first, PointIndex last) {
                 survey.check_lines(first, last);
                 check_motions(survey, motions_known, first, last);
             }});
    }
    return map;
}

}  // namespace

Survey make_survey(const Part& part, std::optional<Role> wanted) {
    refuse_others(part);
    Survey survey;
    survey.points = part.path.count;
    survey.role = part.path.role;
    survey.offset = part.path.offset;
    survey.turn = part.path.turn;
    note_lines(part, survey);
    ClSurface surface = stitch(part);
    survey.origin = surface.positions.origin;
    survey.step_over = surface.step_over;
    survey.not_finishing = surface.not_finishing;
    {
        const ArcLength arc_length(surface.positions);
        survey.arc_lengths = arc_length.sums();
        survey.cut_length = cut_arc_length(surface, arc_length);
    }
    std::optional<Trajectory> measured;
    if (const std::optional<Role> role = measured_role(part.log, part.path, wanted))
        measured = reconstruct_like(part.log, *role, part.path);
    const Trajectory* const heights_of = measured ? &*measured : nullptr;
    survey.boxes = boxes_of(part.path, heights_of, survey.origin);
    survey.surface_boxes = surface_boxes_of(surface);
    for (const Pass& pass : surface.passes) {
        survey.low_links.push_back(pass.kind == PassKind::link &&
                                   stays_low(surface.positions, pass, surface.step_over));
    }
    survey.pieces = smoothing_segments(part.log, surface.passes);
    survey.facts = measure_facts(surface, part.path, heights_of, survey.pieces);
    {
        Signals signals = derive_when_read(surface, part.path, heights_of, survey.pieces,
                                           usual_end_zone(surface.step_over), survey.facts);
        survey.thresholds = measure_thresholds(surface, signals, {}, [&] { signals.forget(); });
    }
    survey.passes = std::move(surface.passes);
    survey.step_over_moves = std::move(surface.step_over_moves);
    survey.neighbours = std::move(surface.neighbours);
    return survey;
}

void refuse_tilted_tool(const Part& part) {
    if (!part.tool) return;
    const StatedAxes stated = stated_axes(part.program.motions);
    if (!stated.unknown && stated.axis.empty()) return;
    throw UsageError("shards are for tools along z: " + part.program.main().name() + " tilts " + to_text(*part.tool),
                     "--tool none judges the tool tips");
}

Part surveyed_part(Program program, Log log, const PartRules& rules, const Survey& survey) {
    if (log.records != survey.points) {
        throw InputError(Place::of_file(log.name),
                         fmt::format("has {} records, the log that was surveyed had {}", log.records, survey.points));
    }
    Part part;
    part.program = std::move(program);
    part.log = std::move(log);
    part.tool = rules.tool;
    part.limits = rules.limits;
    part.machine = rules.machine;
    part.derivative = rules.derivative;
    place_program(part.program, part.log, rules.poses, nullptr, part.diagnostics);
    part.path = reconstruct(part.log, survey.role, Vec3::Zero());
    part.path.offset = survey.offset;
    part.path.turn = survey.turn;
    part.lines = lines_of(part.program, part.log, survey);
    return part;
}

ClSurface surveyed_surface(const Part& part, const Survey& survey, PointIndex block) {
    ClSurface surface;
    surface.positions = gather_when_read(part.path, survey.origin, Column<double>::borrowed(survey.arc_lengths), block);
    surface.passes = Column<Pass>::borrowed(survey.passes);
    surface.step_over_moves = survey.step_over_moves;
    surface.neighbours = {Column<std::int32_t>::borrowed(survey.neighbours.left),
                          Column<std::int32_t>::borrowed(survey.neighbours.right)};
    if (survey.check_neighbours) surface.neighbours.checked = {survey.points, survey.check_neighbours};
    surface.step_over = survey.step_over;
    surface.not_finishing = survey.not_finishing;
    surface.cut_length = survey.cut_length;
    surface.low_links = survey.low_links;
    surface.boxes = survey.boxes;
    surface.surface_boxes = survey.surface_boxes;
    return surface;
}

PartSignals surveyed_signals(const Part& part, const ClSurface& surface, const Survey& survey,
                             std::optional<Role> wanted) {
    PartSignals read{std::nullopt, survey.pieces, {}};
    if (const std::optional<Role> role = measured_role(part.log, part.path, wanted))
        read.measured = reconstruct_like(part.log, *role, part.path);
    read.signals = derive_when_read(surface, part.path, read.measured ? &*read.measured : nullptr, read.pieces,
                                    usual_end_zone(surface.step_over), survey.facts);
    return read;
}

}  // namespace clsurf
