#pragma once
// Reports of several inputs as one report of the same format.

#include <string>
#include <string_view>
#include <vector>

namespace clsurf::io {

/// One SARIF log with the runs of all, told apart by `names` (automationDetails). Domain: SARIF texts of one run each.
/// The suites of several JUnit reports in one.
[[nodiscard]] std::string joined_junit(const std::vector<std::string>& texts);

[[nodiscard]] std::string joined_sarif(const std::vector<std::string>& names, const std::vector<std::string>& texts);

/// A value of a CSV row, quoted where RFC 4180 asks for it.
[[nodiscard]] std::string csv_field(std::string_view text);

/// A CSV text with one more column in front: `title`, and `value` in every row; without the line of titles where
/// `titled` is false.
[[nodiscard]] std::string csv_with_column(std::string_view title, std::string_view value, std::string_view text,
                                          bool titled);

}  // namespace clsurf::io
