#include "intervals/interval_fields.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/not_finite.h"
#include "intervals/program_intervals.h"

namespace clsurf {

FieldInfo interval_field_info() {
    FieldInfo info{
        "interval", "Planned speed of the constant-speed interval", unit::mm_min, FieldScale::sequential, {}};
    info.preference = FieldPreference::higher;
    info.class_word = "interval";
    return info;
}

std::vector<Field> IntervalFields::compute(std::span<const std::string_view> names, PointRange points) const {
    if (program_.motions.size() == 0) throw UsageError("the field 'interval' needs the program: PROGRAM LOG");
    const ProgrammedSurface programmed = build_programmed_surface(program_);
    const ProgramIntervals planned = plan_intervals(program_, programmed, {}, machine_);
    Field field{interval_field_info(), Column<float>(static_cast<std::size_t>(points.size()), missing<float>)};
    field.info.note = fmt::format("{} intervals on {} passes, planned for the machine \"{}\"", planned.intervals.size(),
                                  planned.passes, machine_.name);
    for (PointIndex i = points.first; i <= points.last; ++i) {
        const std::span<const std::uint32_t> motions = lines_->motions_of(lines_->line_at(i));
        if (!motions.empty())
            field.values[static_cast<std::size_t>(i - points.first)] = planned.speed_of_motion[motions.front()];
    }
    return std::vector<Field>(names.size(), field);
}

}  // namespace clsurf
