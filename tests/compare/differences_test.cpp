// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/differences.hpp"
#include "oiler/compare/captures/comparison.hpp"

#include <png.h>

#include <nlohmann/json.hpp>

#include "capture/captures.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Names = std::vector<std::string>;
using Data = nlohmann::json;

/// The pixels of a PNG file, top row first, as libpng reads them.
std::vector<std::uint8_t> pixels_of(const std::filesystem::path& path) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0) << path << image.message;
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
    return pixels;
}

class Differences : public testing::Test {
protected:
    Comparison compare(const Film& golden, const Film& actual) {
        write(golden, folder / "golden");
        write(actual, folder / "actual");
        return compare_captures(folder / "golden", folder / "actual", {});
    }
    /// Two frames of two pixels; the pixels of the second frame differ.
    Comparison compare_two_frames() {
        Film golden = film_of(2);
        golden.header.size = {2, 1};
        golden.shots[0].rgb = {0, 0, 0, 0, 0, 0};
        golden.shots[1].rgb = {10, 20, 30, 40, 50, 60};
        Film actual = golden;
        actual.shots[1].rgb = {11, 18, 30, 60, 50, 0};
        return compare(golden, actual);
    }
    /// The data of the page, up to the end of its script.
    Data data_of_page() {
        const std::string page = text_of(folder / "out/index.html");
        const std::size_t start = page.find("const data = ") + 13;
        const std::size_t end = page.find("\n", start);
        std::string data = page.substr(start, end - start);
        data.resize(data.find_last_of('}') + 1);
        return Data::parse(data);
    }
    Folder folder;
};

// Sixteen times the difference, up to 255.
TEST_F(Differences, ImagesShowBothFramesAndTheirDifference) {
    write_differences(compare_two_frames(), folder / "out");
    EXPECT_EQ(names_in(folder / "out"), (Names{"actual_000001.png", "difference_000001.png",
                                               "expected_000001.png", "index.html"}));
    using Pixels = std::vector<std::uint8_t>;
    EXPECT_EQ(pixels_of(folder / "out/expected_000001.png"), (Pixels{10, 20, 30, 40, 50, 60}));
    EXPECT_EQ(pixels_of(folder / "out/actual_000001.png"), (Pixels{11, 18, 30, 60, 50, 0}));
    EXPECT_EQ(pixels_of(folder / "out/difference_000001.png"), (Pixels{16, 32, 0, 255, 0, 255}));
}

TEST_F(Differences, ThePageStandsAlone) {
    write_differences(compare_two_frames(), folder / "out");
    const std::string page = text_of(folder / "out/index.html");
    for (const char* link : {"http://", "https://", "src=\"/", "@import", "@DATA@"})
        EXPECT_FALSE(holds(page, link)) << link;
    EXPECT_EQ(count_of(page, "data:image/png;base64,iVBORw0KGgo"), 3U);
}

