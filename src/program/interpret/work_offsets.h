#pragma once
// WorkOffsets: the work coordinate systems, and the shift of positions in all of them (G92, G52).

#include <cmath>
#include <cstdint>
#include <map>

#include "core/geometry.h"
#include "core/units.h"

namespace clsurf {

inline constexpr int plain_work_systems = 6;  ///< G54 … G59

/// Values of all axes.
struct AxisValues {
    Vec3 linear = Vec3::Zero();  ///< X, Y, Z [mm]
    Vec3 rotary = Vec3::Zero();  ///< A, B, C [deg]

    [[nodiscard]] bool is_zero() const { return linear.isZero() && rotary.isZero(); }
};

struct WorkOffset {
    Vec3 shift = Vec3::Zero();   ///< [mm]
    double rotation = 0;         ///< about z [deg]
    Vec3 rotary = Vec3::Zero();  ///< A, B, C [deg]
    std::uint8_t set = 0;        ///< what the program has set: bits as in WorkFrame
    int measured_from = 0;       ///< not set, but measured in this system of unknown offset (G10 L20); 0: none
};

/// Rotated about z by an angle [deg].
[[nodiscard]] inline Vec3 rotated_about_z(const Vec3& p, double degrees) {
    if (degrees == 0) return p;
    const double c = std::cos(degrees * rad_per_deg);
    const double s = std::sin(degrees * rad_per_deg);
    return {c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()};
}

struct WorkOffsets {
    int system = 1;                       ///< the active one; 1: G54
    std::map<int, WorkOffset> by_system;  ///< those that the program has named
    AxisValues shift;                     ///< G92 and G52 together
    AxisValues saved_shift;               ///< restored by G92.3

    [[nodiscard]] WorkOffset of(int number) const {
        const auto found = by_system.find(number);
        return found == by_system.end() ? WorkOffset{} : found->second;
    }
    [[nodiscard]] WorkOffset active() const { return of(system); }
    /// From A, B, C as programmed to those of the machine [deg].
    [[nodiscard]] Vec3 rotary() const { return shift.rotary + active().rotary; }

    /// From the work system to machine coordinates, without the tool.
    [[nodiscard]] Vec3 to_machine(const Vec3& p) const {
        const WorkOffset offset = active();
        return rotated_about_z(p + shift.linear, offset.rotation) + offset.shift;
    }
    [[nodiscard]] Vec3 from_machine(const Vec3& m) const {
        const WorkOffset offset = active();
        return rotated_about_z(m - offset.shift, -offset.rotation) - shift.linear;
    }
};

}  // namespace clsurf
