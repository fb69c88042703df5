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
};

/// The demos and scenes of the Oiler that the program at this path belongs to, PREFIX/bin/oiler or
/// BUILD/bin/oiler: the demos that are built, in the order of demos.txt, then the scenes by name.
[[nodiscard]] std::vector<Startable> startables_of(const std::filesystem::path& program);
/// Those of the running program. Throws Error{usage} if it finds none.
[[nodiscard]] std::vector<Startable> own_startables();

/// The one of that name; of a scene, ".toml" may be left out. Throws Error{usage} that names a
/// similar one.
[[nodiscard]] const Startable& find_startable(const std::vector<Startable>& all,
                                              const std::string& name);

/// Becomes that program, with further arguments. Throws Error{io} if it cannot.
[[noreturn]] void become(const Startable& one, const std::vector<std::string>& arguments);
/// Runs that program and returns its exit code. Throws Error{io} if it cannot.
int run_and_wait(const Startable& one);

}  // namespace oiler::cli
