#pragma once
// Reports of several inputs as one report of the same format.

#include <string>
#include <string_view>
#include <vector>

namespace clsurf::io {

/// One SARIF log with the runs of all, distinguished by `names` (automationDetails). Domain: SARIF texts of one run each.
/// One JUnit report with the suites of several.
[[nodiscard]] std::string joined_junit(const std::vector<std::string>& texts);

[[nodiscard]] std::string joined_sarif(const std::vector<std::string>& names, const std::vector<std::string>& texts);

/// A value of a CSV row, quoted if RFC 4180 requires it.
[[nodiscard]] std::string csv_field(std::string_view text);

/// A CSV text with an additional first column: `title`, and `value` in every row; without the title line if
/// `titled` is false.
[[nodiscard]] std::string csv_with_column(std::string_view title, std::string_view value, std::string_view text,
                                          bool titled);

}  // namespace clsurf::io
