#include "pipeline/cause_fields.h"

#include <algorithm>
#include <string>

#include "core/not_finite.h"
#include "pipeline/judge.h"
#include "pipeline/signals_of.h"

namespace clsurf {
namespace {

constexpr float no_defect = 0;

float value_of(Cause cause) { return static_cast<float>(cause) + 1; }

FieldInfo cause_info() {
    FieldInfo info{"cause", "Cause of the defect", unit::none, FieldScale::sequential, {}};
    info.classes.push_back({no_defect, "no defect", true});
    for (int k = 0; k < cause_count; ++k) {
        const auto cause = static_cast<Cause>(k);
        std::string name(name_of(cause));
        std::replace(name.begin(), name.end(), '_', ' ');
        info.classes.push_back({value_of(cause), name});
    }
    return info;
}

/// Where two defects overlap, the smaller one determines the cause: a region of lag would hide the slow pass in it. Of
/// equal areas the stronger defect is last.
std::vector<const Defect*> smallest_last(const std::vector<Defect>& defects) {
    std::vector<const Defect*> order;
    for (std::size_t k = defects.size(); k-- > 0;) order.push_back(&defects[k]);
    std::stable_sort(order.begin(), order.end(), [](const Defect* a, const Defect* b) { return a->area > b->area; });
    return order;
}

}  // namespace

std::vector<FieldInfo> CauseFields::fields() const { return {cause_info()}; }

std::vector<Field> CauseFields::compute(std::span<const std::string_view> names, PointRange points) const {
    const QualityReport report = find_defects(part_, surface_, signals_of(part_, surface_));
    Field field{cause_info(), Column<float>(static_cast<std::size_t>(points.size()), missing<float>)};
    const auto fill = [&](PointRange range, float value) {
        const PointIndex first = std::max(range.first, points.first);
        const PointIndex last = std::min(range.last, points.last);
        for (PointIndex i = first; i <= last; ++i) field.values[static_cast<std::size_t>(i - points.first)] = value;
    };
    for (const Pass& pass : surface_.passes) {
        if (is_of_surface(pass.kind)) fill({pass.first, pass.last}, no_defect);
    }
    for (const Defect* defect : smallest_last(report.defects)) {
        for (const DefectSection& section : defect->sections) fill(section.points, value_of(defect->cause));
    }
    return std::vector<Field>(names.size(), field);
}

}  // namespace clsurf
