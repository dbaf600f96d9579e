#include "compare/run_alignment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "compare/knot_path.h"
#include "surface/path_grid.h"

namespace clsurf {
namespace {

// Lengths in mm.
constexpr float off_distance = 0.1F;       ///< from this distance on, the walk may be on the wrong path
constexpr float lost_distance = 0.5F;      ///< from this distance on, it certainly is
constexpr float lost_length = 1.0F;        ///< arc length off the path after which the walk is lost
constexpr float near_distance = 0.1F;      ///< a walk must begin within this distance, and keep it …
constexpr float trial_arc_length = 5.0F;   ///< … over this arc length
constexpr float same_fit = 0.002F;         ///< smaller differences of mean distances do not count
constexpr double cell = 0.25;              ///< side of the cells in the grid that finds beginnings
constexpr float search_arc_length = 0.1F;  ///< arc length between two searches at first; doubled after each failure …
constexpr float longest_search_arc_length = 5.0F;  ///< … up to this
constexpr float one_place = 1.0F;                  ///< points of B with less arc length between them are one place
constexpr std::size_t most_places = 32;            ///< number of places at which a walk may be tried
constexpr std::int64_t work_per_point = 8;         ///< limit for repeated walks

/// A tentative walk.
struct Trial {
    PathProjection begin, projected;
    float arc_length = 0;  ///< arc length near the path
    double cost = 0;       ///< distance times arc length; `near_distance` times arc length if it is off
    bool alive = true;
};

/// The distance from the previous point; 0 if there is none. Sets `before` to `p`.
float chord_to(const Eigen::Vector3f& p, Eigen::Vector3f& before) {
    const float distance = (p - before).norm();
    before = p;
    return std::isnan(distance) ? 0.0F : distance;
}

class Aligner {
public:
    Aligner(const Positions& a, const Positions& b)
        : a_(a),
          b_(b),
          shift_((b.origin - a.origin).cast<float>()),
          path_(b, shift_),
          trial_steps_(work_per_point * (a.size() + 1000)),
          rewinds_(work_per_point * a.size()) {}

    RunAlignment run() {
        RunAlignment result;
        result.locations.resize(static_cast<std::size_t>(a_.size()));
        std::fill(result.locations.begin(), result.locations.end(), PathLocation{});
        if (path_.size() < 2) return result;
        walk(result.locations);
        measure(result);
        return result;
    }

private:
    void walk(Column<PathLocation>& locations) {
        PointIndex off_since = -1;  // first point at which the walk is off the path
        float off_path = 0;         // arc length since then
        float retry_after = lost_length;
        float to_search = 0;  // arc length until the next search for a beginning
        float search_step = search_arc_length;
        PathLocation last{};
        PointIndex last_point = -1;  // last point of A on the path; −1: there is no walk
        Eigen::Vector3f before = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
        for (PointIndex i = 0; i < a_.size(); ++i) {
            const Eigen::Vector3f p = a_[i];
            if (!p.allFinite()) continue;
            const float chord = chord_to(p, before);
            if (last_point < 0) {
                to_search -= chord;
                if (to_search > 0) continue;
                if (!begin(i)) {
                    to_search = search_step;
                    search_step = std::min(2 * search_step, longest_search_arc_length);
                    continue;
                }
                search_step = search_arc_length;
                begins_.push_back(i);
                last = path_.location(projected_, p, path_.point(projected_.knot));
            } else {
                projected_ = path_.advance(projected_, p, chord);
                last = path_.location(projected_, p, last.point + (i - last_point));
            }
            last_point = i;
            locations[static_cast<std::size_t>(i)] = last;
            if (projected_.distance < off_distance) {
                off_since = -1;
                continue;
            }
            if (off_since < 0) {
                off_since = i;
                off_path = 0;
                retry_after = lost_length;
            }
            off_path += chord;
            if (off_path < retry_after) continue;
            const PathProjection projected = projected_;
            if (projected.distance < lost_distance && !begin(i)) {
                projected_ = projected;
                retry_after = 2 * off_path + lost_length;
                continue;
            }
            projected_ = projected;
            last_point = -1;
            to_search = 0;
            if (leave(off_since, i, locations)) {
                i = off_since - 1;
                before.setConstant(std::numeric_limits<float>::quiet_NaN());
            }
            off_since = -1;
        }
    }

    /// Discards the walk from A's point `since` to `now`. Returns true if another beginning is to be searched from `since` on.
    bool leave(PointIndex since, PointIndex now, Column<PathLocation>& locations) {
        std::fill(locations.begin() + since, locations.begin() + now + 1, PathLocation{});
        while (!begins_.empty() && begins_.back() >= since) begins_.pop_back();
        if (rewinds_ < now - since) return false;
        rewinds_ -= now - since;
        return true;
    }

