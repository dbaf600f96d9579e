#include "log/placeholder.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/block.h"
#include "core/geometry.h"

namespace clsurf {
namespace {

constexpr double least_excursion = 10;  ///< [mm]
constexpr double least_of_axis = 1;     ///< [mm] least component along an axis that takes part in a jump
constexpr double times_before = 3;      ///< longer than the previous step: a rapid accelerates and brakes
constexpr double returns_within = 0.5;  ///< share of the jump
constexpr PointIndex longest_stay = 256;
constexpr PointIndex fewest = 3;

struct Excursion {
    std::array<double, 3> to;
    PointIndex record;
    double jump;  ///< [mm]
};

/// Some records of a log, with a few before and after them.
class Section {
public:
    Section(const std::array<ChannelView, 3>& axes, PointIndex first, PointIndex last)
        : begin_(std::max<PointIndex>(0, first - 2)), end_(std::min(axes[0].count, last + longest_stay)) {
        for (std::size_t k = 0; k < 3; ++k) {
            values_[k].resize(static_cast<std::size_t>(end_ - begin_));
            copy_block(axes[k], begin_, values_[k]);
        }
    }
    [[nodiscard]] Vec3 at(PointIndex i) const {
        const auto k = static_cast<std::size_t>(i - begin_);
        return {values_[0][k], values_[1][k], values_[2][k]};
    }

    /// Appends the excursions that begin at records [first, last).
    void find(PointIndex first, PointIndex last, std::vector<Excursion>& found) const {
        for (PointIndex i = std::max<PointIndex>(2, first); i < last; ++i) {
            const Vec3 here = at(i), last_place = at(i - 1);
            const Vec3 step = here - last_place;
            if (!(step.squaredNorm() > least_excursion * least_excursion)) continue;
            const double jump = step.norm();
            if ((step.array().abs() > least_of_axis).count() < 2) continue;
            if (!(jump > times_before * (last_place - at(i - 2)).norm())) continue;
            PointIndex after = i + 1;
            while (after < end_ && at(after) == here) ++after;
            if (after == end_ || !((at(after) - last_place).norm() < returns_within * jump)) continue;
            found.push_back({{here.x(), here.y(), here.z()}, i, jump});
        }
    }

private:
    PointIndex begin_, end_;
    std::array<std::vector<double>, 3> values_;
};

}  // namespace

std::optional<Placeholder> find_placeholder(const std::array<ChannelView, 3>& axes) {
    const PointIndex count = axes[0].count;
    std::vector<std::vector<Excursion>> of_block(static_cast<std::size_t>((count + block_points - 1) / block_points));
    for_each_block(count, [&](PointIndex first, PointIndex last) {
        Section(axes, first, last).find(first, last, of_block[static_cast<std::size_t>(first / block_points)]);
    });
    std::vector<Excursion> all;
    for (const std::vector<Excursion>& block : of_block) all.insert(all.end(), block.begin(), block.end());
    std::stable_sort(all.begin(), all.end(), [](const Excursion& a, const Excursion& b) { return a.to < b.to; });
    Placeholder best;
    for (std::size_t k = 0; k < all.size();) {
        Placeholder here{all[k].to, all[k].record, 0, 0};
        for (; k < all.size() && all[k].to == here.position; ++k) {
            ++here.times;
            here.farthest = std::max(here.farthest, all[k].jump);
        }
        if (here.times > best.times) best = here;
    }
    if (best.times < fewest) return std::nullopt;
    return best;
}

}  // namespace clsurf
