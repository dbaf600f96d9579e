#pragma once
// ScallopFields: how high the cusps between adjacent passes stand, by the path that is shown and its tool.

#include <optional>

#include "field/field_provider.h"
#include "machined/tool.h"
#include "surface/cl_surface.h"

namespace clsurf {

class ScallopFields : public FieldProvider {
public:
    /// `surface` must outlive it. `tool`: nothing: not known.
    ScallopFields(const ClSurface& surface, std::optional<CuttingTool> tool) : surface_(surface), tool_(tool) {}

    /// scallop. Its note has percentiles over the length of the path, and the uncut area.
    [[nodiscard]] std::vector<FieldInfo> fields() const override;
    /// Whether the tool is a ball.
    [[nodiscard]] bool can_compute(std::string_view name) const override;
    /// Throws UsageError: the tool is not known, or is no ball. O(points log points), parallel.
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange points) const override;

    /// Whether it is one of these fields.
    [[nodiscard]] static bool has(std::string_view name);

private:
    const ClSurface& surface_;
    std::optional<CuttingTool> tool_;
};

}  // namespace clsurf
