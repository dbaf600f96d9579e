#pragma once
// Results as JUnit XML, which build servers show as tests: the elements that Jenkins (junit-10.xsd) and GitLab read.

#include <string>
#include <string_view>
#include <vector>

namespace clsurf::io {

struct JunitCase {
    std::string name;
    std::string failure;  ///< one line; empty: it passed
    std::string details;  ///< details of a failure
    std::string error;    ///< why it could not be tested, one line; empty: it was tested
};

struct JunitSuite {
    std::string name;
    std::string class_name;  ///< class name of its cases
    std::vector<JunitCase> cases;
    std::string output;  ///< text for people
};

/// The case of `check` that has an error if there is no verdict.
inline constexpr std::string_view verdict_case = "the data allow a verdict";
/// The suite of `check` on a log, without cases.
[[nodiscard]] JunitSuite check_suite(const std::string& program, const std::string& log);

[[nodiscard]] std::string junit_text(const std::vector<JunitSuite>& suites);

}  // namespace clsurf::io
