#pragma once
// ToolAxes: the direction of the tool at each point of a log.

#include <array>
#include <memory>
#include <span>
#include <utility>

#include "core/column.h"
#include "core/geometry.h"
#include "core/point.h"

namespace clsurf {

/// Unit vectors of the tool axis in the workpiece, from the tip to the spindle. Copies share them.
class ToolAxes {
public:
    using Columns = std::array<Column<double>, 3>;  ///< x, y, z

    explicit ToolAxes(std::shared_ptr<const Columns> columns) : columns_(std::move(columns)) {}

    [[nodiscard]] PointIndex count() const { return static_cast<PointIndex>(columns_->front().size()); }
    [[nodiscard]] Vec3 at(PointIndex point) const;
    /// Copies points [begin, begin + x.size()). All spans same size.
    void read(PointIndex begin, std::span<double> x, std::span<double> y, std::span<double> z) const;

private:
    std::shared_ptr<const Columns> columns_;
};

}  // namespace clsurf
