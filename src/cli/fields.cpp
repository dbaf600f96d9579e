#include "cli/fields.h"

#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "intervals/program_intervals.h"
#include "machine/machine.h"
#include "pipeline/signals_of.h"
#include "predictor/quality_fields.h"

namespace clsurf::cli {

namespace {

const FieldInfo& interval_info() {
    static const FieldInfo info{
        "interval", "Planned speed of the constant-speed interval", unit::mm_min, FieldScale::sequential, {}};
    return info;
}

}  // namespace

Field Fields::interval_field() const {
    if (part_.program.motions.size() == 0) throw UsageError("the field 'interval' needs the program: PROGRAM LOG");
    const ProgrammedSurface laid = lay_out(part_.program);
    IntervalRules rules;
    rules.reach = 0.5 * laid.surface.step_over;
    const ProgramIntervals planned = plan_intervals(part_.program, laid, rules, Machine{});
    Field field{interval_info(),
                Column<float>(static_cast<std::size_t>(part_.log.records), std::numeric_limits<float>::quiet_NaN())};
    field.info.note = fmt::format("{} intervals on {} passes, on the machine of clsurf machine --defaults",
                                  planned.intervals.size(), planned.passes);
    for (PointIndex i = 0; i < part_.log.records; ++i) {
        const std::span<const std::uint32_t> motions = part_.lines->motions_of(part_.lines->line_at(i));
        if (!motions.empty()) field.values[static_cast<std::size_t>(i)] = planned.speed_of_motion[motions.front()];
    }
    return field;
}

std::string_view usual_name(std::string_view name, const Log& log) {
    constexpr std::pair<std::string_view, std::string_view> words[] = {
        {"mismatch", "speed_mismatch"}, {"lag", "following_error"}, {"accel", "acceleration"},
        {"velocity", "speed"},          {"feedrate", "speed"},      {"error", "contour_error"},
    };
    if (log.find(name) != nullptr) return name;
    for (const auto& [word, meant] : words) {
        if (word == name) return meant;
    }
    return name;
}

Field Fields::get(std::string_view asked) {
    const std::string_view name = usual_name(asked, part_.log);
    if (is_quality_field(name)) {
        if (!signals_)
            signals_ = std::make_unique<Signals>(std::move(signals_of(part_, surface_, std::nullopt).signals));
        return quality_field(name, surface_, *signals_);
    }
    if (name == interval_info().name) return interval_field();
    if (!set_.has(name)) unknown_field(name, all_fields(&part_.log));
    return set_.get(name);
}

std::vector<FieldInfo> all_fields(const Log* log) {
    std::vector<FieldInfo> fields = known_fields(nullptr);
    for (const FieldInfo& info : quality_fields()) fields.push_back(info);
    fields.push_back(interval_info());
    if (log == nullptr) return fields;
    const std::vector<FieldInfo> with_channels = known_fields(log);
    fields.insert(fields.end(), with_channels.begin() + static_cast<std::ptrdiff_t>(known_fields(nullptr).size()),
                  with_channels.end());
    return fields;
}

}  // namespace clsurf::cli
