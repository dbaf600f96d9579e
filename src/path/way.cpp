#include "path/way.h"

#include <algorithm>
#include <cmath>

#include "core/block.h"

namespace clsurf {
namespace {

/// Way over points [first, last]; steps from or to a missing position count nothing.
double way_over(const Positions& p, PointIndex first, PointIndex last) {
    const float* x = p.x.data();
    const float* y = p.y.data();
    const float* z = p.z.data();
    double sum = 0;
    for (PointIndex i = first; i < last; ++i) {
        const float dx = x[i + 1] - x[i];
        const float dy = y[i + 1] - y[i];
        const float dz = z[i + 1] - z[i];
        const float step = std::sqrt(dx * dx + dy * dy + dz * dz);
        sum += step == step ? step : 0.0F;
    }
    return sum;
}

}  // namespace

Way::Way(const Positions& positions) : positions_(&positions) {
    const PointIndex count = positions.size();
    sums_ = Column<double>(static_cast<std::size_t>((count + stride - 1) / stride + 1), 0.0);
    for_each_block(count, [&](PointIndex first, PointIndex last) {
        for (PointIndex begin = first; begin < last; begin += stride) {
            const PointIndex end = std::min(begin + stride, count - 1);
            sums_[static_cast<std::size_t>(begin / stride + 1)] = way_over(positions, begin, end);
        }
    });
    for (std::size_t k = 1; k < sums_.size(); ++k) sums_[k] += sums_[k - 1];
}

double Way::to(PointIndex i) const {
    const PointIndex block = i / stride;
    return sums_[static_cast<std::size_t>(block)] + way_over(*positions_, block * stride, i);
}

bool Way::at_least(PointIndex i, PointIndex j, double distance) const {
    if (i > j) std::swap(i, j);
    const PointIndex from = (i + stride - 1) / stride;
    const PointIndex to = j / stride;
    if (from < to && sums_[static_cast<std::size_t>(to)] - sums_[static_cast<std::size_t>(from)] >= distance) {
        return true;
    }
    return this->to(j) - this->to(i) >= distance;
}

}  // namespace clsurf