    /// Places of B where a walk at A's point `i` could begin, those after the last projection first.
    [[nodiscard]] std::vector<Trial> places(PointIndex i) {
        if (!grid_) {
            arc_length_ = std::make_unique<ArcLength>(b_);
            Passes all;
            all.push_back({0, b_.size() - 1, PassKind::cut});
            grid_ = std::make_unique<PathGrid>(b_, all, *arc_length_, cell);
        }
        const Eigen::Vector3f p = a_[i];
        std::vector<PointIndex> near;
        grid_->for_each_near(p - shift_, [&](const PathGrid::Entry& entry) { near.push_back(entry.point); });
        std::sort(near.begin(), near.end());
        std::vector<Trial> trials;
        for (std::size_t first = 0; first < near.size();) {
            std::size_t last = first;
            while (last + 1 < near.size() && !arc_length_->at_least(near[last], near[last + 1], one_place)) ++last;
            const PathProjection projected = nearest(p, near[first], near[last]);
            if (projected.distance <= near_distance) trials.push_back({projected, projected});
            first = last + 1;
        }
        const auto after =
            std::find_if(trials.begin(), trials.end(), [&](const Trial& t) { return t.begin.knot >= projected_.knot; });
        std::rotate(trials.begin(), after, trials.end());
        if (trials.size() > most_places) trials.resize(most_places);
        return trials;
    }

    /// The nearest projection between two points of B, extended by a cell on both sides.
    [[nodiscard]] PathProjection nearest(const Eigen::Vector3f& p, PointIndex first, PointIndex last) const {
        PathProjection best{0, 0, std::numeric_limits<float>::infinity()};
        std::int64_t knot = path_.knot_at(first);
        for (float gone = 0; knot > 0 && gone < cell; --knot) gone += travel_between(knot - 1);
        const std::int64_t end = path_.knot_at(last);
        float beyond = 0;
        for (; knot + 1 < path_.size() && (knot <= end || beyond < cell); ++knot) {
            if (knot > end) beyond += travel_between(knot);
            const PathProjection projection = path_.projection(knot, p, 0.0F);
            if (projection.distance < best.distance) best = projection;
        }
        return best;
    }
    [[nodiscard]] float travel_between(std::int64_t knot) const {
        return (b_[path_.point(knot + 1)] - b_[path_.point(knot)]).norm();
    }

    /// Starts the walk at the place that fits best from A's point `i` on. Returns false if there is none.
    bool begin(PointIndex i) {
        std::vector<Trial> trials = places(i);
        if (trials.empty()) return false;
        Eigen::Vector3f before = a_[i];
        float arc_length = 0;
        std::size_t alive = trials.size();
        PointIndex k = i + 1;
        for (; k < a_.size() && alive > 0; ++k) {
            if (arc_length >= trial_arc_length && (alive == 1 || trial_steps_ <= 0)) break;
            const Eigen::Vector3f p = a_[k];
            if (!p.allFinite()) continue;
            const float chord = (p - before).norm();
            if (!(chord > 0)) continue;
            before = p;
            arc_length += chord;
            trial_steps_ -= static_cast<std::int64_t>(alive);
            for (Trial& trial : trials) {
                if (!trial.alive) {
                    trial.cost += near_distance * chord;
                    continue;
                }
                trial.projected = path_.advance(trial.projected, p, chord);
                trial.cost += std::min(trial.projected.distance, near_distance) * chord;
                trial.arc_length += chord;
                if (trial.projected.distance <= near_distance) continue;
                trial.alive = false;
                --alive;
            }
        }
        // A trial that is still near when all others are off is right, however well the others fitted before.
        const bool to_the_end = k == a_.size();
        const Trial* best = nullptr;
        for (const Trial& trial : trials) {
            const bool proven =
                trial.arc_length >= trial_arc_length || (to_the_end && trial.alive && trial.arc_length > 0);
            if (!proven || (alive > 0 && !trial.alive)) continue;
            if (best == nullptr || trial.cost + same_fit * arc_length < best->cost) best = &trial;
        }
        if (best == nullptr) return false;
        projected_ = best->begin;
        return true;
    }

    void measure(RunAlignment& result) const {
        Eigen::Vector3f before = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
        auto begin = begins_.begin();
        for (PointIndex i = 0; i < a_.size(); ++i) {
            const Eigen::Vector3f p = a_[i];
            if (!p.allFinite()) continue;
            const float chord = chord_to(p, before);
            result.arc_length += chord;
            const bool begins = begin != begins_.end() && *begin == i;
            if (begins) ++begin;
            if (!result.locations[static_cast<std::size_t>(i)].exists()) continue;
            std::vector<PointRange>& sections = result.sections;
            if (begins || sections.empty()) {
                sections.push_back({i, i});
                continue;
            }
            sections.back().last = i;
            result.aligned += chord;
        }
    }

    const Positions& a_;
    const Positions& b_;
    Eigen::Vector3f shift_;
    KnotPath path_;
    PathProjection projected_;
    std::unique_ptr<ArcLength> arc_length_;
    std::unique_ptr<PathGrid> grid_;
    std::int64_t trial_steps_;        ///< points left for several walks at the same time
    std::vector<PointIndex> begins_;  ///< points of A where a walk began
    PointIndex rewinds_;              ///< points left for repeated walks
};

}  // namespace

RunAlignment align_runs(const Positions& a, const Positions& b) { return Aligner(a, b).run(); }

}  // namespace clsurf
