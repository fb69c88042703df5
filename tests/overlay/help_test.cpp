// SPDX-License-Identifier: MIT
#include "oiler/overlay/help.hpp"

#include <functional>

#include "oiler/picture/palette.hpp"
#include "oiler/picture/text.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Action fire{"fire", Key::q, Mouse::left};
constexpr Axis aim{"aim", Key::left, Key::right, Stick::left_x, ByMouse::yes};
constexpr Axis brake{"brake", Buttons{}, Buttons{}, Stick::right_trigger};
constexpr Action nothing{"nothing"};
constexpr Control controls[] = {fire, aim, brake, nothing};

std::vector<HelpRow> loop_keys() {
    return {{"F1", "inspector"},
            {"F2", "close this help"},
            {"F3", "pause, resume"},
            {"F4", "go back"},
            {"F5", "step in a pause"},
            {"F6", "errors ×10"},
            {"F7", "slower"},
            {"F8", "faster"},
            {"F9", "restart"},
            {"F11", "full screen"},
            {"Escape", "close this, then quit"}};
}

std::string on_azerty(Button button) { return button == Button(Key::q) ? "A" : name_of(button); }

bool shows(const Picture& picture, std::string_view text) {
    return std::any_of(picture.labels.begin(), picture.labels.end(),
                       [&](const Label& label) { return label.text == text; });
}

TEST(Help, ListsControlsAndKeysOverThePicture) {
    Picture picture{.background = palette::black, .labels = {{.text = "score 7", .layer = 1000}}};
    add_help(picture, OverlayArea({1280, 720}), "Cannon", controls, on_azerty, loop_keys());
    ASSERT_EQ(picture.polygons.size(), 1U);
    EXPECT_LT(picture.polygons[0].colour.g, 50) << "as dark as the game";
    EXPECT_GT(picture.polygons[0].colour.a, 192);
    EXPECT_GT(picture.polygons[0].layer, picture.labels[0].layer);
    for (std::size_t i = 1; i < picture.labels.size(); ++i)
        EXPECT_EQ(picture.labels[i].layer, picture.polygons[0].layer);
    for (const char* const text :
         {"Cannon", "fire", "A, Mouse left", "aim", "Left and Right, left stick left/right, mouse",
          "brake", "right trigger", "nothing", "no button", "F4", "go back", "Escape"})
        EXPECT_TRUE(shows(picture, text)) << text;
}

TEST(Help, ALongListOfButtonsKeepsFromTheKeysOfTheLoop) {
    const Control list[] = {Action{"menu", Pad::left_shoulder, Pad::right_shoulder,
                                   Pad::left_trigger, Pad::right_trigger, Pad::left_stick}};
    Picture picture;
    add_help(picture, OverlayArea({1280, 720}), "Menu", list, on_azerty, loop_keys());
    const auto loop = std::find_if(picture.labels.begin(), picture.labels.end(),
                                   [](const Label& label) { return label.text == "F1"; });
    for (auto label = picture.labels.begin(); label != loop; ++label)
        EXPECT_LT(label->at.x + 0.6F * label->size * static_cast<float>(label->text.size()),
                  loop->at.x)
            << label->text;
}

// 400x300: 0.625 pixels a unit, so that the canvas is 640 by 480 units, from -60 to 420.
TEST(Help, FitsASmallWindow) {
    Picture picture;
    add_help(picture, OverlayArea({400, 300}), "Cannon", controls, on_azerty, loop_keys());
    EXPECT_TRUE(shows(picture, "fire"));
    EXPECT_TRUE(std::ranges::any_of(picture.labels, [](const Label& label) {
        return label.text.find("F11 ") != std::string::npos;
    }));
    for (const Label& label : picture.labels) {
        EXPECT_GE(label.at.y, -60) << label.text;
        EXPECT_LE(label.at.y + label.size, 420) << label.text;
        EXPECT_GE(label.size * 0.625F, 10.99F) << label.text << ": fewer pixels";
        EXPECT_LE(label.at.x + 0.6F * label.size * static_cast<float>(label.text.size()), 640)
            << label.text;
    }
    std::vector<float> rows;
    for (const Label& label : picture.labels) rows.push_back(label.at.y);
    std::ranges::sort(rows, std::greater<>());
    for (std::size_t i = 1; i < rows.size(); ++i)
        EXPECT_TRUE(rows[i - 1] == rows[i] || rows[i - 1] - rows[i] >= 17.6F) << "lines touch";
}

/// The title of a help as its lines show it, from the first label to that of the first control.
std::string title_in(const Picture& picture) {
    std::string title;
    for (const Label& label : picture.labels) {
        if (label.text == "fire") break;
        title += (title.empty() ? "" : " ") + label.text;
    }
    return title;
}

// 400 pixels are 640 units at 4:3 and at 16:9.
TEST(Help, ALongTitleIsSeenWhole) {
    const std::string sentence =
        "The same force on two springs: left at resonance, right at twice that frequency – "
        "assets/scenes/drive.toml";
    for (const std::string& title : {sentence, sentence + " " + sentence, std::string(70, 'n')})
        for (const Size size : {Size{1280, 720}, {400, 300}, {640, 360}}) {
            Picture picture;
            add_help(picture, OverlayArea(size), title, controls, on_azerty, loop_keys());
            EXPECT_EQ(title_in(picture), title);
            const auto control = std::ranges::find(picture.labels, "fire", &Label::text);
            for (auto line = picture.labels.begin(); line != control; ++line) {
                EXPECT_LE(line->at.x + 1.06F * text_width(line->text, line->size), 640)
                    << size.width << ' ' << line->text;
                EXPECT_GE(line->at.y - (line + 1)->at.y, 1.2F * line->size) << "lines touch";
            }
        }
}

TEST(Help, AWindowMayBeSmallerThanALetter) {
    Picture picture;
    add_help(picture, OverlayArea({8, 6}), "Cannon", controls, on_azerty, loop_keys());
    EXPECT_TRUE(shows(picture, "Cannon"));
}

TEST(Help, ALongListFitsTheCanvas) {
    std::vector<Control> many;
    for (int i = 0; i < 40; ++i)
        many.push_back(Action{"a very long name of an action", Pad::left_shoulder,
                              Pad::right_shoulder, Pad::left_trigger, Pad::right_trigger});
    Picture picture;
    add_help(picture, OverlayArea({1280, 720}), "Many", many, on_azerty, loop_keys());
    for (const Label& label : picture.labels) {
        EXPECT_GT(label.at.y, 20);
        EXPECT_LT(label.at.y, canvas_height);
        EXPECT_LE(label.at.x + 0.6F * label.size * static_cast<float>(label.text.size()),
                  canvas_width)
            << label.text;
    }
}

}  // namespace
}  // namespace oiler::test
