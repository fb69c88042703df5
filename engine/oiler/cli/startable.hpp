// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "oiler/core/error.hpp"

namespace oiler::cli {

/// The Oiler that a program belongs to. A new project uses it, so that nobody types its path.
struct Home {
    enum class Kind {
        unknown,
        installed,  ///< with headers and libraries, below a prefix
        source      ///< the program is in a build folder
    };
    Kind kind = Kind::unknown;
    std::filesystem::path folder{};  ///< the prefix, or the folder of the source
};

/// The home of the program at this path, PREFIX/bin/oiler or BUILD/bin/oiler.
[[nodiscard]] Home home_of(const std::filesystem::path& program);
/// The home of the running program.
[[nodiscard]] Home own_home();

/// The scene files of a folder, sorted; none if it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> scene_files(const std::filesystem::path& folder);

/// A demo or a scene that this Oiler brings along.
struct Startable {
    std::string name;      ///< "cannon" of a demo, "orbit.toml" of a scene
    std::string sentence;  ///< what it shows
    bool is_scene = false;
    std::vector<std::string> command{};  ///< the path of the program, and its arguments
    std::string picture{};               ///< the path of its PNG, which may be missing
};

/// The demos and scenes of the Oiler that the program at this path belongs to, PREFIX/bin/oiler or
/// BUILD/bin/oiler: the demos that are built, in the order of demos.txt, then the scenes by name.
[[nodiscard]] std::vector<Startable> startables_of(const std::filesystem::path& program);
/// The demos and scenes of the running program. Throws Error{usage} if there are none.
[[nodiscard]] std::vector<Startable> own_startables();

/// Finds a demo or a scene by its name, with or without ".toml". Throws Error{usage}, naming a
/// similar one.
[[nodiscard]] const Startable& find_startable(const std::vector<Startable>& all,
                                              const std::string& name);

/// Replaces this process by the program, with further arguments. Throws Error{io} if that fails.
[[noreturn]] void become(const Startable& one, const std::vector<std::string>& arguments);
/// Runs the program and returns its exit code. It ends when this process ends or is interrupted.
/// Throws Error{io} if it cannot be started.
int run_and_wait(const Startable& one);

}  // namespace oiler::cli
