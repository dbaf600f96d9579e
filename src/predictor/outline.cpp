#include "predictor/outline.h"

#include <algorithm>
#include <optional>

#include "core/point_ranges.h"
#include "predictor/candidates.h"
#include "surface/missing_pass.h"

namespace clsurf {
namespace {

constexpr float sample_arc_length = 0.25F;  ///< step-overs between corners along a pass
constexpr float joined_arc_length = 2.0F;   ///< step-overs: sections of one pass that are closer are drawn as one

/// The points of a defect, and of clean passes between two passes of the defect.
class Region {
public:
    Region(const std::vector<DefectSection>& sections, const ClSurface& surface) : surface_(surface) {
        for (const DefectSection& section : sections) ranges_.push_back(section.points);
        join_near();
        std::vector<PointIndex> between;
        for (const PointRange& range : ranges_) {
            for (const PointIndex i : samples(range)) add_clean_neighbours(i, between);
        }
        for (const PointIndex i : between) ranges_.push_back({i, i});
        join_near();
    }

    [[nodiscard]] const std::vector<PointRange>& ranges() const { return ranges_; }

    [[nodiscard]] bool holds(PointIndex i) const { return any_has(ranges_, i); }

    /// Points of a range, evenly spaced, including the first and the last one.
    [[nodiscard]] std::vector<PointIndex> samples(const PointRange& range) const {
        std::vector<PointIndex> points{range.first};
        for (PointIndex i = range.first + 1; i < range.last; ++i) {
            if ((surface_.positions[i] - surface_.positions[points.back()]).norm() >= sample_arc_length * step_over())
                points.push_back(i);
        }
        if (range.last > range.first) points.push_back(range.last);
        return points;
    }

    [[nodiscard]] float step_over() const { return static_cast<float>(surface_.step_over); }

private:
    /// Adds the adjacent point on a clean pass if a point of the defect is beyond it.
    void add_clean_neighbours(PointIndex i, std::vector<PointIndex>& found) const {
        for (const Side side : {Side::left, Side::right}) {
            if (!has_surface(surface_, i, side)) continue;
            const PointIndex clean = surface_.neighbours.neighbour(side, i);
            if (holds(clean)) continue;
            for (const Side other : {Side::left, Side::right}) {
                if (!has_surface(surface_, clean, other)) continue;
                const PointIndex beyond = surface_.neighbours.neighbour(other, clean);
                const bool goes_on = (surface_.positions[beyond] - surface_.positions[clean])
                                         .dot(surface_.positions[clean] - surface_.positions[i]) > 0;
                if (goes_on && holds(beyond)) found.push_back(clean);
            }
        }
    }

    void join_near() {
        std::sort(ranges_.begin(), ranges_.end(),
                  [](const PointRange& a, const PointRange& b) { return a.first < b.first; });
        std::vector<PointRange> joined;
        for (const PointRange& range : ranges_) {
            if (!joined.empty() && near(joined.back().last, range.first)) {
                joined.back().last = std::max(joined.back().last, range.last);
            } else {
                joined.push_back(range);
            }
        }
        ranges_ = std::move(joined);
    }

    [[nodiscard]] bool near(PointIndex end, PointIndex begin) const {
        return begin <= end ||
               (pass_of(surface_.passes, end) == pass_of(surface_.passes, begin) &&
                (surface_.positions[begin] - surface_.positions[end]).norm() < joined_arc_length * step_over());
    }

    const ClSurface& surface_;
    std::vector<PointRange> ranges_;  ///< in order, disjoint
};

using PlaceOf = std::function<Vec3(PointIndex)>;

/// Half-way to the adjacent pass on a side. If there is none, extrapolated from the other side; next to a gap of the surface,
/// the pass itself.
Vec3 border(const ClSurface& surface, const PlaceOf& at, PointIndex i, Side side) {
    const Side other = side == Side::left ? Side::right : Side::left;
    if (surface.neighbours.has(side, i))
        return misses_pass(surface, i, side) ? at(i) : 0.5 * (at(i) + at(surface.neighbours.neighbour(side, i)));
    if (has_surface(surface, i, other)) return 1.5 * at(i) - 0.5 * at(surface.neighbours.neighbour(other, i));
    return at(i);
}

/// Adds the pieces of one side where the region does not continue.
void add_side(const Region& region, const ClSurface& surface, const PlaceOf& place_of,
              const std::vector<PointIndex>& samples, Side side, std::vector<std::vector<Vec3>>& lines) {
    std::vector<Vec3> piece;
    const auto finish = [&] {
        if (piece.size() > 1) lines.push_back(std::move(piece));
        piece.clear();
    };
    // A piece begins at the last point before it, so that it meets the end of the other pass there.
    std::optional<Vec3> before;
    for (const PointIndex i : samples) {
        const Vec3 at = border(surface, place_of, i, side);
        const bool inside = has_surface(surface, i, side) && region.holds(surface.neighbours.neighbour(side, i));
        if (!inside && piece.empty() && before) piece.push_back(*before);
        if (!inside || !piece.empty()) piece.push_back(at);
        if (inside) finish();
        before = at;
    }
    finish();
}

}  // namespace

std::vector<std::vector<Vec3>> outlines_of(const Defect& defect, const ClSurface& surface, const PlaceOf& place_of) {
    const PlaceOf at = place_of ? place_of : [&](PointIndex i) { return surface.positions.absolute(i); };
    const Region region(defect.sections, surface);
    std::vector<std::vector<Vec3>> lines;
    for (const PointRange& range : region.ranges()) {
        const std::vector<PointIndex> samples = region.samples(range);
        add_side(region, surface, at, samples, Side::left, lines);
        add_side(region, surface, at, samples, Side::right, lines);
        for (const PointIndex end : {range.first, range.last}) {
            lines.push_back({border(surface, at, end, Side::left), border(surface, at, end, Side::right)});
        }
    }
    return lines;
}

}  // namespace clsurf
