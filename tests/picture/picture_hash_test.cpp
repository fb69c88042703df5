// SPDX-License-Identifier: MIT
#include "oiler/picture/picture.hpp"

#include <functional>

#include "oiler/core/state_hash.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Change = std::function<void(Picture&)>;

/// Two elements of each kind.
Picture picture() {
    Picture picture{.background = {1, 2, 3, 4}, .camera = {.centre = {5, 6}, .height = 7}};
    for (std::uint32_t i = 0; i < 2; ++i) {
        const auto f = static_cast<float>(i);
        picture.polylines.push_back(
            {{1 + i, 2, 3}, {{f, 1}, {2, 3}, {4, 5}}, 2, {10, 20, 30, 40}, Space::world});
        picture.discs.push_back({{4 + i, 5, 6}, {f, 2}, 3, {11, 21, 31, 41}, Space::canvas});
        picture.labels.push_back(
            {{7 + i, 8, 9}, {f, 4}, "text", 12, {12, 22, 32, 42}, Align::left});
    }
    return picture;
}

std::shared_ptr<const Bitmap> bitmap(std::uint8_t shade) {
    return make_bitmap({1, 1}, {shade, 2, 3, 4});
}

/// With two elements of the kinds that older pictures lack, too.
Picture rich_picture() {
    Picture rich = picture();
    for (std::uint32_t i = 0; i < 2; ++i) {
        const auto f = static_cast<float>(i);
        rich.sprites.push_back(
            {{11 + i, 8, 9}, {f, 4}, {2, 3}, bitmap(1), 0.5F, {13, 23, 33, 43}, Space::world});
        rich.polygons.push_back({{14 + i, 8, 9},
                                 {{f, 0}, {1, 0}, {0, 1}},
                                 {14, 24, 34, 44},
                                 1.5F,
                                 {15, 25, 35, 45},
                                 Space::canvas});
    }
    return rich;
}

/// The smallest change of a number.
void nudge(float& value) { value = std::nextafter(value, 1e9F); }

/// Changes of the fields that all kinds of elements have.
template <class Elements>
std::vector<Change> common_changes(Elements Picture::*list) {
    const auto last = [list](Picture & p) -> auto& { return (p.*list).back(); };
    std::vector<Change> changes{
        [=](Picture& p) { last(p).key.object += 1; },
        [=](Picture& p) { last(p).key.object += std::uint64_t{1} << 32; },
        [=](Picture& p) { last(p).key.part += 1; },
        [=](Picture& p) { last(p).key.jump += 1; },
        [=](Picture& p) { last(p).colour.r += 1; },
        [=](Picture& p) { last(p).colour.g += 1; },
        [=](Picture& p) { last(p).colour.b += 1; },
        [=](Picture& p) { last(p).colour.a += 1; },
        [=](Picture& p) {
            last(p).space = last(p).space == Space::world ? Space::canvas : Space::world;
        },
        [=](Picture& p) { last(p).layer = 1; },
        [=](Picture& p) { last(p).layer = -1; },
        [=](Picture& p) { (p.*list).pop_back(); },
        [=](Picture& p) { (p.*list).push_back(last(p)); },
        [=](Picture& p) { std::swap((p.*list)[0], (p.*list)[1]); },
    };
    for (const Space space : {Space::upper_left, Space::top, Space::upper_right, Space::lower_left,
                              Space::bottom, Space::lower_right})
        changes.push_back([=](Picture& p) { last(p).space = space; });
    return changes;
}

