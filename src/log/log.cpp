#include "log/log.h"

#include <algorithm>
#include <array>

#include "core/statistics.h"

namespace clsurf {

std::string_view name_of(Role role) {
    switch (role) {
        case Role::commanded: return "commanded";
        case Role::feedback: return "feedback";
        case Role::actual: return "actual";
    }
    return "commanded";
}

std::string_view prefix_of(Role role) {
    switch (role) {
        case Role::commanded: return "cmd";
        case Role::feedback: return "fb";
        case Role::actual: return "act";
    }
    return "cmd";
}

const Channel* Log::find(std::string_view channel) const {
    for (const Channel& c : channels) {
        if (c.name == channel) return &c;
    }
    return nullptr;
}

bool Log::has(Role role) const {
    const auto has_axis = [&](Role of, const char* axis) { return find(std::string(prefix_of(of)) + axis) != nullptr; };
    if (!has_axis(role, ".x") || !has_axis(role, ".z")) return false;
    if (has_axis(role, ".y")) return true;
    // A lathe: no role has a Y. If another role has one, this one's is missing.
    return std::ranges::none_of(std::array{Role::commanded, Role::feedback, Role::actual},
                                [&](Role other) { return has_axis(other, ".y"); });
}

double Log::time_of(PointIndex point) const {
    if (const Channel* time = find("time")) return time->values.at(point);
    return static_cast<double>(point) * period;
}

double Log::measured_period() const {
    const Channel* time = find("time");
    if (time == nullptr) return 0;
    constexpr PointIndex examined = 10'001;
    std::vector<double> t(static_cast<std::size_t>(std::min(records, examined)));
    copy_block(time->values, 0, t);
    std::vector<double> steps;
    for (std::size_t i = 1; i < t.size(); ++i) {
        if (t[i] > t[i - 1]) steps.push_back(t[i] - t[i - 1]);
    }
    if (steps.empty()) return 0;
    return median(steps);
}

}  // namespace clsurf
