#pragma once
// Numbers with a fixed number of decimals, for programs and reports. Never −0.

#include <string>

namespace clsurf {

/// "-12.500", "0.000"; without a decimal point if there are 0 decimals.
[[nodiscard]] std::string fixed_text(double value, int decimals);
/// The same with its sign: "+12.500", "-12.500", "+0.000".
[[nodiscard]] std::string signed_text(double value, int decimals);

}  // namespace clsurf
