#include "io/formats/program_identity.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/files/sha256.h"

namespace clsurf::io::program_identity_test {
namespace {

std::string hash_of(std::string_view text) { return sha256(std::as_bytes(std::span(text.data(), text.size()))); }

// The examples of FIPS 180-4 (NIST's csrc "Examples with Intermediate Values"), and the lengths from
// which the padding takes another block.
TEST(Sha256, HasTheValuesOfItsDefinition) {
    EXPECT_EQ(hash_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(hash_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(hash_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(hash_of(std::string(55, 'a')), "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318");
    EXPECT_EQ(hash_of(std::string(64, 'a')), "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb");
    EXPECT_EQ(hash_of(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

Source made(const std::string& name, std::string_view text) {
    return {name, std::as_bytes(std::span(text.data(), text.size())), nullptr};
}

std::string warning_of(const Source& program, const std::vector<ProgramReference>& programs) {
    Log log;
    log.name = "run.biip";
    log.programs = programs;
    Diagnostics found;
    (void)check_identity(program, log, found);
    return found.empty() ? "" : found.kept().front().text;
}

TEST(ProgramIdentity, IsQuietWhereTheProgramRanOrNothingIsKnown) {
    const Source program = made("parts/part.nc", "G1 X1\n");
    ProgramReference ran = identify(program);
    EXPECT_EQ(ran.name, "part.nc");
    EXPECT_EQ(ran.size, 6u);
    EXPECT_EQ(warning_of(program, {ran}), "");
    EXPECT_EQ(warning_of(program, {identify(made("main.nc", "M98 P1\n")), ran}), "");  // a subprogram
    for (char& c : ran.sha256) c = c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c;
    EXPECT_EQ(warning_of(program, {ran}), "");
    EXPECT_EQ(warning_of(program, {{"part.nc", "", {}}}), "");
    EXPECT_EQ(warning_of(program, {}), "");
}

TEST(ProgramIdentity, LineEndsOfAnotherSystemAreTheSameProgram) {
    const Source unix_text = made("part.nc", "G1 X1\nX2\n");
    const Source dos_text = made("part.nc", "G1 X1\r\nX2\r\n");
    EXPECT_EQ(warning_of(dos_text, {identify(unix_text)}), "");
    EXPECT_EQ(warning_of(unix_text, {identify(dos_text)}), "");
    EXPECT_NE(warning_of(made("part.nc", "G1 X1\r\nX3\r\n"), {identify(unix_text)}), "");
}

TEST(ProgramIdentity, TellsAnEditedProgramFromAnotherOne) {
    const ProgramReference ran = identify(made("part.nc", "G1 X1\n"));
    EXPECT_NE(warning_of(made("here/part.nc", "G1 X2\n"), {ran}).find("here/part.nc was edited after the run"),
              std::string::npos);
    EXPECT_NE(warning_of(made("other.nc", "G1 X2\n"), {ran}).find("other.nc is not the program"), std::string::npos);
}

TEST(ProgramIdentity, KeepsTheRestOfTheMetadata) {
    const ProgramReference ran{"part.nc", std::string(64, '0'), 6};
    EXPECT_EQ(with_programs(R"({"machine":"m","programs":[{"name":"old"}],"comment":"c"})", std::span(&ran, 1)),
              R"({"machine":"m","programs":[{"name":"part.nc","sha256":")" + std::string(64, '0') +
                  R"(","size":6}],"comment":"c"})");
    EXPECT_EQ(with_programs("", {}), R"({"programs":[]})");
}

TEST(ProgramIdentity, LeavesOutMetadataNestedTooDeep) {
    const ProgramReference program{"part.nc", "", {}};
    const auto nested = [](std::size_t levels) {
        return "{\"a\":" + std::string(levels, '[') + std::string(levels, ']') + "}";
    };
    EXPECT_NE(with_programs(nested(60), std::span(&program, 1)).find("[[["), std::string::npos);
    const std::string without = with_programs(nested(100'000), std::span(&program, 1));
    EXPECT_EQ(without.find("[[["), std::string::npos);
    EXPECT_NE(without.find("part.nc"), std::string::npos);
}

TEST(ProgramIdentity, LeavesOutMetadataOfTooManyKeys) {
    const auto with_keys = [](int keys) {
        std::string text = "{";
        for (int i = 0; i < keys; ++i) text += fmt::format("{}\"k{}\":1", i > 0 ? "," : "", i);
        return with_programs(text + "}", {});
    };
    EXPECT_NE(with_keys(10'000).find("k9999"), std::string::npos);
    EXPECT_EQ(with_keys(10'001), R"({"programs":[]})");
}

}  // namespace
}  // namespace clsurf::io::program_identity_test
