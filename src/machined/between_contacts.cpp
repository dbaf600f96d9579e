#include "machined/between_contacts.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr double farthest = 2.2;  ///< tool radii: largest distance between contact points, along the path or across it

/// Contact points of a point and of its neighbour, seen from above [mm].
struct ContactPair {
    Vec2 own = Vec2::Zero(), adjacent = Vec2::Zero();
    bool known = false;

    [[nodiscard]] double apart() const { return (own - adjacent).norm(); }
};

ContactPair contacts_of(const AsMachinedSurface& as_machined, PointIndex point, Side side) {
    ContactPair pair;
    const Adjacency& neighbours = as_machined.surface().neighbours;
    if (!neighbours.has(side, point)) return pair;
    pair.own = as_machined.contact(point).head<2>();
    pair.adjacent = as_machined.contact(neighbours.neighbour(side, point)).head<2>();
    pair.known =
        pair.own.allFinite() && pair.adjacent.allFinite() && pair.apart() < farthest * as_machined.tool().radius;
    return pair;
}

/// The quadrangle between two pairs, ends included.
template <typename F>
void fill(const ContactPair& from, const ContactPair& to, double step, double spacing, F&& f) {
    const int along = std::max(1, static_cast<int>(std::ceil(step / spacing)));
    const int across = std::max(1, static_cast<int>(std::ceil(std::max(from.apart(), to.apart()) / spacing)));
    for (int a = 0; a <= along; ++a) {
        const double share = static_cast<double>(a) / along;
        const Vec2 own = from.own + share * (to.own - from.own);
        const Vec2 adjacent = from.adjacent + share * (to.adjacent - from.adjacent);
        for (int b = 0; b <= across; ++b) f(Vec2(own + static_cast<double>(b) / across * (adjacent - own)));
    }
}

}  // namespace

void for_each_between_contacts(const AsMachinedSurface& as_machined, const Box2& region, double spacing,
                               const std::function<void(const Vec2& place)>& f) {
    const double reach = as_machined.tool().radius;
    for (const PointRange& range : as_machined.points_near(region, reach)) {
        for (const Side side : {Side::left, Side::right}) {
            ContactPair before;
            for (PointIndex i = range.first; i <= range.last; ++i) {
                const ContactPair now = contacts_of(as_machined, i, side);
                if (now.known && before.known) {
                    const double step =
                        std::max((now.own - before.own).norm(), (now.adjacent - before.adjacent).norm());
                    if (step < spacing && i < range.last) continue;
                    if (step < farthest * reach) fill(before, now, step, spacing, f);
                }
                before = now;
            }
        }
    }
}

}  // namespace clsurf
