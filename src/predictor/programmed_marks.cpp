#include "predictor/programmed_marks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/point_ranges.h"
#include "predictor/candidates.h"
#include "surface/path_location.h"

namespace clsurf {
namespace {

constexpr float room = 6;  ///< step-overs before and after a defect, within which the pass returns to the others
constexpr float returned = 3e-4F;  ///< [mm] offset that rounding leaves after the return; 1 µm/√12 is 2.9e-4
constexpr int farthest_pass = 8;   ///< number of passes from a mark to the first one without it
// As in docs/formed.md#definitions, Form.
constexpr std::size_t clean_aside = 2;

/// Whether the depth of a defect comes from the program.
bool is_programmed(const Defect& defect, const Signals& signals, const Thresholds& thresholds) {
    if (defect.quantity == Quantity::relief) return true;
    return !signals.measured && defect.depth > static_cast<double>(thresholds.of[index_of(Quantity::relief)]);
}

/// A run, extended on both sides within its pass.
PointRange widened(const PointRange& run, const ClSurface& surface) {
    const Positions& p = surface.positions;
    const Pass& pass = surface.passes[pass_of(surface.passes, run.first)];
    const float reach = room * static_cast<float>(surface.step_over);
    const auto go = [&](PointIndex i, PointIndex end, PointIndex direction) {
        for (float gone = 0; i != end && gone < reach; i += direction) {
            const float step = (p[i + direction] - p[i]).norm();
            if (!(step < reach)) break;
            gone += step;
        }
        return i;
    };
    return {go(run.first, pass.first, -1), go(run.last, pass.last, +1)};
}

class Offsets {
public:
    /// All must outlive it. `marked`: the points of marks, in order.
    Offsets(const ClSurface& surface, const Signals& signals, const std::vector<PointRange>& marked)
        : surface_(surface), signals_(signals), marked_(marked) {}

    /// nullopt if passes are missing on one side of the point.
    [[nodiscard]] std::optional<Eigen::Vector3f> at(PointIndex point) const {
        const Eigen::Vector3f feed = signals_.feed(point);
        const Eigen::Vector3f usual_normal = signals_.normal(point);
        if (!feed.allFinite() || !usual_normal.allFinite()) return std::nullopt;
        const std::vector<Eigen::Vector3f> left = clean_places(point, feed, Side::left);
        const std::vector<Eigen::Vector3f> right = clean_places(point, feed, Side::right);
        if (left.empty() || right.empty()) return std::nullopt;
        const Eigen::Vector3f here = surface_.positions[point];
        const Eigen::Vector3f across = (right.front() - left.front()).normalized();
        Eigen::Vector3f normal = across.cross(feed).normalized();
        if (normal.dot(usual_normal) < 0) normal = -normal;
        if (!normal.allFinite()) return std::nullopt;
        // Lagrange's polynomial through the clean places, evaluated at the point's position across the feed.
        std::vector<Eigen::Vector3f> places = left;
        places.insert(places.end(), right.begin(), right.end());
        const auto over = [&](std::size_t k) { return (places[k] - here).dot(across); };
        float height = 0;
        for (std::size_t k = 0; k < places.size(); ++k) {
            float weight = 1;
            for (std::size_t other = 0; other < places.size(); ++other) {
                if (other != k) weight *= over(other) / (over(other) - over(k));
            }
            height += weight * (places[k] - here).dot(normal);
        }
        if (!std::isfinite(height)) return std::nullopt;
        return -height * normal;
    }

private:
    [[nodiscard]] bool is_marked(PointIndex point) const { return any_has(marked_, point); }

    /// Places on the nearest passes of one side without a mark there, the nearest pass first.
    [[nodiscard]] std::vector<Eigen::Vector3f> clean_places(PointIndex point, const Eigen::Vector3f& feed,
                                                            Side side) const {
        std::vector<Eigen::Vector3f> places;
        int passes = 0;
        const auto here = [&](const PathLocation&) { return feed; };
        walk_aside(surface_, {point, 0}, side, here, [&](const PathLocation& at, const PathLocation&) {
            if (signals_[at.nearest()].zone == Zone::outside) return false;
            if (!is_marked(at.nearest()))
                places.push_back(position_at(surface_.positions, at));
            else if (!places.empty())
                return false;
            return ++passes < farthest_pass && places.size() < clean_aside;
        });
        return places;
    }

    const ClSurface& surface_;
    const Signals& signals_;
    const std::vector<PointRange>& marked_;
};

/// In ascending order, overlapping ranges joined.
std::vector<PointRange> joined(std::vector<PointRange> ranges) {
    std::sort(ranges.begin(), ranges.end(), [](const PointRange& a, const PointRange& b) { return a.first < b.first; });
    std::vector<PointRange> result;
    for (const PointRange& range : ranges) {
        if (!result.empty() && range.first <= result.back().last + 1)
            result.back().last = std::max(result.back().last, range.last);
        else
            result.push_back(range);
    }
    return result;
}

}  // namespace

ProgrammedMarks::ProgrammedMarks(const ClSurface& surface, const Signals& signals, const QualityReport& report) {
    std::vector<PointRange> marks;
    std::vector<PointRange> marked;
    for (const Defect& defect : report.defects) {
        if (!is_programmed(defect, signals, report.thresholds)) continue;
        for (const DefectSection& section : defect.sections) {
            marks.push_back(section.points);
            marked.push_back(widened(section.points, surface));
        }
    }
    marks = joined(std::move(marks));
    marked = joined(std::move(marked));
    const Offsets offsets(surface, signals, marked);
    auto mark = marks.begin();
    for (const PointRange& range : marked) {
        // From the mark itself, extended until the pass has returned to the others.
        PointRange points = *mark;
        while (mark != marks.end() && mark->last <= range.last) points.last = (mark++)->last;
        const auto is_off = [&](PointIndex i) {
            const std::optional<Eigen::Vector3f> offset = offsets.at(i);
            return offset && offset->norm() > returned;
        };
        while (points.first > range.first && is_off(points.first - 1)) --points.first;
        while (points.last < range.last && is_off(points.last + 1)) ++points.last;
        Run run{points.first, {}};
        run.offsets.reserve(static_cast<std::size_t>(points.size()));
        for (PointIndex i = points.first; i <= points.last; ++i)
            run.offsets.push_back(offsets.at(i).value_or(Eigen::Vector3f::Zero()));
        runs_.push_back(std::move(run));
    }
}

std::vector<ProgrammedMarks::Run>::const_iterator ProgrammedMarks::run_from(PointIndex point) const {
    return std::partition_point(runs_.begin(), runs_.end(), [&](const Run& run) {
        return run.first + static_cast<PointIndex>(run.offsets.size()) <= point;
    });
}

Vec3 ProgrammedMarks::at(PointIndex point) const {
    const auto run = run_from(point);
    if (run == runs_.end() || run->first > point) return Vec3::Zero();
    return run->offsets[static_cast<std::size_t>(point - run->first)].cast<double>();
}

void ProgrammedMarks::take_off(PointIndex first, int axis, std::span<double> positions) const {
    const PointIndex end = first + static_cast<PointIndex>(positions.size());
    for (auto run = run_from(first); run != runs_.end() && run->first < end; ++run) {
        const PointIndex run_end = std::min(end, run->first + static_cast<PointIndex>(run->offsets.size()));
        for (PointIndex i = std::max(first, run->first); i < run_end; ++i)
            positions[static_cast<std::size_t>(i - first)] -=
                static_cast<double>(run->offsets[static_cast<std::size_t>(i - run->first)][axis]);
    }
}

}  // namespace clsurf
