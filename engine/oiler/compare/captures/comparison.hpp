// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "oiler/capture/manifest.hpp"
#include "oiler/core/json.hpp"

namespace oiler {

/// Pixels that may differ although state and picture are equal, because another renderer or another
/// processor drew them. Means and structural similarity are not used: they pass wrong colours.
struct PixelTolerance {
    int channel = 2;      ///< largest difference of a channel, of 255
    double share = 0.01;  ///< largest share of differing pixels
};

/// The first stage in which a frame differs. Later stages follow from it.
enum class Cause {
    none,
    missing,     ///< the frame is in one capture only
    simulation,  ///< state hashes differ
    picture,     ///< picture hashes differ
    pixels,      ///< only pixel hashes differ
};

/// "simulation", "picture", ...
[[nodiscard]] std::string_view name_of(Cause cause);

/// One frame of the golden compared with the same frame of the actual capture.
struct FrameComparison {
    std::int64_t index = 0;
    std::int64_t tick = 0;
    double time = 0;  ///< s
    Cause cause = Cause::none;
    bool other_tick = false;     ///< the frame shows another tick than that of the golden
    bool tolerated = false;      ///< only pixels differ, within the tolerance or not compared
    std::string words{};         ///< the change
    bool has_images = false;     ///< both captures have a PNG, and the pixels were compared
    std::int64_t differing = 0;  ///< pixels
    double share = 0;            ///< of all pixels
    int largest = 0;             ///< of 255

    [[nodiscard]] bool passed() const { return cause == Cause::none || tolerated; }
};

/// Largest number of frames whose images a page of differences shows.
inline constexpr std::int64_t most_shown_frames = 20;

struct SettingChange {
    std::string name;
    std::string golden;
    std::string actual;
};

/// The comparison of two captures.
struct Comparison {
    std::filesystem::path golden;
    std::filesystem::path actual;
    PixelTolerance tolerance{};
    std::string renderer{};  ///< "llvmpipe 15 → llvmpipe 17", empty if the same drew both
    std::vector<SettingChange> settings{};
    std::vector<std::string> findings{};  ///< changes of the scene file and the like
    std::vector<FrameComparison> frames{};
    std::string verdict{};  ///< the first cause in one sentence

    [[nodiscard]] bool passed() const;
    /// The number of frames with that cause, without tolerated ones.
    [[nodiscard]] std::int64_t count(Cause cause) const;
    [[nodiscard]] std::int64_t tolerated() const;
};

/// The first cause in one sentence.
[[nodiscard]] std::string verdict_of(const Comparison& comparison);

/// The comparison as text for a terminal, some lines.
[[nodiscard]] std::string describe(const Comparison& comparison);

/// All facts of a comparison but the images.
[[nodiscard]] Json to_json(const Comparison& comparison);

/// The settings in which two captures differ, besides the renderer.
[[nodiscard]] std::vector<SettingChange> setting_changes(const Manifest& golden,
                                                         const Manifest& actual);

/// The first lines in which two scene files differ besides comments; empty if there are none.
[[nodiscard]] std::string scene_change(const std::string& golden, const std::string& actual);

/// Compares the frames of two folders. Throws Error{usage} if a folder has no finished golden or no
/// capture at all, if a PNG is damaged, or if its pixels are not those of its manifest.
[[nodiscard]] Comparison compare_captures(const std::filesystem::path& golden,
                                          const std::filesystem::path& actual,
                                          const PixelTolerance& tolerance);

}  // namespace oiler
