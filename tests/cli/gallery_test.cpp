// SPDX-License-Identifier: MIT
// The places of the pictures in the window of `oiler demos`, and the pictures themselves.

#include "oiler/cli/gallery.hpp"

#include "oiler/cli/demo_menu.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

namespace fs = std::filesystem;

using cli::Gallery;

bool overlap(const Gallery::Card& a, const Gallery::Card& b) {
    constexpr float rounding = 1e-3F;
    return a.low.x < b.high.x - rounding && b.low.x < a.high.x - rounding &&
           a.low.y < b.high.y - rounding && b.low.y < a.high.y - rounding;
}

TEST(Gallery, CardsAreOnTheCanvasAndApart) {
    for (const auto& [games, scenes] :
         {std::pair{2, 0}, {0, 5}, {12, 16}, {1, 1}, {13, 40}, {60, 60}}) {
        const Gallery gallery(static_cast<std::size_t>(games), static_cast<std::size_t>(scenes));
        const auto count = static_cast<std::size_t>(games + scenes);
        for (std::size_t i = 0; i < count; ++i) {
            const Gallery::Card card = gallery.card(i);
            EXPECT_GE(card.low.x, 0) << i;
            EXPECT_LE(card.high.x, canvas_width) << i;
            EXPECT_GE(card.low.y, 58) << i << ": the line of the chosen one is below";
            EXPECT_LE(card.high.y, 330) << i;
            const Point middle{(card.low.x + card.high.x) / 2, (card.low.y + card.high.y) / 2};
            EXPECT_EQ(gallery.card_at(middle), i);
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_FALSE(overlap(card, gallery.card(j))) << i << " and " << j;
        }
        EXPECT_EQ(gallery.heading(false).has_value(), games > 0);
        EXPECT_EQ(gallery.heading(true).has_value(), scenes > 0);
        EXPECT_EQ(gallery.card_at({1, 1}), std::nullopt);
    }
}

TEST(Gallery, PicturesAreAsWideAsFits) {
    EXPECT_NEAR(Gallery(2, 0).width(), (640 - 28 - 18) / 4.0, 1e-3);
    EXPECT_GT(Gallery(12, 16).width(), 70);
    EXPECT_NEAR(Gallery(12, 16).picture_height(), Gallery(12, 16).width() * 9 / 16, 1e-3);
}

// Eight columns: games 0 to 7 and 8 to 11, scenes 12 to 19 and 20 to 27.
TEST(Gallery, TheArrowsMoveFromRowToRow) {
    const Gallery gallery(12, 16);
    EXPECT_EQ(gallery.below(1), 9U);
    EXPECT_EQ(gallery.below(6), 11U) << "a shorter row";
    EXPECT_EQ(gallery.below(9), 13U) << "from the games to the scenes";
    EXPECT_EQ(gallery.below(14), 22U);
    EXPECT_EQ(gallery.below(22), 22U);
    EXPECT_EQ(gallery.above(22), 14U);
    EXPECT_EQ(gallery.above(17), 11U);
    EXPECT_EQ(gallery.above(3), 3U);
}

TEST(Gallery, EveryGameAndSceneHasASmallPicture) {
    const auto all = cli::startables_of(OILER_PROGRAMS "/oiler");
    ASSERT_GT(all.size(), 16U);
    const auto pictures = cli::load_pictures(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
        ASSERT_TRUE(pictures[i]) << all[i].picture << ": draw it with assets/pictures/menu/draw.sh";
        EXPECT_EQ(pictures[i]->size, (Size{240, 135})) << all[i].name;
        EXPECT_LT(fs::file_size(all[i].picture), 32'000U) << all[i].name;
    }
}

TEST(Gallery, APictureThatIsMissingOrBrokenIsLeftOut) {
    const auto pictures =
        cli::load_pictures({{.name = "a", .sentence = "", .picture = "/none.png"},
                            {.name = "b", .sentence = "", .picture = OILER_SOURCE "/README.md"},
                            {.name = "c", .sentence = ""}});
    EXPECT_EQ(pictures, std::vector<std::shared_ptr<const Bitmap>>(3));
}

}  // namespace
}  // namespace oiler::test
