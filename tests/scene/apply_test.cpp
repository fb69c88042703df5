// SPDX-License-Identifier: MIT
#include "oiler/scene/read.hpp"

#include <filesystem>
#include <regex>

#include "support/folder.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

const Stepping choice{.method = &find_method("rk4"), .rate = {120}, .precision = Precision::single};
constexpr std::string_view body = "\n[[body]]\nvelocity = [1.0]\n";

std::string applied(std::string_view text) { return apply(text, "test.toml", choice); }

std::string with_body(std::string_view scene) { return std::string(scene) + std::string(body); }

std::string with_crlf(const std::string& text) {
    return std::regex_replace(text, std::regex("\n"), "\r\n");
}

/// Compares the texts with LF and with CRLF, each with a body appended.
void expect_applied(std::string_view scene, std::string_view expected) {
    EXPECT_EQ(applied(with_body(scene)), with_body(expected));
    EXPECT_EQ(applied(with_crlf(with_body(scene))), with_crlf(with_body(expected)));
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(Apply, ReplacesValues) {
    expect_applied(
        "[scene]\naxes = 1\nrate = 100\nmethod = \"semi_implicit_euler\"\nprecision = \"double\"\n",
        "[scene]\naxes = 1\nrate = 120\nmethod = \"rk4\"\nprecision = \"float\"\n");
}

TEST(Apply, KeepsCommentsAndSpacing) {
    expect_applied(
        "# rate = 5\n\n[ scene ]\t# method = \"rk4\"\n  axes=1\n\trate\t=100\t\t# rate = 5\n"
        "# precision = 'half'\nmethod=   \"exact\"#method\nprecision = \"double\"   \n\n# "
        "[scene]\n",
        "# rate = 5\n\n[ scene ]\t# method = \"rk4\"\n  axes=1\n\trate\t=120\t\t# rate = 5\n"
        "# precision = 'half'\nmethod=   \"rk4\"#method\nprecision = \"float\"   \n\n# [scene]\n");
}

TEST(Apply, AddsLinesBelowTheLastKey) {
    expect_applied(
        "[scene]\naxes = 1 # one\n\n# The body:\n",
        "[scene]\naxes = 1 # one\nrate = 120\nmethod = \"rk4\"\nprecision = \"float\"\n\n"
        "# The body:\n");
    expect_applied(
        "[scene]\nrate = 100\n  axes = 1\n",
        "[scene]\nrate = 120\n  axes = 1\n  method = \"rk4\"\n  precision = \"float\"\n");
    expect_applied("[scene]\naxes = 1\ntitle = \"\"\"\\\nrate = 1\\\nand so on\"\"\"\n",
                   "[scene]\naxes = 1\ntitle = \"\"\"\\\nrate = 1\\\nand so on\"\"\"\nrate = 120\n"
                   "method = \"rk4\"\nprecision = \"float\"\n");
}

TEST(Apply, AddsLinesAfterALastLineWithoutEnd) {
    const std::string text = "[[body]]\nvelocity = [1.0]\n[scene]\naxes = 1";
    const std::string expected = text + "\nrate = 120\nmethod = \"rk4\"\nprecision = \"float\"";
    EXPECT_EQ(applied(text), expected);
    EXPECT_EQ(applied(with_crlf(text)), with_crlf(expected));
    EXPECT_EQ(applied(text + " # one"),
              std::regex_replace(expected, std::regex("axes = 1"), "axes = 1 # one"));
}

TEST(Apply, WritesDottedKeys) {
    expect_applied("scene.axes = 1\nscene.rate = 100 # rate\ncamera.height = 5.0\n",
                   "scene.axes = 1\nscene.rate = 120 # rate\nscene.method = \"rk4\"\n"
                   "scene.precision = \"float\"\ncamera.height = 5.0\n");
    expect_applied("'scene' . \"method\" = 'exact'\n\"scene\" . 'axes' = 1\n",
                   "'scene' . \"method\" = 'rk4'\n\"scene\" . 'axes' = 1\n\"scene\" . rate = 120\n"
                   "\"scene\" . precision = \"float\"\n");
}

TEST(Apply, WritesInlineTables) {
    expect_applied("scene = { axes = 1, rate = 100 , method = \"exact\" } # { rate = 5 }\n",
                   "scene = { axes = 1, rate = 120 , method = \"rk4\", precision = \"float\" } "
                   "# { rate = 5 }\n");
    expect_applied("scene={axes=1}\n",
                   "scene={axes=1, rate = 120, method = \"rk4\", precision = \"float\"}\n");
}

TEST(Apply, ReadsAllFormsOfTomlValues) {
    expect_applied(
        "[\"scene\"]\n'axes' = 1\n\"rate\" = 1_00\n'method' = 'exact'\n"
        "\"precisio\\u006e\" = \"\"\"double\"\"\"\n",
        "[\"scene\"]\n'axes' = 1\n\"rate\" = 120\n'method' = 'rk4'\n"
        "\"precisio\\u006e\" = \"float\"\n");
    for (const std::string rate : {"0x64", "0o144", "0b1100100", "+100", "1_0_0"})
        expect_applied(
            "[scene]\nrate=" + rate + "# " + rate + "\nmethod='rk4'\nprecision='float'\naxes=1\n",
            "[scene]\nrate=120# " + rate + "\nmethod='rk4'\nprecision='float'\naxes=1\n");
    expect_applied(
        "[scene]\nmethod = '''\nexact'''\nrate = 1\nprecision = \"dou\\u0062le\"\naxes=1\n",
        "[scene]\nmethod = 'rk4'\nrate = 120\nprecision = \"float\"\naxes=1\n");
}

TEST(Apply, IgnoresKeysInStringsAndComments) {
    expect_applied(
        "[camera]\nheight = 5.0\n[scene]\naxes = 1\nprecision = 'double'\n"
        "title = '[scene] method = \"exact\" rate = 5 # \\u00e9'\nmethod = \"exact\"\n"
        "rate = 100\n",
        "[camera]\nheight = 5.0\n[scene]\naxes = 1\nprecision = 'float'\n"
        "title = '[scene] method = \"exact\" rate = 5 # \\u00e9'\nmethod = \"rk4\"\n"
        "rate = 120\n");
    expect_applied(
        "[scene]\naxes = 1\ntitle = \"\"\"\\\n  [scene]\\\nrate = 5 \\u00e9\"\"\"\nrate = 6\n"
        "method = \"rk4\"\nprecision = \"float\"\n",
        "[scene]\naxes = 1\ntitle = \"\"\"\\\n  [scene]\\\nrate = 5 \\u00e9\"\"\"\nrate = 120\n"
        "method = \"rk4\"\nprecision = \"float\"\n");
}

TEST(Apply, KeepsEqualValuesAsTheyAreWritten) {
    const std::string same = with_body(
        "[scene]\nmethod='''rk4'''\nprecision = \"\\u0066loat\"\naxes = 1\nrate = 0x78 # fast\n");
    EXPECT_EQ(applied(same), same);
    const std::string once = applied(with_body("scene = { axes = 1 }\n"));
    EXPECT_EQ(applied(once), once);
}

TEST(Apply, KeepsMixedLineEnds) {
    EXPECT_EQ(applied("[scene]\r\naxes = 1\n\r\n[[body]]\r\n"),
              "[scene]\r\naxes = 1\nrate = 120\nmethod = \"rk4\"\nprecision = \"float\"\n\r\n"
              "[[body]]\r\n");
    EXPECT_EQ(applied("[scene]\naxes = 1\r\n[[body]]\n"),
              "[scene]\naxes = 1\r\nrate = 120\r\nmethod = \"rk4\"\r\nprecision = \"float\"\r\n"
              "[[body]]\n");
}

/// Replaces the value of rate, method or precision in a line.
std::string changed(const std::string& line) {
    const std::string rate = std::regex_replace(line, std::regex("^rate = \\d+"), "rate = 120");
    const std::string method =
        std::regex_replace(rate, std::regex("^method = \"\\w+\""), "method = \"rk4\"");
    return std::regex_replace(method, std::regex("^precision = \"\\w+\""), "precision = \"float\"");
}

TEST(Apply, ChangesNothingElseInTheScenesOfTheRepository) {
    std::size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator(OILER_SOURCE "/assets/scenes")) {
        if (file.path().extension() != ".toml") continue;
        const std::string text = text_of(file.path());
        std::vector<std::string> expected = lines_of(text);
        std::ranges::transform(expected, expected.begin(), changed);
        if (text.find("\nprecision = ") == std::string::npos) {
            const auto last = std::ranges::find_if(
                expected, [](const std::string& line) { return line.starts_with("duration = "); });
            expected.insert(last + 1, "precision = \"float\"");
        }
        EXPECT_EQ(lines_of(applied(text)), expected) << file.path();
        const Scene scene = parse_scene(applied(text), file.path().string());
        EXPECT_EQ(scene.stepping.method, choice.method);
        EXPECT_EQ(scene.stepping.rate.steps, 120);
        EXPECT_EQ(scene.stepping.precision, Precision::single);
        ++count;
    }
    EXPECT_GE(count, 10U);
}

TEST(Apply, RefusesInvalidScenes) {
    for (const std::string_view text :
         {"", "[scene", "[scene]\naxes = 1\n", "[gravity]\nacceleration = [1.0]\n[[body]]\n",
          "scene.axes = 1\n[scene]\nrate = 5\n[[body]]\n"}) {
        const std::string line = line_of_error(Exit::usage, [&] { (void)applied(text); });
        EXPECT_TRUE(line.starts_with("test.toml:")) << line;
    }
}

TEST(Apply, RefusesSettingsThatDoNotSuitTheScene) {
    const std::string text = with_body("[scene]\naxes = 1\n");
    EXPECT_THROW((void)apply(text, "test.toml", {.method = &find_method("rk4"), .rate = {0}}),
                 Error);
    const Stepping exact{.method = &find_method("exact"), .rate = {100}};
    const std::string_view attractor = "[[attractor]]\nposition = [5.0]\ngm = 1.0\n";
    EXPECT_NO_THROW((void)apply(text, "test.toml", exact));
    EXPECT_THROW((void)apply(text + std::string(attractor), "test.toml", exact), Error);
}

}  // namespace
}  // namespace oiler::test
