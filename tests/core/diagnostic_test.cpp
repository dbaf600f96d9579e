#include "core/diagnostic.h"

#include <gtest/gtest.h>

namespace clsurf::diagnostic_test {
namespace {

TEST(Diagnostics, KeepsTheFirstFewOfACodeAndCountsTheRest) {
    Diagnostics all;
    for (int i = 0; i < 1000; ++i) all.add({Severity::warning, "log.gap", Place::of_point("run.biip", i), "gap", {}});
    EXPECT_EQ(all.kept().size(), Diagnostics::kept_of_a_code);
    EXPECT_EQ(all.count("log.gap"), 1000u);
    EXPECT_EQ(all.summary().back().text, "980 more of 'log.gap', 1000 in all");
}

TEST(Diagnostics, CountsASeverityWithWhatIsNotKept) {
    Diagnostics all;
    for (int i = 0; i < 118; ++i) all.add({Severity::warning, "log.time-gap", {}, "gap", {}});
    all.add({Severity::note, "log.quantum", {}, "steps", {}});
    EXPECT_EQ(all.count(Severity::warning), 118u);
    EXPECT_EQ(all.count(Severity::note), 1u);
    EXPECT_EQ(all.count(Severity::error), 0u);
}

TEST(Diagnostics, JoinsListsWithoutLosingCounts) {
    Diagnostics a;
    Diagnostics b;
    for (int i = 0; i < 30; ++i) b.add({Severity::error, "x", {}, "text", {}});
    a.append(b);
    EXPECT_EQ(a.count("x"), 30u);
    EXPECT_TRUE(a.has_errors());
}

TEST(Diagnostic, PutsTheCaretUnderTheColumn) {
    Diagnostic d{Severity::error, "program.arc", Place::of_line("part.nc", 7, 4), "wrong", {}};
    d.where.source = "G1 X1";
    EXPECT_EQ(to_text(d), "part.nc:7:4: error: wrong\n    G1 X1\n       ^\n");
}

}  // namespace
}  // namespace clsurf::diagnostic_test
