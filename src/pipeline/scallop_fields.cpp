#include "pipeline/scallop_fields.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/units.h"
#include "machined/scallop_map.h"

namespace clsurf {
namespace {

constexpr std::string_view scallop = "scallop";

FieldInfo scallop_info() {
    FieldInfo info{std::string(scallop), "Scallop height", unit::um, FieldScale::sequential, {}};
    info.preference = FieldPreference::lower;
    return info;
}

std::string note_of(const ScallopMap& map, const CuttingTool& tool) {
    const std::string uncut = fmt::format("uncut {:.3g} mm²", map.uncut);
    if (!std::isfinite(map.most)) return fmt::format("{}: no scallop; {}", to_text(tool), uncut);
    return fmt::format("{}: scallop 50 % {:.2f}, 95 % {:.2f}, at most {:.2f} µm; {}", to_text(tool),
                       map.median * um_per_mm, map.p95 * um_per_mm, map.most * um_per_mm, uncut);
}

}  // namespace

bool ScallopFields::has(std::string_view name) { return name == scallop; }

std::vector<FieldInfo> ScallopFields::fields() const { return {scallop_info()}; }

bool ScallopFields::can_compute(std::string_view /*name*/) const { return tool_ && tool_->kind == ToolKind::ball; }

std::vector<Field> ScallopFields::compute(std::span<const std::string_view> names, PointRange points) const {
    if (names.empty()) return {};
    if (!tool_)
        throw UsageError("the field '" + std::string(scallop) + "' needs to know the tool",
                         "--color scallop --tool ball:6");
    ScallopMap map = scallop_map(surface_, *tool_);
    Field field{scallop_info(), Column<float>(static_cast<std::size_t>(points.size()))};
    field.info.note = note_of(map, *tool_);
    std::copy_n(map.height.begin() + static_cast<std::ptrdiff_t>(points.first), points.size(), field.values.begin());
    return std::vector<Field>(names.size(), field);
}

}  // namespace clsurf
