// SPDX-License-Identifier: MIT
// Films the demo spring_damper, whose wall, mass and curves stay beside each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/played.hpp"

namespace oiler::test {
namespace {

using nlohmann::json;

std::vector<json> pictures_of(const std::string& options) {
    const Folder folder;
    const std::string out = (folder / "film").string();
    std::istringstream lines(shell("spring_damper --headless --quiet --size 16x9 --out '" + out +
                                   "' " + options + " && gzip -dc '" + out + "/frames.jsonl.gz'")
                                 .out);
    std::vector<json> pictures;
    for (std::string line; std::getline(lines, line);)
        pictures.push_back(json::parse(line).at("picture"));
    return pictures;
}

/// The left end of a line.
double left_of(const json& line) {
    double left = INFINITY;
    for (std::size_t i = 0; i < line["points"].size(); i += 2)
        left = std::min(left, line["points"][i].get<double>());
    return left;
}

/// The only line of that width.
const json& line_of(const json& picture, const char* space, double width) {
    const auto& lines = picture.at("lines");
    return *std::ranges::find_if(
        lines, [&](const json& one) { return one["space"] == space && one["width"] == width; });
}

const char* const settings[] = {"--fps 10 --frames 40",
                                "--method explicit_euler --rate 8 --fps 4 --frames 80",
                                "--method explicit_euler --rate 1 --fps 1 --frames 50"};

TEST(SpringDamperDemo, ItsMassStaysOnOneSideOfTheWallAndInThePicture) {
    for (const char* const options : settings) {
        const std::vector<json> pictures = pictures_of(options);
        ASSERT_GE(pictures.size(), 40U);
        for (const json& picture : pictures) {
            const double wall = left_of(line_of(picture, "world", 3));
            const double exact = left_of(line_of(picture, "world", 2));
            const json& mass = picture.at("discs").at(0);
            const double half_width = picture.at("height").get<double>() * 16 / 9 / 2;
            const double x = mass["centre"][0];
            const double radius = mass["radius"];
            EXPECT_GT(wall, -half_width) << options;
            EXPECT_GT(x - radius, wall) << options;
            EXPECT_GT(exact, wall) << options;
            EXPECT_LT(x + radius, half_width) << options;
        }
    }
}

// The positions are in a box from 152 to 256 units. A curve that leaves it is cut at its edges.
TEST(SpringDamperDemo, ItsCurveStaysWithinItsPlot) {
    constexpr int part = 12;  // of the key: the simulated positions
    for (const char* const options : settings) {
        std::size_t curves = 0;
        for (const json& picture : pictures_of(options))
            for (const json& line : picture.at("lines")) {
                if (line["key"][1] != part) continue;
                ++curves;
                for (std::size_t i = 1; i < line["points"].size(); i += 2) {
                    EXPECT_GT(line["points"][i], 152) << options;
                    EXPECT_LT(line["points"][i], 256) << options;
                }
            }
        EXPECT_GE(curves, 39U) << options;
    }
}

}  // namespace
}  // namespace oiler::test
