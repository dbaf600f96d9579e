#include "pipeline/point_query.h"
#include "mapping/line_agreement.h"

#include <array>
#include <cmath>
#include <utility>

namespace clsurf {
namespace {

constexpr PointIndex window = 256;  ///< points to each side that derivatives may use

/// Pieces of passes that have one line each.
Passes cut_by_lines(const Part& part, const Passes& passes) {
    Passes pieces;
    for (const Pass& pass : passes) {
        Pass piece{pass.first, pass.first, pass.kind};
        LineNumber line = part.lines->line_at(pass.first);
        for (PointIndex i = pass.first + 1; i <= pass.last; ++i) {
            const LineNumber now = part.lines->line_at(i);
            if (now != line) {
                pieces.push_back(piece);
                piece.first = i;
                line = now;
            }
            piece.last = i;
        }
        pieces.push_back(piece);
    }
    return pieces;
}

/// The number of the cut pass of a point.
std::optional<std::int64_t> pass_at(const Passes& passes, PointIndex point) {
    std::int64_t number = 0;
    for (const Pass& pass : passes) {
        if (pass.kind == PassKind::cut) ++number;
        if (point >= pass.first && point <= pass.last)
            return pass.kind == PassKind::cut ? std::optional(number) : std::nullopt;
    }
    return std::nullopt;
}

/// The points around a point that have the same line, or the same kind of motion.
template <typename Same>
PointRange spread(PointIndex point, PointIndex count, PointIndex reach, Same&& same) {
    PointRange range{point, point};
    while (range.first > 0 && point - range.first < reach && same(range.first - 1)) --range.first;
    while (range.last + 1 < count && range.last - point < reach && same(range.last + 1)) ++range.last;
    return range;
}

}  // namespace

PointQuery::PointQuery(const Part& part, bool needs_surface)
    : part_(part), chains_(part.log, part.program, *part.lines) {
    std::shared_ptr<const MotionEstimate> estimate;
    if (part.derivative == DerivativeMethod::kalman)
        estimate = estimate_motion(part, find_runs(gather(part.path), *part.lines));
    estimated_ = estimate != nullptr;
    fused_ = estimated_ && estimate->fused() != nullptr;
    fields_.emplace(part.log, part.path, Passes(), Derivation{std::move(estimate), 0});
    if (needs_surface || part.tool) surface_ = stitch(part);
    if (part.tool) contacts_ = std::make_unique<const PartContacts>(part, *surface_, *part.tool);
}

CutterPlace PointQuery::place(PointIndex point) const {
    return contacts_ ? contacts_->place(point) : CutterPlace{part_.path.at(point), std::nullopt};
}

std::vector<FoundPlace> PointQuery::find_nearest(const WantedPlace& wanted) const {
    if (knows_contacts() && !wanted.of_tip) {
        std::vector<FoundPlace> found = contacts_->find(wanted);
        if (!found.empty() || wanted.from_above) return found;
    }
    const ClSurface& surface = *surface_;
    if (surface.step_over > 0) return find_places(part_.path, surface.passes, nullptr, surface.step_over, wanted);
    return find_places(part_.path, cut_by_lines(part_, surface.passes), nullptr, 0, wanted);
}

QueryMatch PointQuery::match(PointIndex point) const {
    QueryMatch match;
    const LineMap& lines = *part_.lines;
    match.point = point;
    match.time = part_.log.time_of(point);
    match.line = lines.line_at(point);
    match.calls = chains_.of(point);
    match.text = std::string(part_.program.main().line(match.line));
    match.place = place(point);
    if (surface_) match.pass = pass_at(surface_->passes, point);
    match.line_points = spread(point, part_.log.records, part_.log.records,
                               [&](PointIndex i) { return lines.line_at(i) == match.line; });
    read_confidences(part_.path, part_.program, lines, point, {&match.confidence, 1});
    add_motion(match);
    return match;
}

void PointQuery::add_motion(QueryMatch& match) const {
    const LineMap& lines = *part_.lines;
    // Derivatives use only points of the same kind of motion.
    const auto kind_at = [&](PointIndex i) {
        PointKind kind = PointKind::idle;
        lines.read_kinds(i, {&kind, 1});
        return kind;
    };
    const PointKind kind = kind_at(match.point);
    const PointRange piece =
        spread(match.point, part_.log.records, window, [&](PointIndex i) { return kind_at(i) == kind; });
    Passes local;
    local.push_back({piece.first, piece.last, PassKind::cut});
    static constexpr std::array<std::string_view, 10> names{
        "speed",      "acceleration", "speed_uncertainty",      "acceleration_uncertainty", "position.x",
        "position.y", "position.z",   "position_uncertainty.x", "position_uncertainty.y",   "position_uncertainty.z"};
    const std::size_t wanted = fused_ ? 10 : estimated_ ? 4 : 2;
    const std::vector<Field> values =
        fields_->within(local).compute(std::span(names).first(wanted), {match.point, match.point});
    const auto value = [&](std::size_t k) { return static_cast<double>(values[k].values[0]); };
    match.speed = value(0);
    match.acceleration = value(1);
    match.why = speed_reasons(part_, match.point, match.speed);
    if (estimated_) {
        match.speed_uncertainty = value(2);
        match.acceleration_uncertainty = value(3);
        match.estimated_from = values[0].info.note;
    }
    if (fused_)
        match.fused = QueryMatch::FusedPosition{Vec3(value(4), value(5), value(6)), Vec3(value(7), value(8), value(9))};
}

bool PointQuery::is_off_the_part(double distance) const {
    constexpr double step_overs = 5;
    constexpr double of_one_pass = 10;  // mm: without a step-over; a tip may be a tool radius off the part
    return distance > (step_over() > 0 ? step_overs * step_over() : of_one_pass);
}

std::vector<PointRange> PointQuery::points_of_line(std::size_t file, LineNumber line) const {
    return file == 0 ? part_.lines->points_of(line) : points_of(part_.program, *part_.lines, file, line);
}

PointIndex point_at_time(const Log& log, double time) {
    if (log.find("time") == nullptr) return std::llround(time / log.period);
    PointIndex low = 0;
    PointIndex high = log.records - 1;
    while (low < high) {
        const PointIndex middle = low + (high - low) / 2;
        (log.time_of(middle) < time ? low = middle + 1 : high = middle);
    }
    const bool before_is_nearer = low > 0 && time - log.time_of(low - 1) < log.time_of(low) - time;
    return before_is_nearer ? low - 1 : low;
}

}  // namespace clsurf
