#include "toolpath/arc_length.h"

#include <algorithm>
#include <cmath>

#include "core/block.h"
#include "core/vectorised.h"

namespace clsurf {
namespace {

CLSURF_VECTORISED void measure(const float* x, const float* y, const float* z, float* steps, PointIndex first,
                               PointIndex last) {
    for (PointIndex i = first; i < last; ++i) {
        const float dx = x[i + 1] - x[i];
        const float dy = y[i + 1] - y[i];
        const float dz = z[i + 1] - z[i];
        const float squared = dx * dx + dy * dy + dz * dz;
        steps[i] = squared >= 0 ? std::sqrt(squared) : 0.0F;  // a step to or from NaN has no length
    }
}

}  // namespace

ArcLength::ArcLength(const Positions& positions) {
    if (positions.fill) {
        measure_when_read(positions);
        return;
    }
    const PointIndex count = positions.size();
    steps_.resize(static_cast<std::size_t>(count));
    sums_ = Column<double>(sum_count(count), 0.0);
    for_each_block(count, [&](PointIndex first, PointIndex last) {
        measure(positions.x.data(), positions.y.data(), positions.z.data(), steps_.data(), first,
                std::min(last, count - 1));
        if (last == count) steps_[static_cast<std::size_t>(count - 1)] = 0;
        for (PointIndex begin = first; begin < last; begin += stride) {
            double sum = 0;
            for (PointIndex i = begin; i < std::min(begin + stride, last); ++i) sum += step(i);
            sums_[static_cast<std::size_t>(begin / stride + 1)] = sum;
        }
    });
    for (std::size_t k = 1; k < sums_.size(); ++k) sums_[k] += sums_[k - 1];
}

void ArcLength::measure_when_read(const Positions& positions) {
    const PointIndex count = positions.size();
    sums_ = Column<double>::borrowed(positions.arc_lengths);
    steps_ = Column<float>::sparse(static_cast<std::size_t>(count));
    fill_ = {count,
             [&positions, count, steps = steps_.data()](PointIndex first, PointIndex last) {
                 positions.fill.need(first, std::min(last, count - 1));
                 measure(positions.x.data(), positions.y.data(), positions.z.data(), steps, first,
                         std::min(last, count - 1));
             },
             positions.fill->block()};
}

void ArcLength::forget() {
    if (!fill_) return;
    fill_->forget();
    steps_.forget();
}

double ArcLength::to(PointIndex i) const {
    const PointIndex block = i / stride;
    double arc_length = sums_[static_cast<std::size_t>(block)];
    for (PointIndex k = block * stride; k < i; ++k) arc_length += step(k);
    return arc_length;
}

bool ArcLength::at_least(PointIndex i, PointIndex j, double distance) const {
    if (i > j) std::swap(i, j);
    if (j - i <= stride) {
        double arc_length = 0;
        for (PointIndex k = i; k < j && arc_length < distance; ++k) arc_length += step(k);
        return arc_length >= distance;
    }
    const PointIndex from = (i + stride - 1) / stride;
    const PointIndex to = j / stride;
    if (from < to && sums_[static_cast<std::size_t>(to)] - sums_[static_cast<std::size_t>(from)] >= distance) {
        return true;
    }
    return this->to(j) - this->to(i) >= distance;
}

}  // namespace clsurf
