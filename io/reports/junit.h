#pragma once
// Results as JUnit's XML, which build servers show as tests: the elements that Jenkins (junit-10.xsd) and GitLab read.

#include <string>
#include <vector>

namespace clsurf::io {

struct JunitCase {
    std::string name;
    std::string failure;  ///< one line; empty: it passed
    std::string details;  ///< of a failure
    std::string error;    ///< why it could not be tested, one line; empty: it could
};

struct JunitSuite {
    std::string name;
    std::string class_name;  ///< of its cases: what they are of
    std::vector<JunitCase> cases;
    std::string output;  ///< text for people
};

[[nodiscard]] std::string junit_text(const std::vector<JunitSuite>& suites);

}  // namespace clsurf::io
