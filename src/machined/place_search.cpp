#include "machined/place_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/block.h"
#include "core/point_ranges.h"
#include "machined/contact.h"
#include "machined/cutter_touch.h"

namespace clsurf {
namespace {

constexpr double column_width = 0.6;   ///< step-overs in the plane: places this close belong to one column of levels
constexpr double level_ends = 2;       ///< step-overs of height between two levels
constexpr double longest_jump = 0.25;  ///< step-overs: contact points farther apart are not joined …
constexpr double jump_of_tips = 4;     ///< … unless their tips are a quarter as far apart
constexpr double near_the_part = 0.5;  ///< step-overs: a place this near to the cut surface is on the part
constexpr double own_contact = 0.6;    ///< step-overs: a contact farther away does not touch the place
/// Weight of the distance to a contact point relative to the distance to the cutter. Under a flat bottom all passes touch the
/// place, and the nearest contact point decides.
constexpr double by_contact = 0.003;
constexpr double most_by_contact = 1.5;  ///< step-overs: upper limit of the distance that counts
constexpr double infinite = std::numeric_limits<double>::infinity();

/// The point of a piece with the least value.
struct LeastPoint {
    double value = infinite;
    PointIndex point = -1;

    void improve(double v, PointIndex i) {
        if (v < value || (v == value && i < point)) {
            value = v;
            point = i;
        }
    }
};

/// The nearest points of a piece; motions between points are ignored.
struct NearestTip {
    std::size_t piece = 0;
    LeastPoint tip;     ///< [mm] to the place
    LeastPoint cutter;  ///< [mm] from the cutter; from above: its height
};

class Search {
public:
    Search(const Trajectory& path, const Passes& pieces, const ContactPoints* contacts, double step_over,
           const WantedPlace& wanted)
        : path_(path), pieces_(pieces), contacts_(contacts), step_over_(step_over), wanted_(wanted) {
        if (contacts != nullptr) body_.emplace(path, contacts->axes(), contacts->tool());
    }

