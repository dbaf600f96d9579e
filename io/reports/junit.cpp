#include "io/reports/junit.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/file_name.h"
#include "core/printable_text.h"
#include "io/files/xml_text.h"

namespace clsurf::io {
namespace {

/// For attributes and elements. XML does not allow control characters: they become visible signs.
std::string xml(const std::string& text, bool lines) {
    std::string out;
    std::string line;
    const auto flush = [&] {
        out += xml_escaped(printable(line));
        line.clear();
    };
    for (const char c : text) {
        if (c != '\n') {
            line += c;
            continue;
        }
        flush();
        out += lines ? "\n" : " ";
    }
    flush();
    return out;
}

std::string case_text(const JunitSuite& suite, const JunitCase& c) {
    const std::string open =
        fmt::format("    <testcase classname=\"{}\" name=\"{}\"", xml(suite.class_name, false), xml(c.name, false));
    if (!c.error.empty())
        return fmt::format("{}>\n      <error type=\"not judged\" message=\"{}\"></error>\n    </testcase>\n", open,
                           xml(c.error, false));
    if (c.failure.empty()) return open + "/>\n";
    return fmt::format("{}>\n      <failure type=\"limit\" message=\"{}\">{}</failure>\n    </testcase>\n", open,
                       xml(c.failure, false), xml(c.details, true));
}

}  // namespace

JunitSuite check_suite(const std::string& program, const std::string& log) {
    return {fmt::format("clsurf check {} {}", file_name(program), file_name(log)), program, {}, ""};
}

std::string junit_text(const std::vector<JunitSuite>& suites) {
    const auto count = [](const JunitSuite& suite, std::string JunitCase::*kind) {
        return std::ranges::count_if(suite.cases, [&](const JunitCase& c) {
            return !(c.*kind).empty() && (kind == &JunitCase::error || c.error.empty());
        });
    };
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
    for (const JunitSuite& suite : suites) {
        text += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n",
                            xml(suite.name, false), suite.cases.size(), count(suite, &JunitCase::failure),
                            count(suite, &JunitCase::error));
        for (const JunitCase& c : suite.cases) text += case_text(suite, c);
        if (!suite.output.empty()) text += "    <system-out>" + xml(suite.output, true) + "</system-out>\n";
        text += "  </testsuite>\n";
    }
    return text + "</testsuites>\n";
}

}  // namespace clsurf::io
