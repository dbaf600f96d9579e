#include "machine/machine.h"

namespace clsurf {

std::string_view name_of(CornerMode mode) {
    constexpr std::array<std::string_view, 4> names{"spline", "arc", "stop", "junction"};
    return names[static_cast<std::size_t>(mode)];
}

std::string_view name_of(CurveMode mode) {
    constexpr std::array<std::string_view, 3> names{"none", "akima", "least-squares"};
    return names[static_cast<std::size_t>(mode)];
}

std::string_view name_of(PlannerKind kind) {
    constexpr std::array<std::string_view, 2> names{"time-optimal", "trapezoidal"};
    return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(FeedRule rule) {
    constexpr std::array<std::string_view, 2> names{"programmed", "intervals"};
    return names[static_cast<std::size_t>(rule)];
}

MachineAxis* Machine::axis(char letter) {
    if (letter >= 'x' && letter <= 'z') return &axes[static_cast<std::size_t>(letter - 'x')];
    if (!kinematics.has_rotary()) return nullptr;
    if (kinematics.tilt.letter == letter) return &rotary[0];
    return kinematics.rotation.letter == letter ? &rotary[1] : nullptr;
}

}  // namespace clsurf
