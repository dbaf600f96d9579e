#include "io/readers/measured_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace clsurf::io::measured_file_test {
namespace {

Source source_of(std::string text) {
    const auto kept = std::make_shared<std::string>(std::move(text));
    return {"m.csv", std::as_bytes(std::span(kept->data(), kept->size())), kept};
}

/// The message about an unreadable text, with its place.
std::string complaint(const std::string& text, const MeasuredColumns& columns = {}) {
    try {
        (void)read_measured(source_of(text), columns);
    } catch (const InputError& error) { return to_text(error.diagnostic()); }
    return "";
}

TEST(MeasuredFile, AProfileWithUnits) {
    const MeasuredData data = read_measured(source_of("x [mm],z [µm]\n0.2,4\n0,2\n0.1,-3\n"));
    EXPECT_EQ(data.kind, MeasuredKind::profile);
    ASSERT_EQ(data.points.size(), 3U);
    EXPECT_EQ(data.points[0], Vec3(0, 0, 0.002)) << "in rising x";
    EXPECT_EQ(data.points[2], Vec3(0.2, 0, 0.004));
}

TEST(MeasuredFile, MicrometresInLatin1) {
    const MeasuredData data = read_measured(source_of("Weg (mm);H\xf6he [\xb5m]\r\n0;4\r\n1;5\r\n2;6\r\n"), {"0", "1"});
    ASSERT_EQ(data.points.size(), 3U);
    EXPECT_EQ(data.points[2], Vec3(2, 0, 0.006));
}

TEST(MeasuredFile, LinesThatEndWithCarriageReturnsAlone) {
    const MeasuredData data = read_measured(source_of("x,z\r0,1\r1,2\r2,3\r"));
    ASSERT_EQ(data.points.size(), 3U);
    EXPECT_EQ(data.points[2], Vec3(2, 0, 3));
    const std::string wrong = complaint("x,z\r0,1\r1,a\r2,3\r");
    EXPECT_TRUE(wrong.starts_with("m.csv:3: error: 'a' in column 'z' is not a number")) << wrong;
}

TEST(MeasuredFile, NamesFewOfManyColumns) {
    std::string text = "a0";
    for (int k = 1; k < 1000; ++k) text += ",a" + std::to_string(k);
    const std::string hint = complaint(text + "\n");
    EXPECT_NE(hint.find("a11 and 988 more; choose"), std::string::npos) << hint;
}

TEST(MeasuredFile, UnitsInALineOfTheirOwnAndDecimalCommas) {
    const MeasuredData data = read_measured(source_of("X;Height\nmm;nm\n0,5;1000\n1,5;2000\n2,5;\n3,5;500\n"));
    ASSERT_EQ(data.points.size(), 3U);
    EXPECT_EQ(data.points[1], Vec3(1.5, 0, 0.002));
    EXPECT_EQ(data.missing, 1U);
}

TEST(MeasuredFile, PointsWithoutNames) {
    const MeasuredData data = read_measured(source_of("# touched on Monday\n1 2 3\n4 5 6\n7 8 9\n"));
    EXPECT_EQ(data.kind, MeasuredKind::points);
    EXPECT_EQ(data.points[1], Vec3(4, 5, 6));
}

TEST(MeasuredFile, ChosenColumns) {
    const std::string text = "n,way,dev (um),z\n1,0,10,7\n2,1,20,7\n3,2,30,7\n";
    EXPECT_EQ(read_measured(source_of(text), {"way", "dev"}).points[2], Vec3(2, 0, 0.03));
    EXPECT_EQ(read_measured(source_of(text), {"1", "0", "2"}).points[2], Vec3(2, 3, 0.03));
    EXPECT_NE(complaint(text, {"way", "depth"}).find("m.csv:1: error: has no column 'depth'"), std::string::npos)
        << complaint(text, {"way", "depth"});
}

TEST(MeasuredFile, SaysWhatIsWrongAndWhere) {
    EXPECT_NE(complaint("x,z\n0,1\n1,abc\n2,3\n").find("m.csv:3: error: 'abc' in column 'z' is not a number"),
              std::string::npos);
    EXPECT_NE(complaint("x,z\n0,1\n1\n2,3\n").find("m.csv:3: error: has 1 fields: column 'z' is missing"),
              std::string::npos);
    EXPECT_NE(complaint("x [mm],z [V]\n0,1\n1,2\n2,3\n").find("the unit 'V' of column 'z' is not a length"),
              std::string::npos);
    EXPECT_NE(complaint("x,depth\n0,1\n1,2\n2,3\n").find("no columns are named x and z"), std::string::npos);
    EXPECT_NE(complaint("x,z\n0,1\n1,2\n").find("holds 2 measured places"), std::string::npos);
}

constexpr const char* small_map =
    "aISO-1.0\r\nManufacID = NIST\r\nCreateDate = 010120260000\r\nModDate = 010120260000\r\nNumPoints = 3\r\n"
    "NumProfiles = 2\r\nXscale = 1.0e-6\r\nYscale = 2.0e-6\r\nZscale = 1.0e-9\r\nZresolution = -1\r\nCompression = 0\r\n"
    "DataType = 6\r\nCheckType = 0\r\n*\r\n1 2 BAD\r\n-4 5 6\r\n*\r\n*\r\n";

TEST(SurfaceDataFile, Text) {
    const MeasuredData map = read_measured(source_of(small_map));
    EXPECT_EQ(map.kind, MeasuredKind::areal);
    EXPECT_EQ(map.columns, 3);
    EXPECT_EQ(map.rows, 2);
    EXPECT_EQ(map.missing, 1U);
    EXPECT_TRUE(std::isnan(map.points[2].z()));
    EXPECT_NEAR((map.points[3] - Vec3(0, 0.002, -4e-6)).norm(), 0, 1e-15);
}

/// A binary map of two by two, its values as bytes.
template <typename Value>
std::string binary_map(const char* magic, unsigned char type, const std::vector<Value>& values) {
    std::string bytes = std::string(magic) + std::string(34, ' ');
    const auto put = [&](auto value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        bytes.append(raw, sizeof value);
    };
    if (magic[5] == '2') {
        put(std::uint32_t{2});
        put(std::uint32_t{2});
    } else {
        put(std::uint16_t{2});
        put(std::uint16_t{2});
    }
    for (const double scale : {1e-6, 3e-6, 1e-9, -1.0}) put(scale);
    bytes += std::string{'\0', static_cast<char>(type), '\0'};
    for (const Value value : values) put(value);
    return bytes;
}

TEST(SurfaceDataFile, Binary) {
    const std::int32_t bad = std::numeric_limits<std::int32_t>::min();
    const MeasuredData map = read_measured(source_of(binary_map<std::int32_t>("bISO-1.0", 6, {7, bad, -9, 11})));
    EXPECT_EQ(map.missing, 1U);
    EXPECT_NEAR((map.points[2] - Vec3(0, 0.003, -9e-6)).norm(), 0, 1e-15);
    const MeasuredData wide = read_measured(source_of(binary_map<double>("bISO-2.0", 7, {7, 8, 9, 10.5})));
    EXPECT_NEAR(wide.points[3].z(), 10.5e-6, 1e-15);
}

TEST(SurfaceDataFile, TextAsOtherProgramsWriteIt) {
    const std::string text =
        "aBCR-1.0\nManuFacID = Softgauges\nNUMPOINTS=3 ; columns\nnumprofiles = 2\nXscale = 1,0E-6\nYSCALE = 2,0E-6\n"
        "Zscale = 1,0E-6\n; a comment of its own\n*\n 1,5\t-2,5  nan ; three heights\n\n3 bad 4,25\n*\nOperator = A\n";
    const MeasuredData map = read_measured(source_of(text));
    ASSERT_EQ(map.points.size(), 6U);
    EXPECT_EQ(map.missing, 2U);
    EXPECT_NEAR(map.points[1].z(), -2.5e-3, 1e-15);
    EXPECT_NEAR(map.points[5].z(), 4.25e-3, 1e-15);
    EXPECT_NEAR(map.spacing.y(), 2e-3, 1e-15);
}

TEST(SurfaceDataFile, EveryVariantOfAnIndependentWriter) {
    const test::TemporaryFolder folder;
    const std::string path = std::filesystem::path(folder.write("expected.txt", "")).parent_path();
    ASSERT_EQ(std::system(("python3 " TEST_SOURCES "/io/make_surface_data.py " + path).c_str()), 0);
    std::ifstream expected(path + "/expected.txt");
    std::string name;
    std::int64_t columns = 0;
    std::int64_t rows = 0;
    std::size_t missing = 0;
    double sum = 0;
    double moment = 0;
    int files = 0;
    while (expected >> name >> columns >> rows >> missing >> sum >> moment) {
        SCOPED_TRACE(name);
        const MeasuredData map = read_measured(path + "/" + name + ".sdf", MeasuredColumns());
        EXPECT_EQ(map.columns, columns);
        EXPECT_EQ(map.rows, rows);
        EXPECT_EQ(map.missing, missing);
        EXPECT_NEAR(map.spacing.x(), 2.5e-3, 1e-15);
        EXPECT_NEAR(map.spacing.y(), 4e-3, 1e-15);
        double read_sum = 0;
        double read_moment = 0;
        for (std::size_t k = 0; k < map.points.size(); ++k) {
            const double z = map.points[k].z();
            if (!std::isfinite(z)) continue;
            read_sum += z;
            read_moment += static_cast<double>(k) * z;
        }
        EXPECT_NEAR(read_sum, sum, 1e-12);
        EXPECT_NEAR(read_moment, moment, 1e-11);
        ++files;
    }
    EXPECT_EQ(files, 59);
}

TEST(SurfaceDataFile, AProfile) {
    const std::string text =
        "aNPL-V1.0\nNumPoints = 5\nNumProfiles = 1\nXscale = 2.5E-07\nYscale = 0\nZscale = 1E-06\nDataType = 7\n*\n"
        "-0.25\n0.5\nBAD\n1\n2\n*\n*\n";
    const MeasuredData profile = read_measured(source_of(text));
    EXPECT_EQ(profile.kind, MeasuredKind::profile);
    ASSERT_EQ(profile.points.size(), 4U) << "what was not measured is left out";
    EXPECT_EQ(profile.missing, 1U);
    EXPECT_NEAR((profile.points[2] - Vec3(0.75e-3, 0, 1e-3)).norm(), 0, 1e-15);
}

TEST(SurfaceDataFile, LacksWhatItMustSay) {
    std::string text = small_map;
    text.replace(text.find("Zscale"), 6, "Wscale");
    EXPECT_NE(complaint(text).find("the header lacks Zscale"), std::string::npos) << complaint(text);
}

TEST(SurfaceDataFile, SaysWhatIsWrong) {
    std::string cut = small_map;
    cut.resize(cut.find("-4"));
    EXPECT_NE(complaint(cut).find("is cut: 3 of 6 heights are there"), std::string::npos) << complaint(cut);
    std::string bad = small_map;
    bad.replace(bad.find("-4"), 2, "-x");
    EXPECT_NE(complaint(bad).find("m.csv:16: error: the height '-x' is not a number"), std::string::npos)
        << complaint(bad);
    std::string squeezed = small_map;
    squeezed.replace(squeezed.find("Compression = 0"), 15, "Compression = 1");
    EXPECT_NE(complaint(squeezed).find("is compressed"), std::string::npos);
    const std::string half = binary_map<double>("bISO-1.0", 7, {1, 2, 3});
    EXPECT_NE(complaint(half).find("is cut: 2 × 2 heights do not fit into it"), std::string::npos) << complaint(half);
    EXPECT_NE(complaint(half.substr(0, 60)).find("byte 54: error: the header is cut"), std::string::npos)
        << complaint(half.substr(0, 60));
}

}  // namespace
}  // namespace clsurf::io::measured_file_test
