#include "quality/place_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/block.h"

namespace clsurf {
namespace {

constexpr double beside_places = 0.6;  ///< step-overs in the plane within which levels are told apart
constexpr double level_ends = 2;       ///< step-overs of height between two levels
constexpr double longest_jump = 0.25;  ///< step-overs: contact points farther apart are not joined …
constexpr double jump_of_tips = 4;     ///< … unless their tips are a quarter as far apart
constexpr double infinite = std::numeric_limits<double>::infinity();

/// The nearest tip of a piece.
struct NearestTip {
    std::size_t piece = 0;
    double distance = infinite;  ///< [mm]
    PointIndex point = -1;

    void improve(double d, PointIndex i) {
        if (d < distance || (d == distance && i < point)) {
            distance = d;
            point = i;
        }
    }
};

class Search {
public:
    Search(const Trajectory& path, const Passes& pieces, const ContactPoints* contacts, double step_over,
           const WantedPlace& wanted)
        : path_(path), pieces_(pieces), contacts_(contacts), step_over_(step_over), wanted_(wanted) {}

    [[nodiscard]] std::vector<FoundPlace> run() const {
        const std::vector<NearestTip> tips = nearest_tips();
        const double reach = contacts_ != nullptr ? contacts_->reach() : 0;
        std::vector<FoundPlace> found;
        // Rising distance of tips: no piece can be nearer than its nearest tip less the tool's reach.
        for (const NearestTip& tip : tips) {
            if (tip.distance - reach > farthest_wanted(found)) break;
            const FoundPlace nearest = nearest_of(tip, reach);
            if (nearest.point < 0) continue;
            const auto after = std::upper_bound(found.begin(), found.end(), nearest, is_nearer);
            found.insert(after, nearest);
        }
        if (wanted_.from_above) keep_topmost(found);
        if (found.size() > wanted_.pieces) found.resize(wanted_.pieces);
        return found;
    }

private:
    static bool is_nearer(const FoundPlace& a, const FoundPlace& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.point < b.point;
    }

    [[nodiscard]] double distance_of(const Vec3& place) const {
        const Vec3 off = place - wanted_.at;
        return wanted_.from_above ? off.head<2>().norm() : off.norm();
    }

    [[nodiscard]] bool is_asked(const Pass& piece) const {
        if (contacts_ != nullptr) return contacts_->cuts(piece);
        return !wanted_.from_above || piece.kind == PassKind::cut;
    }

    /// Beyond this distance [mm] a piece is not needed.
    [[nodiscard]] double farthest_wanted(const std::vector<FoundPlace>& found) const {
        const auto last_of = [&](const std::vector<FoundPlace>& kept) {
            return kept.size() >= wanted_.pieces ? kept[wanted_.pieces - 1].distance : infinite;
        };
        if (!wanted_.from_above || found.empty()) return last_of(found);
        std::vector<FoundPlace> topmost = found;
        keep_topmost(topmost);
        const double last = last_of(topmost);
        return std::max(last, std::max(found.front().distance, beside_places * step_over_));
    }

    /// Of every piece that is asked, nearest first.
    [[nodiscard]] std::vector<NearestTip> nearest_tips() const {
        const auto blocks = static_cast<std::size_t>((path_.count + block_points - 1) / block_points);
        std::vector<std::vector<NearestTip>> of_block(blocks);
        for_each_block(path_.count, [&](PointIndex first, PointIndex last) {
            of_block[static_cast<std::size_t>(first / block_points)] = nearest_tips_between(first, last);
        });
        std::vector<NearestTip> all;
        for (const std::vector<NearestTip>& block : of_block) {
            for (const NearestTip& tip : block) {
                // A piece may go on from the block before.
                if (all.empty() || all.back().piece != tip.piece)
                    all.push_back(tip);
                else
                    all.back().improve(tip.distance, tip.point);
            }
        }
        std::erase_if(all, [](const NearestTip& tip) { return tip.point < 0; });
        std::sort(all.begin(), all.end(), [](const NearestTip& a, const NearestTip& b) {
            return a.distance != b.distance ? a.distance < b.distance : a.point < b.point;
        });
        return all;
    }

