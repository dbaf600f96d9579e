#include "log/log.h"

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
    const std::string prefix(prefix_of(role));
    return find(prefix + ".x") != nullptr && find(prefix + ".y") != nullptr &&
           find(prefix + ".z") != nullptr;
}

double Log::time_of(PointIndex point) const {
    if (const Channel* time = find("time")) return time->values.at(point);
    return static_cast<double>(point) * period;
}

}  // namespace clsurf
