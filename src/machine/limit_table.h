#pragma once
// The limits of a machine in one table: the name of each, its key in a machine file, its member in a Machine, and the
// derivative of the position that it limits.

#include <array>
#include <cstdint>
#include <string_view>

#include "core/units.h"
#include "machine/machine.h"

namespace clsurf {

enum class LimitedQuantity : std::uint8_t {
    speed,
    acceleration,
    jerk,
    path_speed,
    tangential_acceleration,
    normal_acceleration,
    path_jerk,
    tolerance,
    following_error,
};

struct LimitTableRow {
    LimitedQuantity quantity;
    std::string_view name;         ///< of reports: "tangential_acceleration"
    std::string_view key;          ///< of machine files and budgets: "max_acceleration"
    int order;                     ///< of the derivative; 0: a distance
    Unit unit, rotary_unit;        ///< in reports
    double MachineAxis::*of_axis;  ///< nullptr: not a limit of an axis
    double PathLimits::*of_path;   ///< nullptr: not a limit of the path
};

/// Indexed by LimitedQuantity.
inline constexpr std::array limit_table{
    LimitTableRow{LimitedQuantity::speed, "speed", "max_speed", 1, unit::mm_min,
                  Unit{"deg/min", deg_per_rad* seconds_per_minute}, &MachineAxis::max_speed, nullptr},
    LimitTableRow{LimitedQuantity::acceleration, "acceleration", "max_acceleration", 2, unit::mm_s2,
                  Unit{"deg/s²", deg_per_rad}, &MachineAxis::max_acceleration, nullptr},
    LimitTableRow{LimitedQuantity::jerk, "jerk", "max_jerk", 3, unit::mm_s3, Unit{"deg/s³", deg_per_rad},
                  &MachineAxis::max_jerk, nullptr},
    LimitTableRow{LimitedQuantity::path_speed, "path_speed", "max_speed", 1, unit::mm_min, unit::none, nullptr,
                  &PathLimits::max_speed},
    LimitTableRow{LimitedQuantity::tangential_acceleration, "tangential_acceleration", "max_acceleration", 2,
                  unit::mm_s2, unit::none, nullptr, &PathLimits::max_acceleration},
    LimitTableRow{LimitedQuantity::normal_acceleration, "normal_acceleration", "max_normal_acceleration", 2,
                  unit::mm_s2, unit::none, nullptr, &PathLimits::max_normal_acceleration},
    LimitTableRow{LimitedQuantity::path_jerk, "path_jerk", "max_jerk", 3, unit::mm_s3, unit::none, nullptr,
                  &PathLimits::max_jerk},
    LimitTableRow{LimitedQuantity::tolerance, "tolerance", "tolerance", 0, unit::mm, unit::none, nullptr, nullptr},
    LimitTableRow{LimitedQuantity::following_error, "following_error", "max_following_error_um", 0, unit::mm, unit::deg,
                  nullptr, nullptr},
};

[[nodiscard]] constexpr const LimitTableRow& row_of(LimitedQuantity quantity) {
    return limit_table[static_cast<std::size_t>(quantity)];
}

/// A limit that the user or a machine file gives.
struct StatedLimit {
    LimitedQuantity quantity = LimitedQuantity::speed;
    char axis = 0;     ///< 'x' … 'c'; 0: the path
    double value = 0;  ///< mm and s; of rotary axes rad
};

}  // namespace clsurf