    [[nodiscard]] std::vector<FoundPlace> run() const {
        if (wanted_.from_above && body_ && !contacts_->axes() && path_.ball == 0) return run_from_above();
        const std::vector<NearestTip> tips = nearest_tips();
        const double reach = contacts_ != nullptr ? contacts_->reach() : 0;
        std::vector<FoundPlace> found;
        // By increasing distance of tips: no piece can be nearer than its nearest tip minus the tool's reach.
        for (const NearestTip& tip : tips) {
            if (tip.tip.value - reach > farthest_needed(found)) break;
            const FoundPlace nearest = nearest_of(tip, reach);
            if (nearest.point < 0) continue;
            const auto after = std::upper_bound(found.begin(), found.end(), nearest, is_nearer);
            found.insert(after, nearest);
        }
        if (body_ && !wanted_.from_above) put_touching_first(tips, found);
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

    [[nodiscard]] bool is_searched(const Pass& piece) const {
        if (contacts_ != nullptr) return contacts_->cuts(piece);
        return !wanted_.from_above || piece.kind == PassKind::cut;
    }

    /// Distance [mm] beyond which pieces are not needed.
    [[nodiscard]] double farthest_needed(const std::vector<FoundPlace>& found) const {
        const auto last_of = [&](const std::vector<FoundPlace>& kept) {
            return kept.size() >= wanted_.pieces ? kept[wanted_.pieces - 1].distance : infinite;
        };
        if (!wanted_.from_above || found.empty()) return last_of(found);
        std::vector<FoundPlace> topmost = found;
        keep_topmost(topmost);
        const double last = last_of(topmost);
        return std::max(last, std::max(found.front().distance, column_width * step_over_));
    }

    /// The place is at the height that the upright cutters leave at x, y.
    [[nodiscard]] std::vector<FoundPlace> run_from_above() const {
        double z = infinite;
        for (const NearestTip& tip : nearest_tips()) {
            if (tip.cutter.point >= 0) z = std::min(z, body_->lowest(tip.cutter.point, range_of(tip), wanted_.at));
        }
        if (z == infinite) return {};
        WantedPlace below = wanted_;
        below.at.z() = z;
        below.from_above = false;
        std::vector<FoundPlace> found = Search(path_, pieces_, contacts_, step_over_, below).run();
        for (FoundPlace& f : found) f.distance = distance_of(f.place.position());
        return found;
    }

    [[nodiscard]] PointRange range_of(const NearestTip& tip) const {
        return {pieces_[tip.piece].first, pieces_[tip.piece].last};
    }

    [[nodiscard]] PointIndex first_point_of_piece(PointIndex point) const { return range_at(pieces_, point)->first; }

    /// The longer of the two steps next to the point whose cutter is nearest [mm].
    [[nodiscard]] double most_between_points(const NearestTip& tip) const {
        const PointRange range = range_of(tip);
        const Vec3 here = path_.at(tip.cutter.point);
        double most = 0;
        for (const PointIndex beside : {tip.cutter.point - 1, tip.cutter.point + 1}) {
            if (beside >= range.first && beside <= range.last) most = std::max(most, (path_.at(beside) - here).norm());
        }
        return most;
    }

    /// A piece whose cutter touches the place, or nearly does.
    struct Touching {
        FoundPlace place;
        double score = infinite;
    };

    /// The better of two points: that with the nearest cutter, and that with the nearest contact if it is known.
    [[nodiscard]] Touching touching(const CutterTouch& touch, PointRange piece, const FoundPlace* by_contacts) const {
        Touching best;
        const auto look = [&](const CutterTouch& here, const FoundPlace& place) {
            const double score = here.distance + by_contact * std::min(place.distance, most_by_contact * step_over_);
            if (score >= best.score) return;
            best = {place, score};
            // In a groove the cutter touches more than one place, and no fitted normal selects one.
            if (place.distance > own_contact * step_over_) best.place = place_of(here.point, here.projection);
        };
        FoundPlace mine = place_of(touch.point, contacts_->at(touch.point));
        if (!mine.place.contact) mine.distance = infinite;
        look(touch, mine);
        if (by_contacts != nullptr && by_contacts->point != touch.point)
            look(body_->touch(by_contacts->point, piece, wanted_.at), *by_contacts);
        return best;
    }

    /// The part is the surface that the cutters leave, so a place on it belongs to the piece whose cutter is lowest there.
    /// `found`: the nearest by contact points, which also cover places off the part.
    void put_touching_first(std::vector<NearestTip> tips, std::vector<FoundPlace>& found) const {
        const double spare = by_contact * most_by_contact * step_over_;
        std::sort(tips.begin(), tips.end(),
                  [](const NearestTip& a, const NearestTip& b) { return a.cutter.value < b.cutter.value; });
        double least = infinite;
        std::vector<std::pair<CutterTouch, PointRange>> touches;
        for (const NearestTip& tip : tips) {
            if (tip.cutter.value - most_between_points(tip) > least + spare) continue;
            touches.emplace_back(body_->touch(tip.cutter.point, range_of(tip), wanted_.at), range_of(tip));
            least = std::min(least, touches.back().first.distance);
        }
        if (!(std::abs(least) <= near_the_part * step_over_)) return;
        // If the place is nearer to a contact point than to the part, that contact is meant, although it was cut away.
        if (!found.empty() && found.front().distance <= std::abs(least)) return;
        std::map<PointIndex, FoundPlace> known;  // by the first point of their pieces
        for (const FoundPlace& f : found) known.emplace(first_point_of_piece(f.point), f);
        std::vector<Touching> first;
        for (const auto& [touch, piece] : touches) {
            if (touch.distance > least + spare) continue;
            const auto at = known.find(piece.first);
            first.push_back(touching(touch, piece, at == known.end() ? nullptr : &at->second));
            if (at != known.end()) known.erase(at);
        }
        std::stable_sort(first.begin(), first.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
        std::erase_if(found, [&](const FoundPlace& f) { return !known.contains(first_point_of_piece(f.point)); });
        std::vector<FoundPlace> all;
        for (const Touching& one : first) all.push_back(one.place);
        all.insert(all.end(), found.begin(), found.end());
        found = std::move(all);
    }

    /// The nearest tips of all pieces in question, nearest first.
    [[nodiscard]] std::vector<NearestTip> nearest_tips() const {
        const auto blocks = static_cast<std::size_t>((path_.count + block_points - 1) / block_points);
        std::vector<std::vector<NearestTip>> of_block(blocks);
        for_each_block(path_.count, [&](PointIndex first, PointIndex last) {
            of_block[static_cast<std::size_t>(first / block_points)] = nearest_tips_between(first, last);
        });
        std::vector<NearestTip> all;
        for (const std::vector<NearestTip>& block : of_block) {
            for (const NearestTip& tip : block) {
                // A piece may continue from the block before.
                if (all.empty() || all.back().piece != tip.piece)
                    all.push_back(tip);
                else {
                    all.back().tip.improve(tip.tip.value, tip.tip.point);
                    all.back().cutter.improve(tip.cutter.value, tip.cutter.point);
                }
            }
        }
        std::erase_if(all, [](const NearestTip& tip) { return tip.tip.point < 0; });
        std::sort(all.begin(), all.end(), [](const NearestTip& a, const NearestTip& b) {
            return a.tip.value != b.tip.value ? a.tip.value < b.tip.value : a.tip.point < b.tip.point;
        });
        return all;
    }

    [[nodiscard]] std::vector<NearestTip> nearest_tips_between(PointIndex first, PointIndex end) const {
        std::vector<NearestTip> tips;
        std::vector<double> axes[3], turned[3];
        for (auto piece = range_at(pieces_, first); piece != pieces_.end() && piece->first < end; ++piece) {
            const PointIndex from = std::max(first, piece->first);
            const PointIndex to = std::min(end - 1, piece->last);
            if (from > to || !is_searched(*piece)) continue;
            NearestTip tip;
            tip.piece = static_cast<std::size_t>(piece - pieces_.begin());
            read(path_, from, to, axes);
            const bool leans = contacts_ != nullptr && contacts_->axes();
            if (leans) read(*contacts_->axes(), from, to, turned);
            for (std::size_t k = 0; k < axes[0].size(); ++k) {
                const Vec3 at(axes[0][k], axes[1][k], axes[2][k]);
                const PointIndex point = from + static_cast<PointIndex>(k);
                tip.tip.improve(distance_of(at), point);
                if (!body_) continue;
                const Vec3 axis = leans ? Vec3(turned[0][k], turned[1][k], turned[2][k]) : Vec3::UnitZ();
                tip.cutter.improve(cutter_at(at, axis), point);
            }
            tips.push_back(tip);
        }
        return tips;
    }

    /// Distance to the cutter, or its height if the place is searched from above.
    [[nodiscard]] double cutter_at(const Vec3& tip, const Vec3& axis) const {
        const Vec3 off = wanted_.at - tip;
        if (!wanted_.from_above) return body_->distance(off, axis);
        return tip.z() + outline_height(contacts_->tool(), off.head<2>().norm());
    }

    template <typename Columns>
    static void read(const Columns& path, PointIndex from, PointIndex to, std::vector<double> (&axes)[3]) {
        for (std::vector<double>& axis : axes) axis.resize(static_cast<std::size_t>(to - from + 1));
        path.read(from, axes[0], axes[1], axes[2]);
    }

    [[nodiscard]] FoundPlace place_of(PointIndex point, const std::optional<Vec3>& contact) const {
        FoundPlace found{point, 0, {path_.at(point), contact}};
        found.distance = distance_of(found.place.position());
        return found;
    }

    /// The nearest place of a piece; point −1: it has none.
    [[nodiscard]] FoundPlace nearest_of(const NearestTip& tip, double reach) const {
        if (contacts_ == nullptr) return place_of(tip.tip.point, std::nullopt);
        FoundPlace best;
        best.point = -1;
        double least = infinite;  // to the line through the contact points
        const auto look = [&](PointIndex point, const std::optional<Vec3>& contact, double distance) {
            if (!contact || !(distance < least)) return;
            least = distance;
            best = place_of(point, contact);
        };
        if (const std::optional<Vec3> contact = contacts_->at(tip.tip.point))
            look(tip.tip.point, contact, distance_of(*contact));
        const Pass& piece = pieces_[tip.piece];
        std::vector<double> axes[3];
        std::optional<Vec3> before;
        for (PointIndex begin = piece.first; begin <= piece.last; begin += block_points) {
            const PointIndex last = std::min(piece.last, begin + block_points - 1);
            read(path_, begin, last, axes);
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

    /// A place between two contact points belongs to the nearer one.
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

    /// Keeps the topmost level under the place, then the others by distance.
    void keep_topmost(std::vector<FoundPlace>& found) const {
        if (found.empty()) return;
        const double near = std::max(found.front().distance, column_width * step_over_);
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
    std::optional<CutterBody> body_;
};

}  // namespace

std::vector<FoundPlace> find_places(const Trajectory& path, const Passes& pieces, const ContactPoints* contacts,
                                    double step_over, const WantedPlace& wanted) {
    return Search(path, pieces, contacts, step_over, wanted).run();
}

}  // namespace clsurf
