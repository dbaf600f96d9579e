// The chart of a front: the positions of its numbers.

#include "viz/front_chart.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "viz/drawing.h"

namespace clsurf::viz::front_chart_test {
namespace {

struct Number {
    std::string text;
    Rect rect;
};

/// Texts that are row numbers: centred, with a size that no other text has.
std::vector<Number> numbers_in(const Drawing& drawing) {
    std::vector<Number> numbers;
    for (std::size_t k = 0; k < drawing.texts.size(); ++k) {
        const FlatText& text = drawing.texts[k];
        const bool digits = text.text.find_first_not_of("0123456789") == std::string::npos;
        const bool of_an_axis = text.align != Align::centre || text.size > 0.9 * 0.6 * drawing.width / 44.0;
        if (!digits || of_an_axis) continue;
        const double width = drawing.text_widths[k];
        numbers.push_back({text.text, {text.x - 0.5 * width, text.y - 0.35 * text.size, width, 0.7 * text.size}});
    }
    return numbers;
}

bool overlap(const Rect& a, const Rect& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

Image drawn(const FrontPicture& picture) {
    ChartLook look;
    look.width = 1600;
    look.height = 1100;
    look.title = "Time against surface";
    look.x_label = "Time [s]";
    look.keep_drawing = true;
    return draw_front(picture, look);
}

// Crowded in a corner, as usual in fronts.
TEST(FrontChart, NumbersDoNotLieOnEachOther) {
    std::mt19937 random(3);
    std::exponential_distribution<double> near(4);
    for (const std::size_t rows : {5U, 60U, 300U}) {
        FrontPicture picture;
        picture.reference = "as the machine file";
        for (std::size_t k = 0; k < rows; ++k)
            picture.rows.push_back(
                {30 + near(random), 100 + 1000 * near(random), 4e4 * (1 + near(random)), k % 3 != 1});
        picture.chosen = rows / 2;
        const Image image = drawn(picture);
        const std::vector<Number> numbers = numbers_in(*image.drawing);
        ASSERT_GE(numbers.size(), 4U) << rows;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_FALSE(overlap(numbers[i].rect, numbers[j].rect)) << numbers[i].text << " " << numbers[j].text;
        }
        // The chosen row and the reference have their numbers in both panels.
        for (const std::size_t row : {std::size_t{0}, *picture.chosen}) {
            EXPECT_EQ(std::ranges::count(numbers, std::to_string(row + 1), &Number::text), 2) << rows << " " << row;
        }
        for (const Number& number : numbers) {
            const std::size_t row = std::stoul(number.text) - 1;
            EXPECT_TRUE(picture.rows[row].on_front || row == 0 || row == *picture.chosen) << number.text;
        }
    }
}

// A single row, without a trade-off: still a picture.
TEST(FrontChart, OfOneRow) {
    FrontPicture picture;
    picture.reference = "the program";
    picture.rows.push_back({30, 0, 5e4, true});
    const Image image = drawn(picture);
    EXPECT_EQ(image.width, 1600);
    EXPECT_EQ(numbers_in(*image.drawing).size(), 2U);
}

}  // namespace
}  // namespace clsurf::viz::front_chart_test
