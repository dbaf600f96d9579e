#include "viz/leader_slots.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace clsurf::viz {
namespace {

bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const auto side = [](const Vec2& from, const Vec2& to, const Vec2& p) {
        return (to - from).x() * (p - from).y() - (to - from).y() * (p - from).x();
    };
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

double distance(const Vec2& p, const Vec2& from, const Vec2& to) {
    const Vec2 along = to - from;
    const double share = along.squaredNorm() > 0 ? (p - from).dot(along) / along.squaredNorm() : 0;
    return (p - from - std::clamp(share, 0.0, 1.0) * along).norm();
}

class Leaders {
public:
    Leaders(const std::vector<Vec2>& anchors, const std::vector<double>& slots, double slot_x, double clearance)
        : anchors_(anchors), slots_(slots), slot_x_(slot_x), clearance_(clearance), slot_of_(anchors.size()) {
        uncross();
        keep_clear();
    }

    [[nodiscard]] const std::vector<std::size_t>& slot_of() const { return slot_of_; }

    /// Pairs of crossing leaders, with the highest weight, and anchors to which the leader of another one is too close.
    [[nodiscard]] std::size_t faults() const {
        const std::size_t n = anchors_.size();
        std::size_t sum = 0;
        for (std::size_t a = 0; a < n; ++a) {
            for (std::size_t b = a + 1; b < n; ++b)
                sum += cross(anchors_[a], end_of(a), anchors_[b], end_of(b)) ? n * n : 0;
            for (std::size_t b = 0; b < n; ++b) sum += a != b && meets(a, b) ? 1 : 0;
        }
        return sum;
    }

private:
    [[nodiscard]] Vec2 end_of(std::size_t k) const { return {slot_x_, slots_[slot_of_[k]]}; }

    /// Whether a leader is too close to another anchor. Coincident anchors do not count: no slot can separate them.
    [[nodiscard]] bool meets(std::size_t leader, std::size_t other) const {
        return (anchors_[other] - anchors_[leader]).norm() >= clearance_ &&
               distance(anchors_[other], anchors_[leader], end_of(leader)) < clearance_;
    }

    /// Assigns slots from top to bottom; then two crossing leaders exchange their slots. Each exchange shortens the total
    /// length, so the loop terminates.
    void uncross() {
        const auto falling = [](std::size_t count, auto&& height) {
            std::vector<std::size_t> order(count);
            std::iota(order.begin(), order.end(), std::size_t{0});
            std::stable_sort(order.begin(), order.end(),
                             [&](std::size_t a, std::size_t b) { return height(a) > height(b); });
            return order;
        };
        const std::vector<std::size_t> order = falling(anchors_.size(), [&](std::size_t k) { return anchors_[k].y(); });
        const std::vector<std::size_t> high_to_low = falling(slots_.size(), [&](std::size_t k) { return slots_[k]; });
        for (std::size_t k = 0; k < order.size(); ++k) slot_of_[order[k]] = high_to_low[k];
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t a = 0; a < anchors_.size(); ++a) {
                for (std::size_t b = a + 1; b < anchors_.size(); ++b) {
                    if (!cross(anchors_[a], end_of(a), anchors_[b], end_of(b))) continue;
                    std::swap(slot_of_[a], slot_of_[b]);
                    changed = true;
                }
            }
        }
    }

    /// Two leaders exchange their slots while that reduces the number of faults.
    void keep_clear() {
        std::size_t least = faults();
        for (bool changed = true; changed && least > 0;) {
            changed = false;
            for (std::size_t a = 0; a < anchors_.size(); ++a) {
                for (std::size_t b = a + 1; b < anchors_.size(); ++b) {
                    std::swap(slot_of_[a], slot_of_[b]);
                    if (const std::size_t now = faults(); now < least) {
                        least = now;
                        changed = true;
                    } else {
                        std::swap(slot_of_[a], slot_of_[b]);
                    }
                }
            }
        }
    }

    const std::vector<Vec2>& anchors_;
    const std::vector<double>& slots_;
    double slot_x_, clearance_;
    std::vector<std::size_t> slot_of_;
};

}  // namespace

std::vector<std::size_t> assign_slots(const std::vector<Vec2>& anchors, const std::vector<double>& slots, double slot_x,
                                      double clearance) {
    return Leaders(anchors, slots, slot_x, clearance).slot_of();
}

NameColumn place_names(const std::vector<Vec2>& anchors, double slot, double lowest, double highest, double slot_x,
                       double clearance) {
    constexpr double step = 0.25;  // distance between two positions, as a share of a slot
    constexpr int most_steps = 12;
    const double height = slot * static_cast<double>(anchors.size());
    const double beside = top_of_names(anchors, height, lowest, highest);
    NameColumn best;
    std::size_t least = 0;
    for (int k = 0; k <= 2 * most_steps; ++k) {
        // Alternately above and below.
        const double aside = step * slot * (k % 2 == 1 ? (k + 1) / 2 : -k / 2);
        NameColumn column;
        column.top = std::clamp(beside + aside, std::min(lowest + height, highest), highest);
        for (std::size_t row = 0; row < anchors.size(); ++row)
            column.slots.push_back(column.top - slot * (static_cast<double>(row) + 0.5));
        const Leaders leaders(anchors, column.slots, slot_x, clearance);
        const std::size_t faults = leaders.faults();
        if (k > 0 && faults >= least) continue;
        column.slot_of = leaders.slot_of();
        best = std::move(column);
        least = faults;
        if (least == 0) break;
    }
    return best;
}

double top_of_names(const std::vector<Vec2>& anchors, double height, double lowest, double highest) {
    if (anchors.empty()) return highest;
    double middle = 0;
    for (const Vec2& anchor : anchors) middle += anchor.y() / static_cast<double>(anchors.size());
    return std::clamp(middle + 0.5 * height, std::min(lowest + height, highest), highest);
}

}  // namespace clsurf::viz
