// A dialect that is defined outside of the library: its rules are one value, and the interpreter needs nothing else.

#include <gtest/gtest.h>

#include "program/interpret/dialect_rules.h"
#include "program/interpret/interpreter_state.h"
#include "program/motion_rows.h"

namespace clsurf::own_dialect_test {
namespace {

// The language of a drilling machine: G77 moves at half the feed, M41 doubles it, "TURN" rotates the following positions by
// 90°, "; …" is a comment, "AGAIN" jumps to the label "BEGIN:" while #1 is less than 2.
constexpr auto codes = std::to_array<CodeRule>({
    {77_g,
     [](Interpreter& in, const CodeWord& word) {
         in.state_.motion = MotionMode::feed;
         if (word.block.words.given('F')) word.block.words.set('F', word.block.words.of('F') / 2, word.column);
         return true;
     }},
});
constexpr auto m_codes = std::to_array<MRule>({
    {41,
     [](Interpreter& in, int, const Block&) {
         in.state_.feed *= 2;
         return true;
     }},
});

bool turn(Interpreter& in, const Statement& statement) {
    if (statement.text != "TURN") return false;
    in.state_.frame = ProgramFrame::turned(Vec3::UnitZ(), 90, Vec3::Zero());
    return true;
}

Control read_control(std::string_view text) {
    if (text == "BEGIN:") return {.kind = ControlKind::label, .label = "BEGIN", .rest = text.size()};
    if (text.starts_with("AGAIN")) return {.kind = ControlKind::if_go_to, .label = "BEGIN", .rest = 5};
    return {};
}

const DialectRules rules{
    .text = {.round_comments = false, .control = read_control},
    .codes = codes,
    .m_codes = m_codes,
    .arc_tolerance = {.absolute = 0.01, .most = 0.1},
    .statement = turn,
};
const Dialect drill{"drill", "a drilling machine", &rules};

TEST(OwnDialect, MeansWhatItsRulesSay) {
    InterpreterOptions options;
    options.dialect = &drill;
    const std::string text =
        "G0 X0 Y0 Z0 ; (home\nG77 X10 F600\nM41 Y5\n#1=0\nBEGIN:\n#1=[#1+1]\nZ[#1]\n"
        "AGAIN [#1 LT 2]\nTURN\nG1 X20 Y0\nM30\n";
    const Program program = parse_program(SourceText("part.drl", text, nullptr), options);
    // X20 rotated by 90° is Y20; 600 mm/min halved is 5 mm/s, doubled again 10 mm/s.
    EXPECT_EQ(motions(program),
              (Rows{"rapid 0 0 0", "feed 10 0 0", "feed 10 5 0", "feed 10 5 1", "feed 10 5 2", "feed 0 20 2"}));
    EXPECT_EQ(program.motions.feed[1], 5);
    EXPECT_EQ(program.motions.feed[2], 10);
    EXPECT_TRUE(program.diagnostics.summary().empty());
}

}  // namespace
}  // namespace clsurf::own_dialect_test
