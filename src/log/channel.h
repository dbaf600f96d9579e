#pragma once
// The names of channels, what they mean and which unit they have: one table. A channel that is not in
// it is kept under its own name and unit.

#include <span>
#include <string>
#include <string_view>

#include "log/log.h"

namespace clsurf {

struct ChannelInfo {
    std::string_view name;         ///< "line"; with a dot at its end ("cmd."): an axis letter follows
    std::string_view unit;         ///< empty: a count
    std::string_view rotary_unit;  ///< of axes a, b, c where it is another one
    std::string_view meaning;
};

/// Every name that the project knows.
[[nodiscard]] std::span<const ChannelInfo> known_channels();

/// A name of the table or a bare axis, whatever its case.
[[nodiscard]] bool is_known_name(std::string_view name);

/// A name as it is known, whatever its case; bare axes likewise. Others as they are.
[[nodiscard]] std::string normalised_name(std::string_view name);

/// "cmd.x", "fb.c", "act.y", …
[[nodiscard]] bool is_position(std::string_view name);

/// Gives channels the names as they are known. Where no position says whose it is, channels x, y, z,
/// a, b, c are the commanded ones, with a note `log.roles`.
void normalise_names(Log& log);

/// Brings positions to mm and deg, speeds to mm/min and time to seconds since the first record, as
/// the rest of the project reads them. Scale, bias and unit change, the raw values stay. Each change
/// is a note `log.unit` or `log.time-origin`; a unit that is not understood is a warning.
void normalise_units(Log& log);

}  // namespace clsurf
