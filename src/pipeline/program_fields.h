#pragma once
// ProgramFields: programmed values at a place: feed, length of the block, turning angle and curvature of the path. They
// need no log; the points of a log get the values of their blocks.

#include <memory>

#include "field/field_provider.h"
#include "mapping/line_map.h"
#include "program/program.h"

namespace clsurf {

class ProgramFields : public FieldProvider {
public:
    /// `program` must outlive the object.
    ProgramFields(const Program& program, std::shared_ptr<const LineMap> lines)
        : program_(program), lines_(std::move(lines)) {}

    /// programmed_feed, block_length, turning_angle, programmed_curvature.
    [[nodiscard]] std::vector<FieldInfo> fields() const override;
    /// Whether there is a program.
    [[nodiscard]] bool can_compute(std::string_view name) const override;
    /// The value of the motion of each point; NaN at rapids, and if the motion is unknown. Throws UsageError: no program.
    /// O(points + motions), parallel over points.
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange points) const override;

    /// Whether a field belongs to this provider.
    [[nodiscard]] static bool has(std::string_view name);

private:
    const Program& program_;
    std::shared_ptr<const LineMap> lines_;
};

}  // namespace clsurf
