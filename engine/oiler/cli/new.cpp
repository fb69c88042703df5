// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <system_error>

#include "oiler/cli/arguments.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/startable.hpp"
#include "oiler/core/markup.hpp"
#include "oiler/platform/surface.hpp"

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

constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/// Files of one command. Without keep(), they and the folders made for them are removed.
class NewFiles {
public:
    explicit NewFiles(const fs::path& folder) : existing_(folder) {
        std::error_code none;
        while (!fs::exists(existing_, none) && existing_.has_relative_path())
            existing_ = existing_.parent_path();
    }
    ~NewFiles() {
        std::error_code ignored;
        for (const fs::path& file : files_) {
            fs::remove(file, ignored);
            for (fs::path made = file.parent_path(); made != existing_; made = made.parent_path())
                fs::remove(made, ignored);
        }
    }
    NewFiles(const NewFiles&) = delete;
    NewFiles& operator=(const NewFiles&) = delete;

    void write(const fs::path& path, const std::string& text) {
        files_.push_back(path);
        write_file(path, text, kinds::any, Links::replaced);
    }
    void keep() { files_.clear(); }

private:
    fs::path existing_;  ///< the innermost folder that existed before
    std::vector<fs::path> files_;
};

/// The absolute path of a folder, without "." and without a slash at its end; empty for no name.
fs::path folder_of(const std::string& name) {
    std::error_code none;
    fs::path folder = fs::absolute(name, none).lexically_normal();
    return folder.has_filename() ? folder : folder.parent_path();
}

void require_usable(const std::string& name, const std::string& as_given) {
    const std::string others = std::string(letters) + "0123456789_-";
    if (name.empty() || letters.find(name[0]) == letters.npos ||
        name.find_first_not_of(others) != name.npos)
        fail(Exit::usage,
             "NAME {}: the name of a project has the letters a to z and A to Z, digits, _ and -, "
             "and begins with a letter; for example cannon, or games/cannon",
             as_given);
}

void require_new(const fs::path& folder, const std::string& as_given) {
    std::error_code error;
    const fs::file_status found = fs::status(folder, error);
    if (!fs::exists(found)) return;
    if (!fs::is_directory(found))
        fail(Exit::usage, "NAME {}: there is a file of that name; give another name", as_given);
    const bool is_empty = fs::is_empty(folder, error);
    if (error)
        fail(Exit::io, "cannot read the folder {}: {}; choose another place", as_given,
             error.message());
    if (!is_empty)
        fail(Exit::usage, "NAME {}: the folder is not empty; give another name", as_given);
}

/// The word as a shell reads it.
std::string quoted(const std::string& word) {
    const std::string plain = std::string(letters) + "0123456789_-./";
    if (word.find_first_not_of(plain) == word.npos) return word;
    std::string text = "'";
    for (const char one : word) text += one == '\'' ? std::string("'\\''") : std::string(1, one);
    return text + "'";
}

std::string describe(const Home& home) {
    const std::string folder = home.folder.string();
    switch (home.kind) {
        case Home::Kind::installed:
            return fmt::format("It uses the Oiler that is installed in {}.", folder);
        case Home::Kind::source:
            return fmt::format("It compiles the Oiler in {}: some minutes, once.", folder);
        case Home::Kind::unknown:
            break;
    }
    return "This program is neither installed nor in its build folder. If CMake finds no installed "
           "Oiler, add\n-DCMAKE_PREFIX_PATH=DIR to its first command.";
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

struct ProjectFile {
    std::filesystem::path path;  ///< relative to the folder of the project
    std::string text;
};

/// The files of a new project. assets/project is the same project with the name `game`.
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

}  // namespace

struct NewCommand {
    static constexpr CommandTexts texts{
        .name = "new",
        .summary = "Write the project of a new game, with a test and CI jobs",
        .example = "games/cannon",
        .notes = "It prints the two commands that run and test the game.",
        .may_take_long = false};

    std::string given;

    void declare(Arguments& arguments) {
        arguments.add_required("NAME", given, "new folder, its last part is the name of the game");
    }

    [[nodiscard]] Exit run() const {
        const fs::path folder = folder_of(given);
        const std::string name = folder.filename().string();
        require_usable(name, given);
        require_new(folder, given);
        const Home home = own_home();
        NewFiles files(folder);
        for (const ProjectFile& file : project_files(name, home))
            files.write(folder / file.path, file.text);
        print(text(name, home));
        files.keep();
        return Exit::done;
    }

private:
    [[nodiscard]] std::string text(const std::string& name, const Home& home) const {
        return fmt::format(
            "{0} is a new project. {1}\n"
            "Run it:\n"
            "    cd {2} && cmake -B build && cmake --build build{3} && build/bin/{0}{4}\n"
            "Test it, in the same folder:\n"
            "    ctest --test-dir build --output-on-failure\n"
            "The first test writes golden frames into tests/golden. Commit them with your files.\n",
            name, describe(home), quoted(given),
            home.kind == Home::Kind::source ? " -j $(nproc)" : "",
            has_display() ? "" : " --headless");
    }
};

template Command make_command<NewCommand>();

}  // namespace oiler::cli
