// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace oiler::house {

/// One line per fault; each begins with the file.
using Faults = std::vector<std::string>;
/// The texts of files by their paths, relative to engine/oiler or to the source tree.
using Texts = std::map<std::filesystem::path, std::string>;
/// The nodes that each node includes.
using Graph = std::map<std::string, std::set<std::string>>;

/// The room of a file of engine/oiler: "lab" for "lab/sweep/judge.hpp".
std::string room_of(const std::filesystem::path& file);

/// The place of a file of engine/oiler in the plan: its floor if its room has floors, otherwise its
/// room.
std::string place_of(const std::filesystem::path& file);

/// Rooms and floors that the plan lacks.
Faults check_place(const std::filesystem::path& file);

/// Includes that the plan forbids: of rooms not listed, of demos, by relative paths, and of window
/// and GL headers outside the providers.
Faults check_includes(const std::filesystem::path& file, const std::string& text);

/// The includes among the nodes that `node_of` gives files of engine/oiler: files, places, rooms.
Graph include_graph(const Texts& texts, std::string (*node_of)(const std::filesystem::path&));

/// A circle such as {"a", "b", "a"}; empty if there is none.
std::vector<std::string> find_circle(const Graph& graph);

/// Whether a file uses headers or paths of POSIX or Linux, or asks for the processor.
bool needs_this_system(const std::string& text);

/// Functions of the C library in a file whose last bits depend on the processor.
Faults find_inexact_functions(const std::filesystem::path& file, const std::string& text);

/// The SPDX line, #pragma once, and no unfinished work.
Faults check_form(const std::filesystem::path& file, const std::string& text);

/// Names that two files define in one namespace, and files whose brackets do not match. The files
/// web*.cpp of `platform` are built in place of others.
Faults find_doubled_names(const Texts& texts);

/// Files that no build compiles. `compiled`: the files of CMake's compile commands. `cmake_files`:
/// the CMake files of the tree; they count in the plan's optional folders, and for web*.cpp.
Faults find_uncompiled(const std::vector<std::filesystem::path>& files,
                       const std::set<std::filesystem::path>& compiled, const Texts& cmake_files);

/// The rooms of engine/oiler and their floors ("lab/sweep"), as the CMakeLists.txt of each room
/// names them: `set(rooms …)` has the rooms on which it stands, `set(floor_NAME …)` a floor and the
/// floors on which that stands.
using Plan = std::map<std::string, std::set<std::string>>;
[[nodiscard]] const Plan& plan();

/// The rooms that a room may include besides itself: those on which it stands, and so on down.
[[nodiscard]] std::set<std::string> rooms_below(const std::string& room);

/// The files that may include headers of windows and of OpenGL's providers.
inline constexpr std::array providers{"platform/sdl2.cpp", "platform/sdl2_events.cpp",
                                      "platform/sdl2_events.hpp", "platform/egl.cpp"};

/// Folders whose targets depend on options, presets and installed libraries. CMake's list of
/// compile commands may lack their files; then the CMake files of the folder must name them.
inline constexpr std::array optional_folders{"tests/bench", "tests/bits", "tests/fuzz",
                                             "tests/install"};

}  // namespace oiler::house
