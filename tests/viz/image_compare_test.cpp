#include "viz/image_compare.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace clsurf::viz::image_compare_test {
namespace {

Image grey(std::uint8_t value) {
    Image image;
    image.width = 100;
    image.height = 50;
    image.rgb = Column<std::uint8_t>(3 * 100 * 50, value);
    return image;
}

TEST(Compare, CallsTheSameEqual) {
    const Comparison c = compare(grey(10), grey(10), {});
    EXPECT_TRUE(c.equal);
    EXPECT_EQ(c.pixels_over, 0);
}

TEST(Compare, AllowsOneStepEverywhereAndThreeStepsInOneValue) {
    EXPECT_TRUE(compare(grey(10), grey(11), {}).equal);
    Image b = grey(10);
    b.rgb[77] = 13;
    EXPECT_TRUE(compare(grey(10), b, {}).equal);
    b.rgb[77] = 14;
    const Comparison c = compare(grey(10), b, {});
    EXPECT_FALSE(c.equal);
    EXPECT_EQ(c.pixels_over, 1);
    EXPECT_NEAR(c.max_error, 4 / 255.0, 1e-6);
}

TEST(Compare, FailsWhereManyValuesAreTwoStepsOff) { EXPECT_FALSE(compare(grey(10), grey(12), {}).equal); }

TEST(Compare, BlanksTextsOfBothPictures) {
    Image a = grey(10);
    Image b = grey(10);
    // Each has a word where the other has none; one extends beyond the edge.
    a.rgb[3 * (100 * 20 + 30)] = 200;
    a.texts.push_back({28, 18, 5, 5});
    b.rgb[3 * (100 * 49 + 99)] = 200;
    b.texts.push_back({95, 45, 20, 20});
    EXPECT_FALSE(compare(a, b, {}).equal);
    blank_texts(a, b);
    EXPECT_TRUE(compare(a, b, {}).equal);
    b.rgb[3 * (100 * 30 + 60)] = 200;
    EXPECT_FALSE(compare(a, b, {}).equal) << "beside the texts everything counts";
}

TEST(Image, StandsBesideAnother) {
    Image left = grey(10);
    left.rgb[3 * (100 * 7 + 99)] = 77;
    Image right = grey(20);
    right.rgb[3 * (100 * 7 + 0)] = 88;
    right.texts.push_back({4, 5, 6, 7});
    const Image both = beside(left, right);
    EXPECT_EQ(both.width, 200);
    EXPECT_EQ(both.height, 50);
    EXPECT_EQ(both.pixel(99, 7)[0], 77);
    EXPECT_EQ(both.pixel(100, 7)[0], 88);
    EXPECT_EQ(both.pixel(199, 49)[0], 20);
    ASSERT_EQ(both.texts.size(), 1u);
    EXPECT_EQ(both.texts[0].x, 104);
}

TEST(Image, PngKeepsWhereTextsStand) {
    Image a = grey(90);
    a.texts = {{1, 2, 30, 4}, {-5, 6, 7, 8}};
    const test::TemporaryFolder folder;
    const Image back = read_image(folder.write("texts.png", encode_image(a, "test", "png")));
    ASSERT_EQ(back.texts.size(), 2u);
    EXPECT_EQ(back.texts[1].x, -5);
    EXPECT_EQ(back.texts[1].height, 8);
    EXPECT_TRUE(read_image(folder.write("none.png", encode_image(grey(90), "test", "png"))).texts.empty());
}

TEST(Compare, DifferencePictureSaysWhatItsColoursMean) {
    Image a = grey(10);
    a.rgb[0] = 200;
    const Image difference = difference_picture(a, grey(10));
    EXPECT_EQ(difference.width, 100);
    EXPECT_GT(difference.height, 60);
    EXPECT_EQ(difference.pixel(0, 0)[0], 255) << "red where they differ";
    EXPECT_EQ(difference.pixel(0, 0)[1], 0);
}

TEST(Image, ReadsBackWhatItEncoded) {
    Image a = grey(90);
    a.rgb[3 * 5 + 1] = 200;
    const std::string bytes = encode_image(a, "test", "png");
    EXPECT_EQ(bytes, encode_image(a, "test", "png"));
    EXPECT_EQ(bytes.substr(1, 3), "PNG");
    const test::TemporaryFolder folder;
    for (const char* format : {"png", "tiff"}) {
        const Image back = read_image(folder.write(format, encode_image(a, "test", format)));
        EXPECT_EQ(back.width, a.width);
        EXPECT_TRUE(std::equal(back.rgb.begin(), back.rgb.end(), a.rgb.begin(), a.rgb.end())) << format;
    }
    for (const char* format : {"jpeg", "webp"}) {
        const Image back = read_image(folder.write(format, encode_image(a, "test", format)));
        EXPECT_LT(compare(a, back, {}).mean_error, 0.01) << format;
    }
}

TEST(Image, ShrinksToTheMean) {
    Image a = grey(10);
    for (int k = 0; k < 3; ++k) a.rgb[static_cast<std::size_t>(k)] = 50;
    const Image b = shrink_from_below(a.rgb.data(), a.width, a.height, 2);
    EXPECT_EQ(b.width, 50);
    const std::uint8_t* lowest = b.pixel(0, b.height - 1);
    EXPECT_EQ(lowest[0], 20);
    EXPECT_EQ(lowest[3], 10);
}

}  // namespace
}  // namespace clsurf::viz::image_compare_test
