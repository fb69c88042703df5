// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "oiler/capture/capture.hpp"

namespace oiler::test {

/// The contents of a made-up capture, to be changed before it is written.
struct Film {
    Manifest header{.version = "0.1.0",
                    .compiler = "g++",
                    .provider = "osmesa",
                    .gl_renderer = "llvmpipe",
                    .gl_version = "3.3",
                    .size = {10, 10},
                    .fps = 10,
                    .rate = 30,
                    .method = "rk4",
                    .precision = "double",
                    .scene = "made up"};
    std::vector<Shot> shots{};
};

/// Frames of three ticks each, in which state, picture and pixels are different.
inline Film film_of(int frames) {
    Film film;
    for (int i = 0; i < frames; ++i) {
        const auto number = static_cast<std::uint64_t>(i);
        const auto metres = static_cast<double>(i);
        Shot shot{.tick = 3 * i, .state_hash = 100 + number, .picture_hash = 200 + number};
        for (int tick = shot.tick - 2; i > 0 && tick <= shot.tick; ++tick)
            shot.tick_hashes += fmt::format("{:04x}", tick);
        shot.record = FrameRecord{.bodies = {{"bob", {metres, 1, 0}, {2, 3, 0}}}};
        shot.record->picture.discs = {{.key = {1}, .centre = {static_cast<float>(i), 1}}};
        shot.rgb.assign(300, static_cast<std::uint8_t>(10 * i));
        film.shots.push_back(std::move(shot));
    }
    return film;
}

inline void write(Film film, const std::filesystem::path& folder) {
    film.header.planned_frames =
        std::max(film.header.planned_frames, std::int64_t(film.shots.size()));
    Capture capture(folder, film.header);
    for (Shot& shot : film.shots) capture.add(std::move(shot));
    capture.finish();
}

}  // namespace oiler::test
