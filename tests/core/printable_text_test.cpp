#include "core/printable_text.h"

#include <gtest/gtest.h>

#include "core/diagnostic.h"

namespace clsurf::printable_text_test {
namespace {

TEST(PrintableText, KeepsTextAndShowsWhatATerminalWouldObey) {
    EXPECT_EQ(printable("G1 X1 Größe µ €"), "G1 X1 Größe µ €");
    EXPECT_EQ(printable(std::string_view("a\0b\x1b[2J\x7f\t", 9)), "a\\x00b\\x1b[2J\\x7f\\x09");
    EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b");                             // C1
    EXPECT_EQ(printable("\xff\xe2\x82"), "\\xff\\xe2\\x82");                    // no UTF-8
    EXPECT_EQ(printable("\xc0\xaf\xed\xa0\x80"), "\\xc0\\xaf\\xed\\xa0\\x80");  // overlong, a surrogate
}

TEST(PrintableText, GuardsDiagnosticsAndTheirSourceLines) {
    Diagnostic d{Severity::error, "input", Place::of_line("a\x1b.nc", 1, 4), "found '\x07'", "try \x9b"};
    d.where.source = "G1 \x1b X1\xff";
    EXPECT_EQ(to_text(d), "a\\x1b.nc:1:4: error: found '\\x07'\n    G1   X1?\n       ^\n    hint: try \\x9b\n");
}

}  // namespace
}  // namespace clsurf::printable_text_test
