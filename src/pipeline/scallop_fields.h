#pragma once
// ScallopFields: the height of scallops between adjacent passes, from the displayed path and its tool.

#include <optional>

#include "field/field_provider.h"
#include "machined/tool.h"
#include "surface/cl_surface.h"

namespace clsurf {

class ScallopFields : public FieldProvider {
public:
    /// `surface` must outlive the object. `tool`: nullopt: not known.
    ScallopFields(const ClSurface& surface, std::optional<CuttingTool> tool) : surface_(surface), tool_(tool) {}

    /// scallop. Its note has percentiles over the length of the path, and the uncut area.
    [[nodiscard]] std::vector<FieldInfo> fields() const override;
    /// Whether the tool is a ball.
    [[nodiscard]] bool can_compute(std::string_view name) const override;
    /// Throws UsageError: the tool is not known, or is not a ball. O(points log points), parallel.
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange points) const override;

    /// Whether a field belongs to this provider.
    [[nodiscard]] static bool has(std::string_view name);

private:
    const ClSurface& surface_;
    std::optional<CuttingTool> tool_;
};

}  // namespace clsurf
