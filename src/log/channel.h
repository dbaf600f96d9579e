#pragma once
// The names, meanings and units of channels in one table. A channel that is not in it keeps its own name and unit.

#include <span>
#include <string>
#include <string_view>

#include "log/log.h"

namespace clsurf {

struct ChannelInfo {
    std::string_view name;         ///< "line"; a trailing dot ("cmd."): an axis letter follows
    std::string_view unit;         ///< empty: a count
    std::string_view rotary_unit;  ///< unit of axes a, b, c if it differs
    std::string_view meaning;
};

/// Every name that the project knows.
[[nodiscard]] std::span<const ChannelInfo> known_channels();

/// Whether a name is in the table or is a bare axis, in any letter case.
[[nodiscard]] bool is_known_name(std::string_view name);

/// The known form of a name or bare axis in any letter case; other names unchanged.
[[nodiscard]] std::string normalised_name(std::string_view name);

/// "cmd.x", "fb.c", "act.y", …
[[nodiscard]] bool is_position(std::string_view name);

/// Gives channels their known names. If no position names its role, channels x, y, z, a, b, c are the commanded ones,
/// with a note `log.roles`.
void normalise_names(Log& log);

/// Converts positions to mm and deg, speeds to mm/min and time to seconds since the first record, as the rest of the
/// project expects. Scale, bias and unit change, the raw values do not. Each change is a note `log.unit` or
/// `log.time-origin`; an unknown unit is a warning.
void normalise_units(Log& log);

}  // namespace clsurf
