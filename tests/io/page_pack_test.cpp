// Columns of a page, unpacked as in a browser (its own code is tested in tests/page).

#include "io/page/page_pack.h"

#include <zlib.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace clsurf::io::page_pack_test {
namespace {

std::string from_base64(std::string_view text) {
    std::string bytes;
    std::uint32_t bits = 0;
    int known = 0;
    for (const char c : text) {
        const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const std::size_t value = digits.find(c);
        if (value == std::string_view::npos) break;  // the padding
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        known += 6;
        if (known < 8) continue;
        known -= 8;
        bytes += static_cast<char>(bits >> known & 0xff);
    }
    return bytes;
}

std::int64_t unfold(std::uint64_t value) {
    return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

/// The same algorithm as in viz/page/src/columns.ts.
std::vector<std::int64_t> unpack_integers(const PackedColumn& packed) {
    std::string bytes(packed.count * static_cast<std::size_t>(packed.planes), '\0');
    const std::string stream = from_base64(packed.base64);
    uLongf size = static_cast<uLongf>(bytes.size());
    if (!bytes.empty() &&
        uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(stream.data()),
                   static_cast<uLong>(stream.size())) != Z_OK) {
        ADD_FAILURE() << "a packed column is damaged";
    }
    std::vector<std::int64_t> values(packed.count);
    const auto stride = static_cast<std::size_t>(packed.stride);
    for (std::size_t i = 0; i < packed.count; ++i) {
        std::uint64_t folded = 0;
        for (int plane = 0; plane < packed.planes; ++plane) {
            folded |= static_cast<std::uint64_t>(
                          static_cast<unsigned char>(bytes[static_cast<std::size_t>(plane) * packed.count + i]))
                      << (8 * plane);
        }
        const auto before = [&](std::size_t steps) { return i >= steps * stride ? values[i - steps * stride] : 0; };
        std::int64_t value = unfold(folded);
        if (packed.order == 1) value += before(1);
        if (packed.order == 2) value += 2 * before(1) - before(2);
        values[i] = value;
    }
    return values;
}

TEST(PagePack, WritesBase64AsTheStandardHasIt) {
    // RFC 4648, section 10.
    EXPECT_EQ(to_base64(""), "");
    EXPECT_EQ(to_base64("f"), "Zg==");
    EXPECT_EQ(to_base64("fo"), "Zm8=");
    EXPECT_EQ(to_base64("foo"), "Zm9v");
    EXPECT_EQ(to_base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(to_base64("\xff\xfe"), "//4=");
}

TEST(PagePack, IntegersComeBack) {
    std::mt19937_64 random(7);
    for (const int bits : {1, 8, 20, 52}) {
        for (const int stride : {1, 2, 3}) {
            std::vector<std::int64_t> values;
            for (int i = 0; i < 1000; ++i) {
                values.push_back(static_cast<std::int64_t>(random() >> (64 - bits)) * (random() % 2 == 0 ? 1 : -1));
            }
            EXPECT_EQ(unpack_integers(pack_integers(values, stride)), values) << bits << " bits, stride " << stride;
        }
    }
    EXPECT_TRUE(unpack_integers(pack_integers({})).empty());
}

TEST(PagePack, AStraightLineTakesNextToNothing) {
    std::vector<std::int64_t> values;
    for (std::int64_t i = 0; i < 100'000; ++i) values.push_back(1'000'000'000 - 37 * i);
    const PackedColumn packed = pack_integers(values);
    EXPECT_EQ(packed.order, 2);
    EXPECT_LT(packed.base64.size(), 2000U);
    EXPECT_EQ(unpack_integers(packed), values);
}

TEST(PagePack, CornersOfTrianglesAreComparedWithTheSameCornerBefore) {
    std::vector<std::int64_t> corners;
    for (std::int64_t t = 0; t < 50'000; ++t) corners.insert(corners.end(), {t, 70'000 - t, 70'001 - t});
    const PackedColumn packed = pack_integers(corners, 3);
    EXPECT_LT(packed.base64.size(), 2000U);
    EXPECT_EQ(unpack_integers(packed), corners);
}

}  // namespace
}  // namespace clsurf::io::page_pack_test
