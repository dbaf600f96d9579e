#include "io/formats/log_format.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace clsurf::io::sinumerik_xml_test {
namespace {

Log open(const std::string& text, const LogOptions& options = {}) {
    const test::TemporaryFolder folder;
    return open_log(folder.write("trace.xml", text), options);
}

const std::string session =
    "<?xml version=\"1.0\"?>\n<traceSession version=\"2.0\">\n<traceCaptureSetup/>\n<traceData dataFrames=\"1\">\n<dataFrame>\n"
    "<frameHeader startTime=\"2022-05-02T13:56:24\" dropOuts=\"0\"/>\n"
    "<dataSignal id=\"f1\" name=\"/Nck/!SEMA/cmdContrPos [u1, 1]\" interval=\"0.002\"/>\n"
    "<dataSignal id=\"f2\" name=\"/Nck/!SD/nckServoDataActPos1stEnc64 [u1, 2]\" interval=\"0.002\"/>\n"
    "<dataSignal id=\"f3\" name=\"/Nck/!SD/nckServoDataContDev64 [u1, 2]\" interval=\"0.002\"/>\n"
    "<rec time=\"0.000\" f1=\"1.5\" f2=\"9218868437227405312\" f3=\"0\"/>\n"
    "<rec time=\"0.002\" f2=\"2.5\"/>\n"
    "<rec time=\"0.004\" f1=\"1.75\"/>\n"
    "</dataFrame></traceData></traceSession>\n";

TEST(SinumerikXml, HoldsWhatIsNotRepeated) {
    const Log log = open(session);
    EXPECT_EQ(log.format, "sinumerik-xml");
    EXPECT_EQ(log.records, 3);
    EXPECT_DOUBLE_EQ(log.period, 0.002);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(1), 1.5);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(2), 1.75);
    EXPECT_TRUE(std::isnan(log.find("fb.y")->values.at(0))) << "not measured";
    EXPECT_DOUBLE_EQ(log.find("fb.y")->values.at(2), 2.5);
    EXPECT_NE(log.find("/Nck/!SD/nckServoDataContDev64 [u1, 2]"), nullptr);
    EXPECT_EQ(log.diagnostics.count("log.axes"), 1u);
}

TEST(SinumerikXml, TakesAMappingForOtherAxes) {
    const test::TemporaryFolder folder;
    LogOptions options;
    options.mapping =
        folder.write("m.toml", "[[column]]\nfrom = \"/Nck/!SEMA/cmdContrPos [u1, 1]\"\nname = \"cmd.z\"\n");
    const Log log = open_log(folder.write("trace.xml", session), options);
    EXPECT_DOUBLE_EQ(log.find("cmd.z")->values.at(2), 1.75);
    EXPECT_EQ(log.diagnostics.count("log.axes"), 0u);
}

TEST(SinumerikXml, JoinsFrames) {
    const Log log = open(
        "<traceSession><traceData><dataFrame><dataSignal id=\"f1\" name=\"a\" interval=\"0.002\"/><rec time=\"0\" f1=\"1\"/><rec time=\"0.002\"/></dataFrame>"
        "<dataFrame><dataSignal id=\"f1\" name=\"a\"/><rec time=\"0\" f1=\"2\"/></dataFrame></traceData></traceSession>");
    EXPECT_EQ(log.records, 3);
    EXPECT_DOUBLE_EQ(log.time_of(2), 0.004);
    EXPECT_EQ(log.diagnostics.count("log.frames"), 1u);
}

TEST(SinumerikXml, ReadsACutTraceAsFarAsItGoes) {
    const Log log = open(session.substr(0, session.find("<rec time=\"0.004\"") + 10));
    EXPECT_EQ(log.records, 2);
    EXPECT_FALSE(log.closed);
    ASSERT_EQ(log.diagnostics.count("log.unclosed"), 1u);
}

TEST(SinumerikXml, NamesThePlaceOfWhatIsWrong) {
    struct Case {
        const char* text;
        std::uint64_t line;
        const char* what;
    };
    for (const Case& c : {Case{"<traceSession>\n<rec time=\"1\" f9=\"1\"/>", 2, "which no dataSignal names"},
                          Case{"<traceSession>\n<dataSignal id=\"f1\"/>\n<dataSignal id=\"f1\"/>", 3, "appears twice"},
                          Case{"<traceSession>\n<a></b>\n", 2, "mismatched tag"},
                          Case{"<!DOCTYPE x [\n<!ENTITY a \"b\">]><traceSession/>", 2, "declares an XML entity"},
                          Case{"<other><traceSession/></other>", 1, "expected 'traceSession'"}}) {
        try {
            (void)open(c.text);
            FAIL() << c.text;
        } catch (const InputError& error) {
            EXPECT_EQ(error.diagnostic().where.number, c.line) << c.text;
            EXPECT_NE(std::string(error.what()).find(c.what), std::string::npos) << error.what();
        }
    }
}

TEST(SinumerikXml, RefusesMoreSignalsThanATraceHas) {
    std::string text = "<traceSession>";
    for (int i = 0; i < 300; ++i) text += "<dataSignal id=\"f" + std::to_string(i) + "\"/>";
    EXPECT_THROW((void)open(text), InputError);
}

TEST(SinumerikXml, SampleHasTheLinesThatWereRecorded) {
    const Log log = open_log(SAMPLE_LOGS "/dome_loops.trace.xml", LogOptions{});
    EXPECT_EQ(log.records, 18531);
    EXPECT_DOUBLE_EQ(log.find("line")->values.at(8999), 863);
    EXPECT_DOUBLE_EQ(log.find("fb.z")->values.at(8999), 2.126647);
}

}  // namespace
}  // namespace clsurf::io::sinumerik_xml_test
