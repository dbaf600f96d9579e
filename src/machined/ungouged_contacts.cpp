#include "machined/ungouged_contacts.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/grouping.h"
#include "core/parallel.h"
#include "machined/contact.h"

namespace clsurf {
namespace {

constexpr double tips_aside = 12;  ///< squares from a contact point to the tool's radius, each with one tested tip
// As in docs/formed.md#definitions, Form of the contacts.
constexpr double cut_away = 0.02;  ///< [mm] depth inside the tool elsewhere from which on a contact point is cut away
constexpr double distance_rounding = 1e-9;  ///< [mm] error of distances

/// A grid of squares, with the lowest tip and the contact points in each.
class SquareGrid {
public:
    /// For contact points no farther than `radius` from their tips; squares of at least `least` mm.
    SquareGrid(const std::vector<ContactPoint>& found, const Box2& region, double radius, double least)
        : square_(std::max(least, radius / tips_aside)), radius_(radius) {
        Box2 all = region;
        for (const ContactPoint& contact : found) all.extend(Vec2(contact.tip.head<2>()));
        corner_ = all.min();
        columns_ = column_of(all.max().x()) + 1;
        rows_ = row_of(all.max().y()) + 1;
        const auto squares = static_cast<std::size_t>(columns_ * rows_);
        lowest_.assign(squares, Vec3(0, 0, std::numeric_limits<double>::infinity()));
        for (const ContactPoint& contact : found) {
            Vec3& lowest = lowest_[square_of(contact.tip)];
            if (contact.tip.z() < lowest.z()) lowest = contact.tip;
        }
        // Contact points outside the region are in a group after the last square.
        places_ = group_numbers(found.size(), squares + 1, [&](std::size_t k) {
            return region.contains(found[k].at.head<2>()) ? square_of(found[k].at) : squares;
        });
    }

    [[nodiscard]] std::int64_t squares() const { return columns_ * rows_; }
    /// Numbers of the contact points in a square, inside the region.
    [[nodiscard]] std::span<const std::uint32_t> places(std::int64_t square) const {
        return places_.of(static_cast<std::size_t>(square));
    }

    /// Calls f(tip) for the lowest tips of the squares within the tool's radius of a box.
    template <typename F>
    void for_each_tip_near(const Box2& box, F&& f) const {
        const std::int64_t last_row = std::min(rows_ - 1, row_of(box.max().y() + radius_));
        const std::int64_t last_column = std::min(columns_ - 1, column_of(box.max().x() + radius_));
        for (std::int64_t r = std::max<std::int64_t>(0, row_of(box.min().y() - radius_)); r <= last_row; ++r) {
            for (std::int64_t c = std::max<std::int64_t>(0, column_of(box.min().x() - radius_)); c <= last_column;
                 ++c) {
                f(lowest_[static_cast<std::size_t>(r * columns_ + c)]);
            }
        }
    }

private:
    [[nodiscard]] std::int64_t column_of(double x) const {
        return static_cast<std::int64_t>((x - corner_.x()) / square_);
    }
    [[nodiscard]] std::int64_t row_of(double y) const { return static_cast<std::int64_t>((y - corner_.y()) / square_); }
    [[nodiscard]] std::size_t square_of(const Vec3& at) const {
        return static_cast<std::size_t>(row_of(at.y()) * columns_ + column_of(at.x()));
    }

    double square_, radius_;
    Vec2 corner_ = Vec2::Zero();
    std::int64_t columns_ = 0, rows_ = 0;
    std::vector<Vec3> lowest_;  ///< of each square; z infinite: no tip
    Grouping places_;           ///< by square
};

/// Extent of some places that are near each other.
struct Extent {
    Box2 box;
    double highest = -std::numeric_limits<double>::infinity();
};

}  // namespace

std::vector<Vec3> ungouged_contacts(const AsMachinedSurface& as_machined, const Box2& region, double spacing) {
    const CuttingTool& tool = as_machined.tool();
    // A contact point is within a radius of its tip, and can be cut away by tips within a radius of it.
    const Vec2 room = Vec2::Constant(2 * tool.radius);
    const std::vector<ContactPoint> found =
        as_machined.contacts(Box2(region.min() - room, region.max() + room), spacing);
    const SquareGrid grid(found, region, tool.radius, 2 * spacing);
    std::vector<std::uint8_t> keep(found.size());
    // A size of portions for threads; results do not depend on it.
    constexpr std::int64_t grain = 64;
    parallel_for(grid.squares(), grain, [&](std::int64_t first, std::int64_t last) {
        std::vector<Vec3> tips;
        for (std::int64_t s = first; s < last; ++s) {
            const std::span<const std::uint32_t> places = grid.places(s);
            if (places.empty()) continue;
            Extent extent;
            for (const std::uint32_t k : places) {
                extent.box.extend(Vec2(found[k].at.head<2>()));
                extent.highest = std::max(extent.highest, found[k].at.z());
            }
            // Tips that cannot reach the highest place at the shortest distance reach none of them.
            tips.clear();
            grid.for_each_tip_near(extent.box, [&](const Vec3& tip) {
                const double room_above = extent.highest - tip.z() - cut_away;
                if (room_above > 0 &&
                    outline_height(tool, std::max(0.0, extent.box.exteriorDistance(Vec2(tip.head<2>())) -
                                                           distance_rounding)) < room_above)
                    tips.push_back(tip);
            });
            for (const std::uint32_t k : places) {
                const Vec3& at = found[k].at;
                keep[k] = std::none_of(tips.begin(), tips.end(),
                                       [&](const Vec3& tip) { return depth_inside(tool, at - tip) > cut_away; })
                              ? 1
                              : 0;
            }
        }
    });
    std::vector<Vec3> standing;
    for (std::size_t k = 0; k < found.size(); ++k) {
        if (keep[k] != 0) standing.push_back(found[k].at);
    }
    return standing;
}

}  // namespace clsurf
