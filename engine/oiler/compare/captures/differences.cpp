// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/differences.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <vector>

#include "oiler/capture/file.hpp"
#include "oiler/capture/png.hpp"
#include "oiler/compare/captures/captured.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/markup.hpp"

extern "C" {
extern const char oiler_differences[];
extern const char oiler_differences_end[];
}

namespace oiler {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view page_name = "index.html";
constexpr std::array<std::string_view, 3> image_names{"expected", "actual", "difference"};

std::string_view page() {
    return {oiler_differences, static_cast<std::size_t>(oiler_differences_end - oiler_differences)};
}

fs::path image_path(const fs::path& folder, std::string_view name, std::int64_t index) {
    return folder / fmt::format("{}_{:06}.png", name, index);
}

bool is_our_image(std::string_view name) {
    return name.ends_with(".png") && std::ranges::any_of(image_names, [&](std::string_view image) {
               return name.starts_with(fmt::format("{}_", image));
           });
}

void remove_earlier_differences(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder / page_name, error)) return;
    if (!is_replaceable(folder / page_name, kinds::differences))
        fail(Exit::io, "{} is not a page of differences and would be lost; choose another folder",
             (folder / page_name).string());
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (is_our_image(entry.path().filename().string())) fs::remove(entry.path(), error);
    fs::remove(folder / page_name, error);
    fs::remove(folder, error);  // only if nothing else is there
}

Image difference_of(const Image& golden, const Image& actual) {
    constexpr int gain = 16;
    Image difference = golden;
    for (std::size_t i = 0; i < golden.rgb_bottom_up.size(); ++i)
        difference.rgb_bottom_up[i] = static_cast<std::uint8_t>(
            std::min(255, gain * std::abs(golden.rgb_bottom_up[i] - actual.rgb_bottom_up[i])));
    return difference;
}

/// Writes the image and returns its data URL.
std::string write_image(const Image& image, const fs::path& path) {
    const std::vector<std::byte> png = encode_png(image.size, image.rgb_bottom_up);
    write_file(path, png, kinds::png, Links::replaced);
    return data_url_of(png);
}

/// The frame for the page, with its images.
Json frame_json(const FrameComparison& frame, const Captured& golden, const Captured& actual,
                const fs::path& folder) {
    const auto read = [&](const Captured& capture) -> std::optional<Image> {
        const bool is_there = frame.index < std::int64_t(capture.manifest().frames.size());
        if (!is_there || !capture.has_image(frame.index)) return std::nullopt;
        return capture.image(frame.index);
    };
    const std::optional<Image> before = read(golden);
    const std::optional<Image> after = read(actual);
    const Size size = golden.manifest().size;
    Json json{
        {"index", frame.index},          {"tick", frame.tick},       {"time", frame.time},
        {"cause", name_of(frame.cause)}, {"text", frame.words},      {"differing", frame.differing},
        {"share", frame.share},          {"largest", frame.largest}, {"width", size.width},
        {"height", size.height},         {"expected", nullptr},      {"actual", nullptr},
        {"difference", nullptr}};
    const auto add = [&](const char* name, const Image& image) {
        json[name] = write_image(image, image_path(folder, name, frame.index));
    };
    if (before) add("expected", *before);
    if (after) add("actual", *after);
    if (before && after && before->size == after->size)
        add("difference", difference_of(*before, *after));
    return json;
}

std::string timeline_of(const Comparison& comparison) {
    constexpr std::string_view marks = "=mspx";  // in the order of Cause
    std::string timeline;
    for (const FrameComparison& frame : comparison.frames)
        timeline += frame.tolerated ? '~' : marks[static_cast<std::size_t>(frame.cause)];
    return timeline;
}

/// "; rate: 60 → 120; scene file changed, …"
std::string circumstances_of(const Comparison& comparison) {
    std::string text;
    if (!comparison.renderer.empty()) text += "; renderer differs: " + comparison.renderer;
    for (const SettingChange& change : comparison.settings)
        text += fmt::format("; {}: {} → {}", change.name, change.golden, change.actual);
    for (const std::string& finding : comparison.findings) text += "; " + finding;
    return text;
}

std::string passed_text(const Comparison& comparison, Cause cause) {
    if (cause != Cause::pixels || comparison.tolerated() == 0) return "no frame differs";
    return fmt::format("{} of {} frames differ and are tolerated", comparison.tolerated(),
                       comparison.frames.size());
}

}  // namespace

void write_differences(const Comparison& comparison, const fs::path& folder) {
    remove_earlier_differences(folder);
    if (comparison.passed()) return;
    make_folder(folder);
    const Captured golden(comparison.golden);
    const Captured actual(comparison.actual);
    Json data = to_json(comparison);
    data["timeline"] = timeline_of(comparison);
    const PixelTolerance& tolerance = comparison.tolerance;
    data["tolerance"] = {{"channel", tolerance.channel}, {"share", tolerance.share}};
    Json& frames = data["frames"] = Json::array();
    for (const FrameComparison& frame : comparison.frames)
        if (!frame.passed() && std::int64_t(frames.size()) < most_shown_frames)
            frames.push_back(frame_json(frame, golden, actual, folder));
    const std::string html = std::string(kinds::differences.beginnings) + "\n" +
                             fill_in(page(), {{"@DATA@", for_script(data)}});
    write_file(folder / page_name, html, kinds::differences, Links::replaced);
}

bool is_differences_file(std::string_view name) { return name == page_name || is_our_image(name); }

fs::path differences_folder(const fs::path& actual) {
    fs::path frames = actual.has_filename() ? actual : actual.parent_path();
    if (frames.filename() == "." || frames.filename() == "..")
        frames = fs::weakly_canonical(frames);
    return frames.parent_path() / (frames.filename().string() + "-differences");
}

JunitSuite suite_of(const Comparison& comparison) {
    using Outcome = JunitSuite::Outcome;
    JunitSuite suite("oiler compare");
    const std::string group = comparison.golden.string();
    for (const Cause cause : {Cause::simulation, Cause::picture, Cause::pixels, Cause::missing}) {
        const auto failed = [&](const FrameComparison& frame) {
            return frame.cause == cause && !frame.passed();
        };
        const auto first = std::ranges::find_if(comparison.frames, failed);
        if (first == comparison.frames.end())
            suite.add(group, name_of(cause), Outcome::passed, passed_text(comparison, cause));
        else
            suite.add(group, name_of(cause), Outcome::failed,
                      fmt::format("{} of {} frames, the first is frame {}: {}{}",
                                  comparison.count(cause), comparison.frames.size(), first->index,
                                  first->words, circumstances_of(comparison)));
    }
    return suite;
}

}  // namespace oiler
