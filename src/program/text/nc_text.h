#pragma once
// What new lines of a program are written with.

#include <string>
#include <string_view>
#include <vector>

namespace clsurf {

/// A number with so many decimals and no −0: "-12.500", "0.000"; with 0 decimals no point.
[[nodiscard]] std::string nc_number(double value, int decimals);
/// The same with its sign, as Klartext has it: "+12.500".
[[nodiscard]] std::string signed_nc_number(double value, int decimals);
/// A number of nc_number() without zeros at its end: "12.5", "0".
[[nodiscard]] std::string without_end_zeros(std::string number);

/// Lines of a cubic NURBS of Fanuc (G06.2): a knot before each point, the last knots by themselves. Domain: four knots more than
/// points.
[[nodiscard]] std::vector<std::string> fanuc_nurbs_lines(const std::vector<std::string>& points,
                                                         const std::vector<std::string>& knots);

/// The end of the first line of a text: "\r\n" or "\n".
[[nodiscard]] std::string_view line_end_of(std::string_view text);

}  // namespace clsurf
