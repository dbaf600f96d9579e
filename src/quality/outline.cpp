#include "quality/outline.h"

#include <algorithm>
#include <limits>

namespace clsurf {
namespace {

constexpr PointIndex most_corners = 64;  ///< along one run

constexpr std::int64_t most_skipped = 2;  ///< passes from one strand to the next: over a clean one
constexpr double beside_step_overs = 2.5;  ///< between strands, per pass

/// A run, walked in the direction of the one before.
struct Strand {
    PointIndex begin = 0, end = 0;
    std::int64_t pass = 0;
};
using Chain = std::vector<Strand>;  ///< strands beside each other, in the order of their passes

class Outliner {
public:
    explicit Outliner(const ClSurface& surface) : surface_(surface) {}

    [[nodiscard]] Vec3 at(PointIndex i) const { return surface_.positions.absolute(i); }

    /// Half way to the pass on a side; by the other side where there is none.
    [[nodiscard]] Vec3 beside(PointIndex i, Side side) const {
        const Side other = side == Side::left ? Side::right : Side::left;
        if (surface_.neighbours.has(side, i)) return 0.5 * (at(surface_.neighbours.neighbour(side, i)) - at(i));
        if (surface_.neighbours.has(other, i)) return 0.5 * (at(i) - at(surface_.neighbours.neighbour(other, i)));
        return Vec3::Zero();
    }

    /// The side of a strand that faces away from a place.
    [[nodiscard]] Side away_from(const Strand& strand, const Vec3& place) const {
        const PointIndex middle = strand.begin + (strand.end - strand.begin) / 2;
        return beside(middle, Side::left).dot(place - at(middle)) < 0 ? Side::left : Side::right;
    }

    void add(const Strand& strand, Side side, bool backwards, std::vector<Vec3>& corners) const {
        const PointIndex length = std::abs(strand.end - strand.begin);
        const PointIndex direction = strand.end >= strand.begin ? 1 : -1;
        const PointIndex pieces = std::clamp<PointIndex>(length, 1, most_corners);
        for (PointIndex k = 0; k <= pieces; ++k) {
            const PointIndex along = length * (backwards ? pieces - k : k) / pieces;
            const PointIndex i = strand.begin + direction * along;
            corners.push_back(at(i) + beside(i, side));
        }
    }

    /// How far a strand's middle lies from another strand [mm].
    [[nodiscard]] double distance(const Strand& strand, const Strand& other) const {
        const Vec3 middle = at(strand.begin + (strand.end - strand.begin) / 2);
        double least = std::numeric_limits<double>::infinity();
        for (PointIndex k = 0; k <= most_corners; ++k) {
            least = std::min(least, (at(other.begin + (other.end - other.begin) * k / most_corners) - middle).norm());
        }
        return least;
    }

    /// Whether two strands run beside each other.
    [[nodiscard]] bool side_by_side(const Strand& a, const Strand& b) const {
        const double most = beside_step_overs * surface_.step_over * static_cast<double>(b.pass - a.pass);
        return std::min(distance(a, b), distance(b, a)) <= most;
    }

    [[nodiscard]] std::vector<Vec3> round(const Chain& chain) const {
        std::vector<Vec3> corners;
        const Strand& first = chain.front();
        const Strand& last = chain.back();
        const bool alone = chain.size() == 1;
        const Side outer = alone ? Side::left : away_from(first, at(chain[1].begin));
        add(first, outer, false, corners);
        for (std::size_t k = 1; k + 1 < chain.size(); ++k) corners.push_back(at(chain[k].end));
        add(last, alone ? Side::right : away_from(last, at(chain[chain.size() - 2].begin)), true, corners);
        for (std::size_t k = chain.size() - 1; k-- > 1;) corners.push_back(at(chain[k].begin));
        corners.push_back(corners.front());
        return corners;
    }

private:
    const ClSurface& surface_;
};

}  // namespace

std::vector<std::vector<Vec3>> outlines_of(const Defect& defect, const ClSurface& surface) {
    const Outliner outliner(surface);
    std::vector<DefectRun> runs = defect.runs;
    std::sort(runs.begin(), runs.end(), [](const DefectRun& a, const DefectRun& b) { return a.pass != b.pass ? a.pass < b.pass : a.points.first < b.points.first; });
    std::vector<Chain> chains;
    for (const DefectRun& run : runs) {
        Strand now{run.points.first, run.points.last, run.pass};
        const auto chain = std::find_if(chains.begin(), chains.end(), [&](const Chain& c) {
            const std::int64_t passes = now.pass - c.back().pass;
            return passes > 0 && passes <= most_skipped && outliner.side_by_side(c.back(), now);
        });
        if (chain == chains.end()) {
            chains.push_back({now});
            continue;
        }
        const Vec3 from = outliner.at(chain->back().begin);
        if ((outliner.at(now.end) - from).norm() < (outliner.at(now.begin) - from).norm()) std::swap(now.begin, now.end);
        chain->push_back(now);
    }
    std::vector<std::vector<Vec3>> outlines;
    for (const Chain& chain : chains) outlines.push_back(outliner.round(chain));
    return outlines;
}

}  // namespace clsurf
