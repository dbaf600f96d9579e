#include "predictor/defect_profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/not_finite.h"
#include "core/statistics.h"
#include "predictor/compared.h"
#include "surface/path_location.h"

namespace clsurf {
namespace {

constexpr double room_of_length = 0.75;  ///< before and after the section, of its length …
constexpr double room_of_step_over = 6;  ///< … and at least so many step-overs
constexpr PointIndex most_places = 4000;
constexpr int most_across = 5;  ///< passes to each side of the strongest place

/// A section, extended by `room` [mm] on both sides within its pass.
PointRange with_room(const PointRange& section, const ClSurface& surface, double room) {
    const auto pass = std::find_if(surface.passes.begin(), surface.passes.end(),
                                   [&](const Pass& p) { return section.first >= p.first && section.first <= p.last; });
    if (pass == surface.passes.end()) return section;
    const auto step = [&](PointIndex i) {
        return static_cast<double>((surface.positions[i + 1] - surface.positions[i]).norm());
    };
    PointRange wide = section;
    for (double gone = 0; wide.first > pass->first && gone < room;) gone += step(--wide.first);
    for (double gone = 0; wide.last < pass->last && gone < room; ++wide.last) gone += step(wide.last);
    return wide;
}

/// Places on the passes on one side of a point, the nearest first.
std::vector<PathLocation> places_on_side(const ClSurface& surface, const Signals& signals, PointIndex i, Side side,
                                         int most) {
    std::vector<PathLocation> places;
    const auto feed = [&](const PathLocation& at) { return signals.feed(at.nearest()); };
    walk_aside(surface, {i, 0}, side, feed, [&](const PathLocation& at, const PathLocation&) {
        places.push_back(at);
        return static_cast<int>(places.size()) < most;
    });
    return places;
}

float median_known(std::vector<float> values) {
    std::erase_if(values, [](float v) { return !(v == v); });
    return values.empty() ? missing<float> : midpoint_median(values);
}

using HeightOf = DefectProfile::HeightOf;

/// Height of a place along a normal [mm]; `there`: compared_at() of it.
float height_at(HeightOf of, const PathLocation& at, const Compared& there, const Eigen::Vector3f& normal,
                const ProgrammedMarks& marks) {
    if (of == HeightOf::relief) return there.relief;
    const Vec3 mark = interpolate([&](PointIndex i) { return marks.at(i); }, at);
    const auto above = static_cast<float>(mark.dot(normal.cast<double>()));
    return of == HeightOf::measured ? there.normal_deviation + above : above;
}

/// The extended sections of the passes that cause the defect. Places on them are no reference.
class Faults {
public:
    Faults(const Defect& defect, const ClSurface& surface, double room) {
        for (const DefectSection& section : defect.sections)
            ranges_.push_back(with_room(section.points, surface, room));
    }
    [[nodiscard]] bool have(PointIndex i) const {
        return std::any_of(ranges_.begin(), ranges_.end(),
                           [&](const PointRange& range) { return range.first <= i && i <= range.last; });
    }

private:
    std::vector<PointRange> ranges_;
};

/// The nearest places on clean passes, up to `most` on each side. If there are none, the nearest places of all passes.
std::vector<PathLocation> comparable_places(const ClSurface& surface, const Signals& signals, PointIndex i, int most,
                                            const Faults& faults) {
    constexpr int farthest = 8;  // passes on each side
    std::vector<PathLocation> clean, nearest;
    for (const Side side : {Side::left, Side::right}) {
        int found = 0, walked = 0;
        for (const PathLocation& at : places_on_side(surface, signals, i, side, farthest)) {
            if (walked++ < most) nearest.push_back(at);
            if (found == most || faults.have(at.nearest())) continue;
            clean.push_back(at);
            ++found;
        }
    }
    return clean.empty() ? nearest : clean;
}

/// The usual height at a point; `height` returns the height of a place.
template <typename Height>
float usual_height_at(const ClSurface& surface, const Signals& signals, PointIndex point, HeightPeers peers,
                      const Faults& faults, const Height& height) {
    constexpr int aside_of_direction = 4;  // in a zigzag, two of them on each side have the same direction
    const bool all = peers == HeightPeers::nearest;
    std::vector<float> heights;
    const int most = all ? DefectProfile::aside : aside_of_direction;
    for (const PathLocation& at : comparable_places(surface, signals, point, most, faults)) {
        if (all || signals.feed(at.nearest()).dot(signals.feed(point)) > 0) heights.push_back(height(at));
    }
    return median_known(std::move(heights));
}

void add_across(DefectProfile& profile, const ClSurface& surface, const Signals& signals, const ProgrammedMarks& marks,
                PointIndex point, HeightPeers peers, const Faults& faults) {
    const Eigen::Vector3f normal = signals.normal(point);
    const auto height = [&](const PathLocation& at) {
        return height_at(profile.height_of, at, compared_at(signals, at, normal), normal, marks);
    };
    std::vector<std::pair<double, float>> places{{0.0, height({point, 0})}};
    for (const Side side : {Side::left, Side::right}) {
        Eigen::Vector3f before = surface.positions[point];
        double gone = 0;
        for (const PathLocation& at : places_on_side(surface, signals, point, side, most_across)) {
            const Eigen::Vector3f here = position_at(surface.positions, at);
            gone += (here - before).norm();
            before = here;
            places.emplace_back(side == Side::left ? -gone : gone, height(at));
        }
    }
    std::sort(places.begin(), places.end());
    for (const auto& [across, high] : places) {
        profile.across.push_back(across);
        profile.across_height.push_back(high);
    }
    profile.usual_across = usual_height_at(surface, signals, point, peers, faults, height);
}

}  // namespace

HeightPeers height_peers_of(const Defect& defect, const QualityReport& report) {
    // A relief belongs to the commanded positions, which have no lag.
    if (defect.systematic || defect.quantity == Quantity::relief) return HeightPeers::nearest;
    const bool alternates =
        std::any_of(report.defects.begin(), report.defects.end(), [](const Defect& other) { return other.systematic; });
    return alternates ? HeightPeers::same_direction : HeightPeers::nearest;
}

DefectProfile profile_of(const Defect& defect, const ClSurface& surface, const Signals& signals, const LineMap& lines,
                         const ProgrammedMarks& marks, HeightPeers peers) {
    DefectProfile profile;
    if (signals.measured && defect.quantity != Quantity::relief)
        profile.height_of = HeightOf::measured;
    else if (!marks.at(defect.point).isZero(0))
        profile.height_of = HeightOf::programmed;
    const DefectSection* const strongest = strongest_section(defect);
    const PointRange section = strongest != nullptr ? strongest->points : PointRange{defect.point, defect.point};
    double length = 0;
    for (PointIndex i = section.first; i < section.last; ++i)
        length += (surface.positions[i + 1] - surface.positions[i]).norm();
    profile.section_length = length;
    const double room = std::max(room_of_length * length, room_of_step_over * surface.step_over);
    const PointRange shown = with_room(section, surface, room);
    const Faults faults(defect, surface, room);
    double from_start = 0;
    for (PointIndex i = shown.first; i < section.first; ++i)
        from_start -= (surface.positions[i + 1] - surface.positions[i]).norm();
    const PointIndex every = std::max<PointIndex>(1, shown.size() / most_places);
    LineNumber line = 0;
    for (PointIndex i = shown.first; i <= shown.last; ++i) {
        if (i > shown.first) from_start += (surface.positions[i] - surface.positions[i - 1]).norm();
        if (const LineNumber now = lines.line_at(i); now != line) {
            line = now;
            if (line != 0) profile.lines.push_back({from_start, line});
        }
        if ((i - shown.first) % every != 0) continue;
        profile.along.push_back(from_start);
        std::array<PathLocation, DefectProfile::passes> places;
        places[DefectProfile::at_fault] = {i, 0};
        for (const Side side : {Side::left, Side::right}) {
            const std::vector<PathLocation> found = places_on_side(surface, signals, i, side, DefectProfile::aside);
            for (std::size_t k = 0; k < found.size(); ++k)
                places[side == Side::left ? DefectProfile::at_fault - 1 - k : DefectProfile::at_fault + 1 + k] =
                    found[k];
        }
        for (std::size_t k = 0; k < places.size(); ++k) {
            float speed = missing<float>;
            float height = missing<float>;
            if (places[k].exists()) {
                const Compared c = compared_at(signals, places[k], signals.normal(i));
                speed = c.speed;
                height = height_at(profile.height_of, places[k], c, signals.normal(i), marks);
            }
            profile.speed[k].push_back(speed);
            profile.height[k].push_back(height);
        }
        std::vector<float> other_speeds;
        for (const PathLocation& at : comparable_places(surface, signals, i, DefectProfile::aside, faults))
            other_speeds.push_back(compared_at(signals, at, signals.normal(i)).speed);
        profile.usual_speed.push_back(median_known(std::move(other_speeds)));
        profile.usual_height.push_back(usual_height_at(surface, signals, i, peers, faults, [&](const PathLocation& at) {
            const Eigen::Vector3f normal = signals.normal(i);
            return height_at(profile.height_of, at, compared_at(signals, at, normal), normal, marks);
        }));
    }
    add_across(profile, surface, signals, marks, defect.point, peers, faults);
    return profile;
}

}  // namespace clsurf
