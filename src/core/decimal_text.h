#pragma once
// Numbers with a fixed number of decimals, as programs and reports have them. None is −0.

#include <string>

namespace clsurf {

/// "-12.500", "0.000"; with 0 decimals no point.
[[nodiscard]] std::string fixed_text(double value, int decimals);
/// The same with its sign: "+12.500", "-12.500", "+0.000".
[[nodiscard]] std::string signed_text(double value, int decimals);

}  // namespace clsurf
