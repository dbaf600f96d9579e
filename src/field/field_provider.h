#pragma once
// FieldProvider: what computes a group of fields: of positions (PositionFields), of the comparison with adjacent passes,
// of intervals, the channels of a log. A FieldSet joins them.

#include <span>
#include <string_view>
#include <vector>

#include "core/point.h"
#include "field/field.h"

namespace clsurf {

class FieldProvider {
public:
    FieldProvider() = default;
    FieldProvider(const FieldProvider&) = default;
    FieldProvider& operator=(const FieldProvider&) = default;
    virtual ~FieldProvider() = default;

    /// What it can compute, in the order of listings; notes are not filled.
    [[nodiscard]] virtual std::vector<FieldInfo> fields() const = 0;

    /// Whether all is there that this field of its own needs.
    [[nodiscard]] virtual bool can_compute(std::string_view /*name*/) const { return true; }

    /// Some of its fields at points [first, last], in the order of `names`, which are names of fields(). What they have in
    /// common is computed once. Throws UsageError where something is missing that a field needs. May be called from
    /// several threads.
    [[nodiscard]] virtual std::vector<Field> compute(std::span<const std::string_view> names,
                                                     PointRange points) const = 0;

    /// Comes before a name that is taken by another provider: "log.". Empty: its names must be new.
    [[nodiscard]] virtual std::string_view prefix() const { return {}; }
};

}  // namespace clsurf