TEST_F(Differences, APassedComparisonLeavesNoFiles) {
    write_differences(compare_two_frames(), folder / "out");
    write_differences(compare(film_of(2), film_of(2)), folder / "out");
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    write_differences(compare(film_of(2), film_of(2)), folder / "out");
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_F(Differences, OtherFilesStay) {
    write_differences(compare_two_frames(), folder / "out");
    for (const char* name : {"out/notes.txt", "out/picture.png", "out/expected.txt"})
        put(folder / name, "mine");
    write_differences(compare(film_of(2), film_of(2)), folder / "out");
    EXPECT_EQ(names_in(folder / "out"), (Names{"expected.txt", "notes.txt", "picture.png"}));
}

TEST_F(Differences, ThePageOfAnotherProgramIsNotReplaced) {
    std::filesystem::create_directory(folder / "out");
    put(folder / "out/index.html", "<!doctype html>mine");
    put(folder / "out/actual_000001.png", "mine");
    EXPECT_TRUE(holds(
        line_of_error(Exit::io, [&] { write_differences(compare_two_frames(), folder / "out"); }),
        (folder / "out/index.html").string()));
    EXPECT_EQ(text_of(folder / "out/index.html"), "<!doctype html>mine");
    EXPECT_EQ(text_of(folder / "out/actual_000001.png"), "mine");
}

TEST_F(Differences, AtMostTwentyFramesHaveImages) {
    Film actual = film_of(25);
    for (Shot& shot : actual.shots) shot.picture_hash = 1;
    write_differences(compare(film_of(25), actual), folder / "out");
    EXPECT_EQ(names_in(folder / "out").size(), 3U * 20 + 1);
    const Data data = data_of_page();
    EXPECT_EQ(data.at("frames").size(), 20U);
    EXPECT_EQ(data.at("counts").at("picture"), 25);
    EXPECT_EQ(data.at("timeline"), std::string(25, 'p'));
}

TEST_F(Differences, TheTimelineHasALetterForEachFrame) {
    Film actual = film_of(6);
    actual.shots[1].state_hash = 1;
    actual.shots[2].picture_hash = 1;
    actual.shots[3].rgb.assign(300, 200);
    actual.shots[4].rgb[0] += 2;
    actual.shots.resize(5);
    write_differences(compare(film_of(6), actual), folder / "out");
    EXPECT_EQ(data_of_page().at("timeline"), "=spx~m");
}

// The frame has no image, or one of another size: then no difference can be shown.
TEST_F(Differences, MissingImagesAreLeftOut) {
    Film actual = film_of(2);
    actual.shots[1].picture_hash = 1;
    actual.shots[1].has_png = false;
    write_differences(compare(film_of(2), actual), folder / "out");
    EXPECT_EQ(names_in(folder / "out"), (Names{"expected_000001.png", "index.html"}));
    Film larger = film_of(2);
    larger.header.size = {20, 5};
    write_differences(compare(film_of(2), larger), folder / "out");
    EXPECT_EQ(names_in(folder / "out"),
              (Names{"actual_000000.png", "actual_000001.png", "expected_000000.png",
                     "expected_000001.png", "index.html"}));
}

TEST_F(Differences, TextsCannotEndTheScript) {
    Film golden = film_of(2);
    golden.header.scene_text = "# 1\n[scene]\ntitle = \"</script><b>\"\n";
    Film actual = golden;
    actual.header.scene_text = "";
    actual.shots[0].picture_hash = 1;
    write_differences(compare(golden, actual), folder / "out");
    const std::string page = text_of(folder / "out/index.html");
    EXPECT_FALSE(holds(page, "</script><b>"));
}

// Frames 1 to 4: one of each cause but missing, of the pixels one that fails and one that does not.
TEST_F(Differences, EachFrameHasOneCauseInThePageTheTextAndJunit) {
    Film actual = film_of(5);
    actual.shots[1].state_hash = 1;
    actual.shots[2].picture_hash = 1;
    actual.shots[3].rgb.assign(300, 200);
    actual.shots[4].rgb[0] += 2;
    const Comparison comparison = compare(film_of(5), actual);
    write_differences(comparison, folder / "out");
    EXPECT_EQ(data_of_page().at("counts"), (Data{{"frames", 5},
                                                 {"equal", 1},
                                                 {"simulation", 1},
                                                 {"picture", 1},
                                                 {"pixels", 1},
                                                 {"missing", 0},
                                                 {"tolerated", 1}}));
    EXPECT_TRUE(holds(describe(comparison),
                      "5 frames: 1 equal; 1 simulation; 1 picture; 1 pixels; 1 tolerated\n"))
        << describe(comparison);
    const std::string xml = suite_of(comparison).xml();
    for (const char* cause : {"simulation", "picture", "pixels"})
        EXPECT_TRUE(holds(xml, "name=\"" + std::string(cause) + "\"><failure message=\"1 of 5 "))
            << xml;
}

TEST_F(Differences, JunitSaysHowManyFramesAreTolerated) {
    Film actual = film_of(3);
    actual.shots[1].rgb[0] += 2;
    EXPECT_TRUE(holds(suite_of(compare(film_of(3), actual)).xml(),
                      "name=\"pixels\"><system-out>1 of 3 frames differ and are tolerated<"));
}

TEST(DifferencesFolder, IsBesideTheFrames) {
    EXPECT_EQ(differences_folder("frames/spring"), "frames/spring-differences");
    EXPECT_EQ(differences_folder("frames/spring/"), "frames/spring-differences");
    EXPECT_EQ(differences_folder("spring"), "spring-differences");
    const std::filesystem::path here = std::filesystem::current_path();
    EXPECT_EQ(differences_folder("."), here.string() + "-differences");
    EXPECT_EQ(differences_folder("./"), here.string() + "-differences");
    EXPECT_EQ(differences_folder(".."), here.parent_path().string() + "-differences");
}

TEST_F(Differences, JunitHasACaseForEachCause) {
    const std::string xml = suite_of(compare_two_frames()).xml();
    EXPECT_TRUE(holds(xml, "tests=\"4\" failures=\"1\""));
    EXPECT_TRUE(
        holds(xml,
              "name=\"pixels\"><failure message=\"1 of 2 frames, the first is frame 1: "
              "2 of 2 pixels differ (100 %), by at most 60; tolerated are 1 %, by at most 2\"/>"))
        << xml;
    for (const char* passed : {"simulation", "picture", "missing"})
        EXPECT_TRUE(holds(xml, "name=\"" + std::string(passed) + "\"><system-out>"));
    EXPECT_TRUE(holds(suite_of(compare(film_of(2), film_of(2))).xml(), "failures=\"0\""));
}

}  // namespace
}  // namespace oiler::test
