// Parameters of runs: kinds, ranges, units, words.

#include "history/parameter_rules.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace clsurf::parameter_rules_test {
namespace {

ParameterRules rules() {
    ParameterRules rules;
    rules.rules.push_back({"tool", ParameterKind::text, "", {}, {}, {"D6R3", "D8R1"}, true});
    rules.rules.push_back({"wear", ParameterKind::number, "mm", 0.0, 0.2, {}, false});
    rules.rules.push_back({"teeth", ParameterKind::integer, "", 1.0, {}, {}, false});
    return rules;
}

std::string message_of(std::vector<RunParameter> parameters) {
    try {
        static_cast<void>(rules().checked(std::move(parameters)));
    } catch (const UsageError& error) { return error.what(); }
    return "none";
}

TEST(ParameterRules, KeepNumbersWithoutTheirUnitInTheOrderOfNames) {
    const std::vector<RunParameter> kept = rules().checked({{"wear", "0.05 mm"}, {"tool", "D6R3"}, {"teeth", "2"}});
    EXPECT_EQ(kept, (std::vector<RunParameter>{{"teeth", "2"}, {"tool", "D6R3"}, {"wear", "0.05"}}));
}

TEST(ParameterRules, GiveNumbersTheirUnitAndReadThemAgain) {
    const std::vector<RunParameter> kept = rules().checked({{"wear", "0.05mm"}, {"tool", "D6R3"}, {"teeth", "2"}});
    const std::vector<RunParameter> shown = rules().with_units(kept);
    EXPECT_EQ(shown, (std::vector<RunParameter>{{"teeth", "2"}, {"tool", "D6R3"}, {"wear", "0.05 mm"}}));
    EXPECT_EQ(rules().checked(shown), kept);
}

TEST(ParameterRules, AreNotMissingWhileMoreFollow) {
    EXPECT_EQ(rules().checked({{"teeth", "2"}}, false).size(), 1U);
    EXPECT_THROW((void)rules().checked({{"teeth", "2"}}), UsageError);
}

TEST(ParameterRules, RefuseWhatIsOutOfThem) {
    EXPECT_EQ(message_of({{"tool", "D6R4"}}), "--param: tool=D6R4 is not one of D6R3, D8R1");
    EXPECT_EQ(message_of({{"tool", "D6R3"}, {"wear", "0.3"}}), "--param: wear=0.3 is out of range: 0 … 0.2 mm");
    EXPECT_EQ(message_of({{"tool", "D6R3"}, {"wear", "50um"}}), "--param: wear=50um is in 'um', expected mm");
    EXPECT_EQ(message_of({{"tool", "D6R3"}, {"wear", "some"}}), "--param: wear=some is not a number");
    EXPECT_EQ(message_of({{"tool", "D6R3"}, {"wear", "nan"}}), "--param: wear=nan is not a number");
    EXPECT_EQ(message_of({{"tool", "D6R3"}, {"teeth", "2.5"}}), "--param: teeth=2.5 is not a whole number");
    EXPECT_EQ(message_of({{"tool", "D6R3"}, {"teeth", "0"}}), "--param: teeth=0 is out of range: at least 1");
    EXPECT_EQ(message_of({{"tool", "D6R3"}, {"tol", "1"}}), "--param: there is no parameter 'tol'");
    EXPECT_EQ(message_of({{"wear", "0.1"}}), "the parameter 'tool' is required");
    EXPECT_EQ(message_of({{"tool", "D6R3"}, {"tool", "D8R1"}}), "--param: 'tool' is given more than once");
}

TEST(ParameterRules, NoneAllowAnything) {
    EXPECT_EQ(ParameterRules{}.checked({{"b", "2 mm"}, {"a", "x"}}),
              (std::vector<RunParameter>{{"a", "x"}, {"b", "2 mm"}}));
}

TEST(Parameter, IsANameAndAValue) {
    EXPECT_EQ(parse_parameter("tool=D6=R3"), (RunParameter{"tool", "D6=R3"}));
    for (const char* bad : {"tool", "=D6", "tool=", "1st=2", "a b=2", ""})
        EXPECT_THROW(static_cast<void>(parse_parameter(bad)), UsageError) << bad;
}

TEST(Identity, IsOfContentNotOfNames) {
    RunRecord a;
    a.program = "part.nc";
    a.program_sha256 = "p";
    a.log_sha256 = "l";
    RunRecord b = a;
    b.program = "copy.nc";
    b.worst_score = 3;
    EXPECT_EQ(identity_text(a), identity_text(b));
    b.parameters.push_back({"tool", "D6"});
    EXPECT_NE(identity_text(a), identity_text(b));
    b = a;
    b.log_sha256.clear();  // could not be read
    EXPECT_NE(identity_text(a), identity_text(b));
}

}  // namespace
}  // namespace clsurf::parameter_rules_test