std::vector<Change> own_changes() {
    return {
        [](Picture& p) { p.background.r += 1; },
        [](Picture& p) { p.background.g += 1; },
        [](Picture& p) { p.background.b += 1; },
        [](Picture& p) { p.background.a += 1; },
        [](Picture& p) { nudge(p.camera.centre.x); },
        [](Picture& p) { nudge(p.camera.centre.y); },
        [](Picture& p) { nudge(p.camera.height); },
        [](Picture& p) { nudge(p.polylines[1].width); },
        [](Picture& p) { nudge(p.polylines[1].points[2].x); },
        [](Picture& p) { nudge(p.polylines[1].points[2].y); },
        [](Picture& p) { p.polylines[0].points.pop_back(); },
        [](Picture& p) {
            p.polylines[0].points.push_back({4, 5});
        },
        [](Picture& p) { p.polylines[0].points[0].x = -p.polylines[0].points[0].x; },
        [](Picture& p) { nudge(p.discs[1].centre.x); },
        [](Picture& p) { nudge(p.discs[1].centre.y); },
        [](Picture& p) { nudge(p.discs[1].radius); },
        [](Picture& p) { nudge(p.labels[1].at.x); },
        [](Picture& p) { nudge(p.labels[1].at.y); },
        [](Picture& p) { nudge(p.labels[1].size); },
        [](Picture& p) { p.labels[1].align = Align::centre; },
        [](Picture& p) { p.labels[1].align = Align::right; },
        [](Picture& p) { p.labels[1].text = "texT"; },
        [](Picture& p) { p.labels[1].text = "text "; },
        [](Picture& p) { p.labels[1].text.clear(); },
        [](Picture& p) { p.labels[1].size_in = Space::world; },
        [](Picture& p) { p.has_bars = true; },
        [](Picture& p) { nudge(p.sprites[1].centre.x); },
        [](Picture& p) { nudge(p.sprites[1].centre.y); },
        [](Picture& p) { nudge(p.sprites[1].size.x); },
        [](Picture& p) { nudge(p.sprites[1].size.y); },
        [](Picture& p) { nudge(p.sprites[1].angle); },
        [](Picture& p) { p.sprites[1].is_smooth = false; },
        [](Picture& p) { p.sprites[1].bitmap = bitmap(2); },
        [](Picture& p) {
            p.sprites[1].part = BitmapPart{0, 0, {1, 1}};
        },
        [](Picture& p) {
            p.sprites[1].part = BitmapPart{0, 0, {1, 2}};
        },
        [](Picture& p) { p.sprites[1].bitmap.reset(); },
        [](Picture& p) { nudge(p.polygons[1].points[2].y); },
        [](Picture& p) { p.polygons[1].points.pop_back(); },
        [](Picture& p) { nudge(p.polygons[1].outline); },
        [](Picture& p) { p.polygons[1].outline_colour.b += 1; },
    };
}

template <class More>
void append(std::vector<Change>& changes, const More& more) {
    changes.insert(changes.end(), more.begin(), more.end());
}

TEST(PictureHash, ChangesWithEachFieldOfEachElement) {
    std::vector<Change> changes = own_changes();
    append(changes, common_changes(&Picture::polylines));
    append(changes, common_changes(&Picture::discs));
    append(changes, common_changes(&Picture::labels));
    append(changes, common_changes(&Picture::sprites));
    append(changes, common_changes(&Picture::polygons));
    std::set<std::uint64_t> hashes{hash_of(rich_picture())};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Picture changed = rich_picture();
        changes[i](changed);
        EXPECT_TRUE(hashes.insert(hash_of(changed)).second) << "change " << i;
    }
}

TEST(PictureHash, OfACopyIsTheSame) { EXPECT_EQ(hash_of(rich_picture()), hash_of(rich_picture())); }

// The first points of the next line, or the first letters of the next label, are not those of this.
TEST(PictureHash, KeepsElementsApart) {
    Picture a;
    a.polylines = {{.points = {{1, 2}}}, {.points = {{3, 4}, {5, 6}}}};
    Picture b;
    b.polylines = {{.points = {{1, 2}, {3, 4}}}, {.points = {{5, 6}}}};
    EXPECT_NE(hash_of(a), hash_of(b));
    Picture c;
    c.labels = {{.text = "ab"}, {.text = "c"}};
    Picture d;
    d.labels = {{.text = "a"}, {.text = "bc"}};
    EXPECT_NE(hash_of(c), hash_of(d));
}

// Goldens of other machines have these hashes: they must depend on values only, not on padding.
TEST(PictureHash, IsThatOfItsWordsInOrder) {
    const std::uint32_t ten = 0x41200000;
    std::vector<std::uint32_t> words{0xffffffff, 0, 0, ten, 0, 0, 0, 0, 0, 0};
    StateHash blank;
    blank.add(std::as_bytes(std::span(words)));
    EXPECT_EQ(hash_of(Picture{}), blank.value());

    Picture labelled;
    labelled.labels = {{{0x100000002, 3, 4}, {10, 0}, "text", 10, {1, 2, 3, 4}, Align::right}};
    const std::uint32_t text = 0x74786574;
    words[8] = 1;
    words.insert(words.end(), {2, 1, 3, 4, 1, ten, 0, ten, 0x01020304, 2, 4, text});
    StateHash expected;
    expected.add(std::as_bytes(std::span(words)));
    EXPECT_EQ(hash_of(labelled), expected.value());
}

}  // namespace
}  // namespace oiler::test
