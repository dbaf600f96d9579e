#include "tradeoff/front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/not_finite.h"

namespace clsurf {
namespace {

std::array<double, 3> objectives_of(const MotionQuality& q) { return {q.duration, q.mismatch, q.jerk}; }

bool knows_all(const MotionQuality& q) {
    const std::array<double, 3> values = objectives_of(q);
    return std::ranges::all_of(values, [](double value) { return value == value; });
}

double ratio(double value, double reference) {
    if (reference > 0) return value / reference;
    return value > reference ? infinite : 1;
}

}  // namespace

TradeoffRow row_of(std::string name, const MotionQuality& quality, const QualityReport& report) {
    TradeoffRow row{std::move(name), quality, report.defects.size()};
    for (const Defect& defect : report.defects) row.deepest = std::max(row.deepest, defect.depth);
    return row;
}

bool dominates(const MotionQuality& a, const MotionQuality& b) {
    if (!knows_all(a) || !knows_all(b)) return false;
    const std::array<double, 3> of_a = objectives_of(a), of_b = objectives_of(b);
    bool better = false;
    for (std::size_t k = 0; k < of_a.size(); ++k) {
        if (of_a[k] > of_b[k]) return false;
        better = better || of_a[k] < of_b[k];
    }
    return better;
}

void mark_front(std::vector<TradeoffRow>& rows) {
    std::vector<std::size_t> order;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        rows[row].on_front = false;
        if (knows_all(rows[row].quality)) order.push_back(row);
    }
    // A row can only be dominated by earlier rows in this order, and if it is, by one of the front.
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
        return objectives_of(rows[a].quality) < objectives_of(rows[b].quality);
    });
    std::vector<std::size_t> front;
    for (const std::size_t row : order) {
        const MotionQuality& quality = rows[row].quality;
        rows[row].on_front =
            std::ranges::none_of(front, [&](std::size_t other) { return dominates(rows[other].quality, quality); });
        if (rows[row].on_front) front.push_back(row);
    }
}

double weighted_cost(const MotionQuality& quality, const MotionQuality& reference, double weight) {
    const double surface = 0.5 * (ratio(quality.mismatch, reference.mismatch) + ratio(quality.jerk, reference.jerk));
    // Avoids 0 times infinity.
    const double of_surface = weight > 0 ? weight * surface : 0;
    const double of_time = weight < 1 ? (1 - weight) * ratio(quality.duration, reference.duration) : 0;
    return of_time + of_surface;
}

std::vector<std::size_t> front_by_weight(std::span<const TradeoffRow> rows, double weight) {
    std::vector<std::size_t> order;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        if (rows[row].on_front) order.push_back(row);
    }
    const auto costs = [&](std::size_t row) {
        const MotionQuality &quality = rows[row].quality, &reference = rows.front().quality;
        return std::array{weighted_cost(quality, reference, weight), weighted_cost(quality, reference, 0.5)};
    };
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return costs(a) < costs(b); });
    return order;
}

}  // namespace clsurf
