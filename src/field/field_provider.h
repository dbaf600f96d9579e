#pragma once
// FieldProvider: computes a group of fields: from positions (PositionFields), from the comparison with adjacent passes,
// from intervals, from the channels of a log. A FieldSet joins them.

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

    /// The fields that it can compute, in the order of listings; notes are not filled.
    [[nodiscard]] virtual std::vector<FieldInfo> fields() const = 0;

    /// Whether the inputs of this field are available.
    [[nodiscard]] virtual bool can_compute(std::string_view /*name*/) const { return true; }

    /// Some of its fields at points [first, last], in the order of `names`, which are names of fields(). Shared
    /// intermediate results are computed once. Throws UsageError if an input of a field is missing. May be called from
    /// several threads.
    [[nodiscard]] virtual std::vector<Field> compute(std::span<const std::string_view> names,
                                                     PointRange points) const = 0;

    /// Prefix of names that are already taken by another provider: "log.". Empty: its names must be new.
    [[nodiscard]] virtual std::string_view prefix() const { return {}; }
};

}  // namespace clsurf
