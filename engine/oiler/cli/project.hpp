// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

struct ProjectFile {
    std::filesystem::path path;  ///< relative to the folder of the project
    std::string text;
};

/// The files of a new project. assets/project is the same project with the name `game`.
[[nodiscard]] std::vector<ProjectFile> project_files(const std::string& name, const Home& home);

}  // namespace oiler::cli
