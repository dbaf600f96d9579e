// Control statements: what their lines say, and which of them belong together.
#include "program/text/control.h"

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "program/dialects/known_dialects.h"
#include "program/interpret/dialect_rules.h"
#include "program/motion_rows.h"

namespace clsurf::control_test {
namespace {

const TextRules& linuxcnc() { return linuxcnc_dialect.rules->text; }
const TextRules& fanuc() { return fanuc_dialect.rules->text; }
const TextRules& siemens() { return siemens_dialect.rules->text; }

ControlIndex index_of(const std::string& text, const TextRules& rules) {
    const auto kept = std::make_shared<std::string>(text);
    return {SourceText("test.nc", *kept, kept), rules};
}

/// Partners of all statements, in the order of their lines.
std::vector<int> partners(const ControlIndex& index) {
    std::vector<int> all;
    for (const Control& control : index.all()) all.push_back(control.partner);
    return all;
}

ReadError error_in(const char* statement, const TextRules& rules) {
    try {
        (void)parse_control(statement, rules);
    } catch (const ReadError& error) { return error; }
    return {};
}

TEST(ParseControl, ReadsTargetsOfJumps) {
    // 0123456789012345678: the target begins after GOTO.
    const Control jump = parse_control("IF [#1 GT 2] GOTO 050", fanuc());
    EXPECT_EQ(jump.kind, ControlKind::if_go_to);
    EXPECT_EQ(jump.label, "50");
    EXPECT_EQ(jump.rest, 2U);
    EXPECT_EQ(jump.target, 17U);
    EXPECT_EQ(parse_control("GOTO7", fanuc()).label, "7");
    EXPECT_EQ(parse_control("GOTO #1", fanuc()).label, "") << "known when it is executed";
    EXPECT_EQ(parse_control("O0100", fanuc()).label, "100");
    EXPECT_EQ(parse_control("G1 X1", fanuc()).kind, ControlKind::none);

    const Control forward = parse_control("GOTOF END_1", siemens());
    EXPECT_EQ(forward.kind, ControlKind::go_to);
    EXPECT_EQ(forward.label, "END_1");
    EXPECT_EQ(forward.direction, 1);
    EXPECT_FALSE(forward.may_miss);
    const Control back = parse_control("IF R1>2 GOTOB AGAIN", siemens());
    EXPECT_EQ(back.kind, ControlKind::if_go_to);
    EXPECT_EQ(back.label, "AGAIN");
    EXPECT_EQ(back.direction, -1);
    EXPECT_TRUE(parse_control("GOTOC END_1", siemens()).may_miss);
    const Control label = parse_control("START: G1 X1", siemens());
    EXPECT_EQ(label.kind, ControlKind::label);
    EXPECT_EQ(label.label, "START");
    EXPECT_EQ(label.rest, 6U);
}

TEST(ParseControl, SaysWhereAStatementIsWrong) {
    EXPECT_EQ(error_in("IF [#1 GT 2] X1", fanuc()).column, 3U) << "after IF";
    EXPECT_EQ(error_in("WHILE [#1 GT 2]", fanuc()).column, 6U) << "after WHILE";
    EXPECT_EQ(error_in("O1 WILE [1]", linuxcnc()).column, 4U) << "at the unknown word";
    EXPECT_EQ(error_in("O<part WHILE [1]", linuxcnc()).column, 3U) << "after '<'";
    EXPECT_NE(error_of("G1 X1 F60\nIF [1 EQ 1] X2\n", "fanuc").find("test.nc:2:3: error: expected GOTO or THEN"),
              std::string::npos);
    // A line that is never executed is no error, and no statement.
    const ControlIndex index = index_of("IF [1] X1\nGOTO 5\n", fanuc());
    ASSERT_EQ(index.all().size(), 1U);
    EXPECT_EQ(index.all()[0].line, 2U);
}

TEST(ControlIndex, MatchesNestedStatements) {
    const ControlIndex index = index_of(
        "o1 while [#1 LT 3]\n(0 in line 1)\no2 if [1]\nG1 X1\no3 if [0]\no3 else\no3 endif\no1 continue\n"
        "o2 elseif [0]\no2 endif\no1 endwhile\n",
        linuxcnc());
    const std::vector<Control>& all = index.all();
    ASSERT_EQ(all.size(), 9U);
    // 0 while, 1 if, 2 if, 3 else, 4 endif, 5 continue, 6 elseif, 7 endif, 8 endwhile
    EXPECT_EQ(all[0].partner, 8);
    EXPECT_EQ(all[8].partner, 0);
    EXPECT_EQ(all[1].partner, 7);
    EXPECT_EQ(all[1].next_branch, 6);
    EXPECT_EQ(all[6].next_branch, 7);
    EXPECT_EQ(all[6].partner, 7) << "a branch that ends goes on after endif";
    EXPECT_EQ(all[2].partner, 4);
    EXPECT_EQ(all[2].next_branch, 3);
    EXPECT_EQ(all[3].partner, 4);
    EXPECT_EQ(all[5].partner, 0);
    EXPECT_EQ(index.at_line(3), 1);
    EXPECT_EQ(index.at_line(4), -1) << "a motion";
    EXPECT_EQ(index.at_line(11), 8);
    EXPECT_EQ(index.at_line(12), -1) << "after the end";
}

TEST(ControlIndex, TakesWhileAsTheEndOfADoOfItsLabelOnly) {
    const ControlIndex index = index_of("o1 do\no2 while [1]\no2 endwhile\no1 while [0]\n", linuxcnc());
    EXPECT_EQ(partners(index), (std::vector<int>{3, 2, 1, 0}));
    EXPECT_EQ(index.all()[1].kind, ControlKind::while_begin);
    EXPECT_EQ(index.all()[3].kind, ControlKind::do_while);
}

TEST(ControlIndex, LeavesStatementsWithoutTheirEndAlone) {
    EXPECT_EQ(partners(index_of("o1 while [1]\no2 repeat [2]\no1 endwhile\n", linuxcnc())),
              (std::vector<int>{2, -1, 0}));
    EXPECT_EQ(partners(index_of("o1 endif\no2 else\no3 break\no4 endwhile\n", linuxcnc())),
              (std::vector<int>{-1, -1, -1, -1}));
    // END 1 closes DO 2 as well: the END 2 after it has no beginning.
    EXPECT_EQ(partners(index_of("WHILE [1] DO 1\nDO 2\nEND 1\nEND 2\n", fanuc())), (std::vector<int>{2, -1, 0, -1}));
    EXPECT_EQ(partners(index_of("WHILE [1] DO 1\nDO 2\nEND 2\nEND 1\n", fanuc())), (std::vector<int>{3, 2, 1, 0}));
    EXPECT_TRUE(index_of("", fanuc()).all().empty());
    EXPECT_EQ(index_of("", fanuc()).at_line(1), -1);
}

TEST(ControlIndex, FindsTheNearestLabelInADirection) {
    const ControlIndex index = index_of("A1:\nX1\nB1:\nX2\nA1:\nX3\nX4\nA1:\n", siemens());  // A1 in lines 1, 5, 8
    const auto line = [&](LineNumber from, int direction) -> int {
        const int found = index.find(ControlKind::label, "A1", from, direction);
        return found < 0 ? -1 : static_cast<int>(index.all()[static_cast<std::size_t>(found)].line);
    };
    EXPECT_EQ(line(0, 0), 1);
    EXPECT_EQ(line(6, 1), 8);
    EXPECT_EQ(line(6, -1), 5);
    EXPECT_EQ(line(6, 0), 8);
    EXPECT_EQ(line(8, 1), -1);
    EXPECT_EQ(line(1, -1), -1);
    EXPECT_EQ(line(8, 0), 1) << "from the start";
    EXPECT_EQ(index.find(ControlKind::label, "C1"), -1);
    EXPECT_EQ(index.find(ControlKind::sub, "A1"), -1) << "a label, no subprogram";
}

}  // namespace
}  // namespace clsurf::control_test
