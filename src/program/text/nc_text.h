#pragma once
// Helpers for writing new lines of a program.

#include <string>
#include <string_view>
#include <vector>

namespace clsurf {

/// A number of fixed_text() (core/decimal_text.h) without trailing zeros: "12.5", "0".
[[nodiscard]] std::string without_end_zeros(std::string number);

/// Lines of a cubic NURBS of Fanuc (G06.2): a knot before each point, then the remaining knots alone. Domain: four knots more
/// than points.
[[nodiscard]] std::vector<std::string> fanuc_nurbs_lines(const std::vector<std::string>& points,
                                                         const std::vector<std::string>& knots);

/// The end of the first line of a text: "\r\n" or "\n".
[[nodiscard]] std::string_view line_end_of(std::string_view text);

}  // namespace clsurf
