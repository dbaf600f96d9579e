#pragma once
// The field `cause`: the cause of a defect, as `check` finds it, at the points of the passes that cause it.

#include "field/field_provider.h"
#include "pipeline/part.h"

namespace clsurf {

class CauseFields : public FieldProvider {
public:
    /// Both must outlive the object.
    CauseFields(const Part& part, const ClSurface& surface) : part_(part), surface_(surface) {}

    [[nodiscard]] std::vector<FieldInfo> fields() const override;
    /// Computes the defects of the whole part. NaN outside cut passes. O(points), parallel.
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange points) const override;

private:
    const Part& part_;
    const ClSurface& surface_;
};

}  // namespace clsurf
