#include "simulation/plan/speed_scan.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr double same = 1e-9;       ///< share of a limit that is neglected
constexpr double rounding = 1e-12;  ///< of a b

}  // namespace

void SpeedScan::clear() {
    cells_.clear();
    rows_.clear();
    squares_.clear();
}

void SpeedScan::add_cell(double length, double cap, double acceleration) {
    cells_.push_back({length, cap * cap, acceleration, rows_.size()});
}

void SpeedScan::limit_begin(double speed) { cells_.back().begin_cap = speed * speed; }

void SpeedScan::add_limit(std::size_t number, double at, double slope, double bend, double acceleration) {
    Cell& cell = cells_[number];
    // At the place, b is the value at the start plus 2 a `at`.
    const double of_a = slope + 2 * bend * at;
    const double steep = std::abs(of_a);
    // A limit that is never reached is omitted.
    if (steep * cell.acceleration + std::abs(bend) * cell.cap <= acceleration) return;
    if (steep * cell.acceleration < same * acceleration) {
        cell.cap = std::min(cell.cap, acceleration / std::abs(bend));
        return;
    }
    rows_.insert(rows_.begin() + static_cast<std::ptrdiff_t>(cell.end_row), {acceleration / steep, bend / of_a});
    for (std::size_t i = number; i < cells_.size(); ++i) ++cells_[i].end_row;
}

SpeedScan::Bounds SpeedScan::bounds(std::size_t cell, double b, double next) const {
    const Cell& c = cells_[cell];
    // The next b is neither below 0 nor above its limit.
    const double rate = 0.5 / c.length;
    Bounds bounds{{-c.acceleration, 0}, {c.acceleration, 0}};
    double low = -c.acceleration, high = c.acceleration;
    const auto narrow = [&](const Line& least, const Line& greatest) {
        if (least.at(b) > low) bounds.low = least, low = least.at(b);
        if (greatest.at(b) < high) bounds.high = greatest, high = greatest.at(b);
    };
    narrow({0, -rate}, {rate * next, -rate});
    for (std::size_t r = first_row(cell); r < c.end_row; ++r)
        narrow({-rows_[r].width, -rows_[r].tilt}, {rows_[r].width, -rows_[r].tilt});
    return bounds;
}

/// The lowest a is convex over b, the greatest one concave, and at b = 0 there is space between them: starting from the
/// right, Newton steps on the lines converge to their intersection.
double SpeedScan::greatest_before(std::size_t cell, double next) const {
    double b = std::min(cells_[cell].cap, cells_[cell].begin_cap);
    if (cell > 0) b = std::min(b, cells_[cell - 1].cap);
    while (true) {
        const Bounds here = bounds(cell, b, next);
        if (here.low.at(b) <= here.high.at(b)) return b;
        const double crossing = (here.high.at_rest - here.low.at_rest) / (here.low.by_b - here.high.by_b);
        if (!(crossing < b * (1 - rounding))) return b;
        b = std::max(crossing, 0.0);
    }
}

void SpeedScan::plan(double speed) {
    squares_.assign(cells_.size() + 1, 0.0);
    for (std::size_t i = cells_.size(); i-- > 0;) squares_[i] = greatest_before(i, squares_[i + 1]);
    squares_[0] = std::min(squares_[0], speed * speed);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const double greatest = bounds(i, squares_[i], squares_[i + 1]).high.at(squares_[i]);
        squares_[i + 1] = std::clamp(squares_[i] + 2 * greatest * cells_[i].length, 0.0, squares_[i + 1]);
    }
}

double SpeedScan::speed(std::size_t knot) const { return std::sqrt(squares_[knot]); }

void SpeedScan::motions(std::size_t cell, std::vector<CellMotion>& into) const {
    const Cell& c = cells_[cell];
    const double before = squares_[cell], after = squares_[cell + 1];
    into.clear();
    if (has_limits(cell)) {
        into.push_back({c.length, std::sqrt(before), acceleration(cell), 0});
        return;
    }
    const double peak = std::max({before, after, std::min(c.cap, 0.5 * (before + after) + c.acceleration * c.length)});
    const double up = 0.5 * (peak - before) / c.acceleration, down = 0.5 * (peak - after) / c.acceleration;
    const double cruise = c.length - up - down, top = std::sqrt(peak);
    if (up > 0) into.push_back({up, std::sqrt(before), c.acceleration, 0});
    if (cruise > 0) into.push_back({cruise, top, 0, 0});
    if (down > 0) into.push_back({down, top, -c.acceleration, 0});
}

bool SpeedScan::at_cap(std::size_t cell, const CellMotion& motion) const {
    const double before = motion.speed * motion.speed;
    const double least = std::min(before, before + 2 * motion.acceleration * motion.length);
    return least >= cells_[cell].cap * (1 - same);
}

void SpeedScan::drop_front(std::size_t count) {
    if (count == 0) return;
    const std::size_t rows = cells_[count - 1].end_row;
    cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(count));
    rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(rows));
    for (Cell& cell : cells_) cell.end_row -= rows;
}

}  // namespace clsurf
