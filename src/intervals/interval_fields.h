#pragma once
// The field `interval`: planned speeds of a program's constant-speed intervals, at the points of their lines.

#include <memory>

#include "field/field_provider.h"
#include "machine/machine.h"
#include "mapping/line_map.h"
#include "program/program.h"

namespace clsurf {

[[nodiscard]] FieldInfo interval_field_info();

class IntervalFields : public FieldProvider {
public:
    /// `program` is in the coordinates of the log, and must outlive the object.
    IntervalFields(const Program& program, std::shared_ptr<const LineMap> lines, Machine machine = {})
        : program_(program), lines_(std::move(lines)), machine_(std::move(machine)) {}

    [[nodiscard]] std::vector<FieldInfo> fields() const override { return {interval_field_info()}; }
    /// Throws UsageError: no program. O(points + motions log motions).
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange points) const override;

private:
    const Program& program_;
    std::shared_ptr<const LineMap> lines_;
    Machine machine_;
};

}  // namespace clsurf
