#pragma once
// Texts that several maps use.

#include <string>
#include <string_view>
#include <vector>

#include "field/range.h"
#include "surface/cl_surface.h"

namespace clsurf::viz {

/// "27517 points, 42 passes, 0.5 mm apart".
[[nodiscard]] std::string counts_of(const ClSurface& surface);
/// The same for a surface with a selected part (surface/selection.h): "61 of 18531 points, 1 pass, …".
[[nodiscard]] std::string counts_of_selection(const ClSurface& surface);
/// A footnote: the ramps at the ends of passes are drawn paler, because all passes have them.
inline constexpr std::string_view ramps_note = "paler: ramps at the ends of passes";
/// A footnote: the meaning of the numbers after the names of values.
inline constexpr std::string_view shares_note = "shares of the cutting points";
/// The footnote that positions on the part are contact points, if the tool is known.
inline constexpr std::string_view tool_tip_note = "axes show the tool tip: `clsurf query --at tip:X,Y`";
/// The footnotes about a range.
[[nodiscard]] std::vector<std::string> notes_of(const ShownRange& range);

}  // namespace clsurf::viz
