#include "toolpath/tool_axes.h"

#include <algorithm>

namespace clsurf {

Vec3 ToolAxes::at(PointIndex point) const {
    const auto i = static_cast<std::size_t>(point);
    return {columns_->at(0)[i], columns_->at(1)[i], columns_->at(2)[i]};
}

void ToolAxes::read(PointIndex begin, std::span<double> x, std::span<double> y, std::span<double> z) const {
    const std::array<std::span<double>, 3> out{x, y, z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        std::copy_n(columns_->at(axis).begin() + begin, out[axis].size(), out[axis].begin());
}

}  // namespace clsurf
