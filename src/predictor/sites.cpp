#include "predictor/sites.h"

#include <algorithm>
#include <cmath>

#include "core/block.h"

namespace clsurf {
namespace {

// Distances of docs/design/predictor.md#3-judge-sites. 50√2 mm/s: 4 ms pass between two sites, within a factor of √2.
constexpr double site_length = 0.2;    ///< [mm] because marks are seen by their length; halved where the tool …
constexpr float slow_from = 70.7107F;  ///< [mm/s] … moves at half of this or less, and so on: 3 to 6 ms between sites
constexpr double site_arc_length = 0.1;  ///< step-overs between sites, at least
constexpr PointIndex farthest = 128;     ///< largest number of points between a point and its site

static_assert(block_points % 64 == 0);  // blocks share no word

}  // namespace

Sites::Sites(const ClSurface& surface, const Signals& signals)
    : surface_(surface),
      signals_(signals),
      most_halvings_(static_cast<int>(
          std::clamp(std::floor(std::log2(site_length / (site_arc_length * surface.step_over))), 0.0, 30.0))) {
    const auto words = static_cast<std::size_t>((signals.size() + 63) / 64);
    words_ = signals.heights ? Column<std::uint64_t>::sparse(words) : Column<std::uint64_t>(words, 0);
    const auto find = [&surface, &signals, halvings = most_halvings_, out = words_.data()](PointIndex first,
                                                                                           PointIndex last) {
        for (PointIndex i = std::max<PointIndex>(first, 1); i < last; ++i) {
            if (signals.without_heights(i).zone != Zone::outside && crossing(surface, signals, halvings, i).crosses)
                out[i / 64] |= std::uint64_t{1} << (i % 64);
        }
    };
    if (signals.heights)
        fill_ = {signals.size(), find, signals.heights->block()};
    else
        for_each_block(signals.size(), find);
}

Sites::Crossing Sites::crossing(PointIndex point) const { return crossing(surface_, signals_, most_halvings_, point); }

Sites::Crossing Sites::crossing(const ClSurface& surface, const Signals& signals, int most_halvings, PointIndex point) {
    const Sample& sample = signals.without_heights(point);
    const float speed = sample.speed;
    if (!(speed > 0)) return {};
    const Eigen::Vector3f feed = vector_of(sample.feed);
    Eigen::Index axis = 0;
    feed.cwiseAbs().maxCoeff(&axis);
    // The distance is halved where the tool is slow, so that the same planes exist and others between them.
    const int halvings = std::clamp(std::ilogb(slow_from / speed), 0, most_halvings);
    const double planes = std::ldexp(1 / site_length, halvings);  // per mm
    const Positions& p = surface.positions;
    const double before = (p.origin[axis] + static_cast<double>(p[point - 1][axis])) * planes,
                 now = (p.origin[axis] + static_cast<double>(p[point][axis])) * planes;
    const double plane = std::floor(std::max(before, now));
    if (!(plane > std::min(before, now)) || plane == before) return {};
    return {true, static_cast<float>((plane - before) / (now - before))};
}

PathLocation Sites::place(PointIndex site) const { return {site - 1, crossing(site).fraction}; }

PointIndex Sites::nearest(PointIndex point) const {
    for (PointIndex k = 0; k < farthest; ++k) {
        if (point + k < signals_.size() && at(point + k)) return point + k;
        if (point >= k && at(point - k)) return point - k;
    }
    return -1;
}

}  // namespace clsurf
