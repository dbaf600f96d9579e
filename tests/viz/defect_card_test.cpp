#include "viz/defect_card.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "viz/drawing.h"

namespace clsurf::viz::defect_card_test {
namespace {

TEST(DefectCard, TheLettersOfItsAxesStandBelowTheMapAndInThePicture) {
    constexpr int width = 800, height = 380;
    const CardMapSize size = card_map_size(width, height);
    for (double turn = 0; turn < 6.2; turn += 0.8) {
        DefectCard card;
        card.map.width = size.width;
        card.map.height = size.height;
        card.map.rgb.resize(static_cast<std::size_t>(3 * size.width * size.height));
        card.map.drawing = std::make_shared<Drawing>();
        card.bearings.mm_per_pixel = 0.01;
        card.bearings.axes = {Vec2(std::cos(turn), std::sin(turn)), Vec2(-std::sin(turn), std::cos(turn)),
                              Vec2::Zero()};
        const Image image = draw_card(card, width, height, "osmesa");
        int letters = 0;
        for (const FlatText& text : image.drawing->texts) {
            if (text.text != "X" && text.text != "Y") continue;
            ++letters;
            const Rect rect = text_rect(text);
            EXPECT_GT(rect.y, 0) << text.text << " at " << turn;
            EXPECT_LT(rect.y + rect.height, height - 0.15 * height - size.height + 1) << text.text << " at " << turn;
            EXPECT_LT(rect.x + rect.width, size.width) << text.text << " at " << turn;
        }
        EXPECT_EQ(letters, 2);
    }
}

}  // namespace
}  // namespace clsurf::viz::defect_card_test
