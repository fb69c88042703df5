// SPDX-License-Identifier: MIT
#include "oiler/cli/project.hpp"

#include <fmt/core.h>

#include <fstream>
#include <string_view>
#include <system_error>

#include "oiler/core/markup.hpp"

extern "C" {
extern const char oiler_project_lists[], oiler_project_lists_end[];
extern const char oiler_project_game[], oiler_project_game_end[];
extern const char oiler_project_frames[], oiler_project_frames_end[];
extern const char oiler_project_play[], oiler_project_play_end[];
extern const char oiler_project_ignore[], oiler_project_ignore_end[];
extern const char oiler_project_github[], oiler_project_github_end[];
extern const char oiler_project_gitlab[], oiler_project_gitlab_end[];
}

namespace oiler::cli {
namespace {

namespace fs = std::filesystem;

/// The source folder of a build folder of Oiler, from CMake's cache; empty for any other folder.
fs::path source_of(const fs::path& build) {
    constexpr std::string_view key = "oiler_SOURCE_DIR:STATIC=";
    std::ifstream cache(build / "CMakeCache.txt");
    for (std::string line; std::getline(cache, line);)
        if (line.starts_with(key)) return line.substr(key.size());
    return {};
}

/// A template without its first line, the licence: a new project belongs to its author.
std::string fill_in(const char* begin, const char* end, const std::string& name) {
    std::string_view text(begin, end);
    text.remove_prefix(text.find('\n') + 1);
    return oiler::fill_in(text, {{"project(game ", "project(" + name + " "},
                                 {"\"game\"", "\"" + name + "\""},
                                 {"/game", "/" + name}});
}

std::string local_cmake(const Home& home) {
    const std::string heading =
        "# The Oiler of this computer. This file is not for the repository: see .gitignore.\n";
    if (home.kind == Home::Kind::installed)
        return heading +
               fmt::format("list(APPEND CMAKE_PREFIX_PATH [==[{}]==])\n", home.folder.string());
    return heading + fmt::format(
                         "set(OILER_SOURCE [==[{}]==] CACHE PATH\n"
                         "    \"Source of Oiler; empty: an installed Oiler\")\n",
                         home.folder.string());
}

}  // namespace

Home home_of(const fs::path& program) {
    const fs::path folder = program.parent_path().parent_path();
    std::error_code none;
    if (fs::exists(folder / "include/oiler/oiler.hpp", none))
        return {Home::Kind::installed, folder};
    const fs::path source = source_of(folder);
    if (!source.empty() && fs::exists(source / "engine/oiler/oiler.hpp", none))
        return {Home::Kind::source, source};
    return {};
}

Home own_home() {
    std::error_code unknown;
    return home_of(fs::read_symlink("/proc/self/exe", unknown));
}

std::vector<ProjectFile> project_files(const std::string& name, const Home& home) {
    const auto file = [&](const char* path, const char* begin, const char* end) {
        return ProjectFile{path, fill_in(begin, end, name)};
    };
    std::vector<ProjectFile> files{
        file("CMakeLists.txt", oiler_project_lists, oiler_project_lists_end),
        file("game.cpp", oiler_project_game, oiler_project_game_end),
        file("tests/frames.sh", oiler_project_frames, oiler_project_frames_end),
        file("tests/play.txt", oiler_project_play, oiler_project_play_end),
        file(".gitignore", oiler_project_ignore, oiler_project_ignore_end),
        file(".github/workflows/frames.yml", oiler_project_github, oiler_project_github_end),
        file(".gitlab-ci.yml", oiler_project_gitlab, oiler_project_gitlab_end)};
    if (home.kind != Home::Kind::unknown) files.push_back({"local.cmake", local_cmake(home)});
    return files;
}

}  // namespace oiler::cli
