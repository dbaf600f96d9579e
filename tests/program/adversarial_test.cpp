// Malicious programs: a clear error or the right result, in bounded time and memory.

#include <gtest/gtest.h>

#include "program/motion_rows.h"

namespace clsurf::adversarial_test {
namespace {

constexpr std::size_t megabytes = 1'000'000;

/// Reads to motions or an InputError, without a crash. An algorithm with quadratic time on these texts would exceed the
/// timeout of the test runner.
void read_in_every_dialect(const std::string& text) {
    for (const Dialect& dialect : dialects()) (void)error_of(text, dialect.name.data());
}

std::string repeated(std::string_view part, std::size_t count) {
    std::string text;
    text.reserve(part.size() * count);
    for (std::size_t i = 0; i < count; ++i) text += part;
    return text;
}

TEST(Adversarial, LinesOfTenMegabytes) {
    read_in_every_dialect("G1 X" + std::string(10 * megabytes, '7') + "\n");
    read_in_every_dialect("G1 X1 (" + std::string(10 * megabytes, 'c') + ")\n");
    read_in_every_dialect("G1 X1 " + repeated("7 ", 5 * megabytes) + "\n");
    read_in_every_dialect(repeated("X1 ", 3 * megabytes));
    read_in_every_dialect("#1=" + repeated("1+", 5 * megabytes) + "1\n");
    EXPECT_EQ(motions(parse("G0 X1 Y0 Z0" + std::string(10 * megabytes, ' ') + "\nX2\n", "fanuc")),
              (Rows{"rapid 1 0 0", "rapid 2 0 0"}));
    // The message shows the beginning of the line only.
    EXPECT_LT(error_of("G1 X[" + std::string(10 * megabytes, 'c') + "\n", "fanuc").size(), 10'000u);
}

TEST(Adversarial, AMillionNestedBrackets) {
    for (const char* open : {"[", "(", "-", "SIN[", "#", "#["}) {
        read_in_every_dialect("G1 X" + repeated(open, megabytes) + "1\n");
        read_in_every_dialect("#1=" + repeated(open, megabytes) + "1\n");
        read_in_every_dialect("R1=" + repeated(open, megabytes) + "1\n");
    }
    EXPECT_NE(error_of("#1=" + repeated("[", megabytes), "fanuc").find("nested too deeply"), std::string::npos);
    read_in_every_dialect(repeated("o1 if [1]\n", megabytes / 10));
}

TEST(Adversarial, AMillionCalls) {
    const std::string calls =
        "G0 X0 Y0 Z0\nG91\n#1=0\nWHILE [#1 LT 1000000] DO 1\n#1=#1+1\nM98 P7\nEND 1\nM30\nO7\nX1\nM99\n";
    const Program p = parse(calls, "fanuc");
    ASSERT_EQ(p.motions.size(), 1'000'001);
    EXPECT_DOUBLE_EQ(p.motions.end.back().x, 1e6);
    read_in_every_dialect("#1=0\n" + repeated("N1 X1\n", 100'000) + "N7 #1=#1+1\nIF [#1 LT 100000] GOTO 7\n");
}

TEST(Adversarial, ManyLoopsThatAreLeft) {
    const Program p =
        parse("G0 X0 Y0 Z0\n" + repeated("o1 repeat [2]\nG91 G0 X1\no1 break\no1 endrepeat\n", 200'000), "linuxcnc");
    EXPECT_DOUBLE_EQ(p.motions.end.back().x, 2e5);
}

TEST(Adversarial, SubprogramsOfFilesAreReadOnce) {
    int reads = 0;
    const auto text = std::make_shared<std::string>("G0 X0 Y0 Z0\nFOR R1=1 TO 1000\nPART\nENDFOR\nM30\n");
    InterpreterOptions options;
    options.dialect = find_dialect("siemens");
    options.load = [&](const std::string& name) -> std::optional<SourceText> {
        ++reads;
        if (name != "PART") return std::nullopt;
        return SourceText(name, "G91 X1\nM17\n", nullptr);
    };
    EXPECT_EQ(parse_program(SourceText("test.nc", *text, text), options).motions.size(), 1001);
    EXPECT_EQ(reads, 1);
}

TEST(Adversarial, DeepRecursionAndLoopsWithoutEnd) {
    EXPECT_NE(error_of("M98 P1\nM30\nO1\nM98 P1\nM99\n", "fanuc").find("calls itself?"), std::string::npos);
    EXPECT_NE(error_of("AGAIN: GOTOB AGAIN\n", "siemens").find("an endless loop?"), std::string::npos);
    EXPECT_NE(error_of("N1 GOTO 1\n", "fanuc").find("an endless loop?"), std::string::npos);
    EXPECT_NE(error_of("MCALL PART\nX1\nM30\nPART:\nMCALL PART\nX1\nRET\n", "siemens").find("calls itself?"),
              std::string::npos);
}

TEST(Adversarial, OtherEncodingsAndBytes) {
    using namespace std::string_literals;
    EXPECT_NE(error_of("\xff\xfeG\0\x31\0"s, "fanuc").find("is UTF-16 text"), std::string::npos);
    EXPECT_NE(error_of("\xfe\xff\0G\0\x31"s, "fanuc").find("is UTF-16 text"), std::string::npos);
    EXPECT_EQ(motions(parse("G0 X1\0\0 Y2 Z0\n\0\nX3\n"s, "fanuc")), (Rows{"rapid 1 2 0", "rapid 3 2 0"}));
    EXPECT_NE(error_of("G0 \x80X1\n", "fanuc").find("test.nc:1:4"), std::string::npos);
    read_in_every_dialect(std::string(megabytes, '\0'));
}

}  // namespace
}  // namespace clsurf::adversarial_test