    [[nodiscard]] std::vector<NearestTip> nearest_tips_between(PointIndex first, PointIndex end) const {
        std::vector<NearestTip> tips;
        std::vector<double> axes[3];
        auto piece = std::upper_bound(pieces_.begin(), pieces_.end(), first,
                                      [](PointIndex i, const Pass& pass) { return i < pass.first; });
        if (piece != pieces_.begin()) --piece;
        for (; piece != pieces_.end() && piece->first < end; ++piece) {
            const PointIndex from = std::max(first, piece->first);
            const PointIndex to = std::min(end - 1, piece->last);
            if (from > to || !is_asked(*piece)) continue;
            NearestTip tip;
            tip.piece = static_cast<std::size_t>(piece - pieces_.begin());
            read(from, to, axes);
            for (std::size_t k = 0; k < axes[0].size(); ++k)
                tip.improve(distance_of({axes[0][k], axes[1][k], axes[2][k]}), from + static_cast<PointIndex>(k));
            tips.push_back(tip);
        }
        return tips;
    }

    void read(PointIndex from, PointIndex to, std::vector<double> (&axes)[3]) const {
        for (std::vector<double>& axis : axes) axis.resize(static_cast<std::size_t>(to - from + 1));
        path_.read(from, axes[0], axes[1], axes[2]);
    }

    [[nodiscard]] FoundPlace place_of(PointIndex point, const std::optional<Vec3>& contact) const {
        FoundPlace found{point, 0, {path_.at(point), contact}};
        found.distance = distance_of(found.place.position());
        return found;
    }

    /// The nearest place of a piece; point −1: it has none.
    [[nodiscard]] FoundPlace nearest_of(const NearestTip& tip, double reach) const {
        if (contacts_ == nullptr) return place_of(tip.point, std::nullopt);
        FoundPlace best;
        best.point = -1;
        double least = infinite;  // to the line through the contact points
        const auto look = [&](PointIndex point, const std::optional<Vec3>& contact, double distance) {
            if (!contact || !(distance < least)) return;
            least = distance;
            best = place_of(point, contact);
        };
        if (const std::optional<Vec3> contact = contacts_->at(tip.point))
            look(tip.point, contact, distance_of(*contact));
        const Pass& piece = pieces_[tip.piece];
        std::vector<double> axes[3];
        std::optional<Vec3> before;
        for (PointIndex begin = piece.first; begin <= piece.last; begin += block_points) {
            const PointIndex last = std::min(piece.last, begin + block_points - 1);
            read(begin, last, axes);
            for (PointIndex i = begin; i <= last; ++i) {
                const auto k = static_cast<std::size_t>(i - begin);
                const bool near = distance_of({axes[0][k], axes[1][k], axes[2][k]}) - reach <= least;
                const std::optional<Vec3> now = near ? contacts_->at(i) : std::nullopt;
                if (now) {
                    look(i, now, distance_of(*now));
                    if (before) look_between(i - 1, *before, i, *now, look);
                }
                before = now;
            }
        }
        return best;
    }

    /// A place between two contact points belongs to the nearer one of them.
    template <typename Look>
    void look_between(PointIndex a, const Vec3& from, PointIndex b, const Vec3& to, Look&& look) const {
        Vec3 step = to - from;
        Vec3 off = wanted_.at - from;
        if (wanted_.from_above) step.z() = off.z() = 0;
        const double squared = step.squaredNorm();
        const double jump = std::sqrt(squared);
        if (!(squared > 0)) return;
        if (jump > longest_jump * step_over_ && jump > jump_of_tips * (path_.at(b) - path_.at(a)).norm()) return;
        const double share = off.dot(step) / squared;
        if (!(share > 0 && share < 1)) return;
        const bool first_is_nearer = share < 0.5;
        look(first_is_nearer ? a : b, first_is_nearer ? from : to, (off - share * step).norm());
    }

    /// Leaves the topmost level of what lies under the place, then the others by distance.
    void keep_topmost(std::vector<FoundPlace>& found) const {
        if (found.empty()) return;
        const double near = std::max(found.front().distance, beside_places * step_over_);
        double lowest = -infinite;
        for (const FoundPlace& f : found) {
            if (f.distance <= near) lowest = std::max(lowest, f.place.position().z());
        }
        std::vector<double> heights;
        for (const FoundPlace& f : found) {
            if (f.place.position().z() <= lowest) heights.push_back(f.place.position().z());
        }
        std::sort(heights.begin(), heights.end(), std::greater<>());
        for (const double z : heights) {
            if (lowest - z > level_ends * step_over_) break;
            lowest = z;
        }
        std::erase_if(found, [&](const FoundPlace& f) { return f.place.position().z() < lowest; });
    }

    const Trajectory& path_;
    const Passes& pieces_;
    const ContactPoints* contacts_;
    double step_over_;
    const WantedPlace& wanted_;
};

}  // namespace

std::vector<FoundPlace> find_places(const Trajectory& path, const Passes& pieces, const ContactPoints* contacts,
                                    double step_over, const WantedPlace& wanted) {
    return Search(path, pieces, contacts, step_over, wanted).run();
}

}  // namespace clsurf
