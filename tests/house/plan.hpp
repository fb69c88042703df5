// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>

namespace oiler::house {

/// The rooms of engine/oiler and their floors ("lab/sweep"), as the CMakeLists.txt of each room
/// names them: `set(rooms …)` has the rooms on which it stands, `set(floor_NAME …)` a floor and the
/// floors on which that stands.
using Plan = std::map<std::string, std::set<std::string>>;
[[nodiscard]] const Plan& plan();

/// The rooms that a room may include besides itself: those on which it stands, and so on down.
[[nodiscard]] std::set<std::string> rooms_below(const std::string& room);

/// The files that may include headers of windows and of OpenGL's providers.
inline constexpr std::array providers{"platform/sdl2.cpp", "platform/sdl2_events.cpp",
                                      "platform/sdl2_events.hpp", "platform/osmesa.cpp",
                                      "platform/egl.cpp"};

/// Folders whose targets depend on options, presets and installed libraries. CMake's list of
/// compile commands may lack their files; then the CMake files of the folder must name them.
inline constexpr std::array optional_folders{"tests/bench", "tests/bits", "tests/fuzz",
                                             "tests/install"};

}  // namespace oiler::house
