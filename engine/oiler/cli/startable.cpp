// SPDX-License-Identifier: MIT
#include "oiler/cli/startable.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <string_view>
#include <system_error>

#include "oiler/core/end_with_parent.hpp"
#include "oiler/core/nearest.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/scene/read.hpp"

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

struct Places {
    fs::path list;
    fs::path demos;
    fs::path scenes;
    fs::path pictures;

    [[nodiscard]] std::string picture_of(const std::string& name) const {
        return (pictures / (name + ".png")).string();
    }
};

Places places_of(const fs::path& program) {
    const Home home = home_of(program);
    if (home.kind == Home::Kind::source)
        return {home.folder / "demos/demos.txt", program.parent_path(),
                home.folder / "assets/scenes", home.folder / "assets/pictures/menu"};
    const fs::path prefix = program.parent_path().parent_path();
    return {prefix / "share/oiler/demos/demos.txt", prefix / "libexec/oiler",
            prefix / "share/oiler/scenes", prefix / "share/oiler/pictures/menu"};
}

std::string title_of(const fs::path& scene) {
    try {
        return parse_scene(read_scene_text(scene.string()), scene.filename().string()).title;
    } catch (const Error& error) {
        return error.what();
    }
}

void add_demos(const Places& places, std::vector<Startable>& all) {
    constexpr std::string_view separator = ": ";
    std::ifstream list(places.list);
    for (std::string line; std::getline(list, line);) {
        const std::size_t end = line.find(separator);
        if (end == line.npos) continue;
        const std::string name = line.substr(0, end);
        const fs::path program = places.demos / name;
        std::error_code none;
        if (!fs::exists(program, none)) continue;
        all.push_back({.name = name,
                       .sentence = line.substr(end + separator.size()),
                       .command = {program.string()},
                       .picture = places.picture_of(name)});
    }
}

void add_scenes(const Places& places, const fs::path& program, std::vector<Startable>& all) {
    for (const fs::path& file : scene_files(places.scenes))
        all.push_back({.name = file.filename().string(),
                       .sentence = title_of(file),
                       .is_scene = true,
                       .command = {program.string(), "play", file.string()},
                       .picture = places.picture_of("scene_" + file.stem().string())});
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

[[noreturn]] void fail_to_start(const Startable& one, int error_number) {
    fail(Exit::io, "cannot start {}: {}", one.command.front(), system_reason(error_number));
}

/// Executes a program in a new process, which gets SIGTERM when its parent ends.
[[noreturn]] void become_child(const std::vector<char*>& arguments, pid_t parent) {
    constexpr int not_found = 127;  // as a shell has it
    end_with_parent(SIGTERM);
    if (getppid() == parent) execv(arguments.front(), arguments.data());
    _exit(not_found);
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

std::vector<fs::path> scene_files(const fs::path& folder) {
    std::error_code none;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, none))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::vector<Startable> startables_of(const fs::path& program) {
    const Places places = places_of(program);
    std::vector<Startable> all;
    add_demos(places, all);
    add_scenes(places, program, all);
    return all;
}

std::vector<Startable> own_startables() {
    std::error_code unknown;
    std::vector<Startable> all = startables_of(fs::read_symlink("/proc/self/exe", unknown));
    if (all.empty())
        fail(Exit::usage,
             "there are no demos beside this program, because it is neither installed nor in its "
             "build folder; start it from there");
    return all;
}

const Startable& find_startable(const std::vector<Startable>& all, const std::string& name) {
    for (const std::string& wanted : {name, name + ".toml"})
        for (const Startable& one : all)
            if (one.name == wanted) return one;
    std::vector<std::string_view> names;
    for (const Startable& one : all) names.emplace_back(one.name);
    fail(Exit::usage, "NAME {}: no such demo or scene{} (`oiler demos` lists all)", name,
         did_you_mean(name, names));
}

void become(const Startable& one, const std::vector<std::string>& arguments) {
    std::vector<std::string> words = one.command;
    words.insert(words.end(), arguments.begin(), arguments.end());
    execv(words.front().c_str(), pointers_to(words).data());
    fail_to_start(one, errno);
}

int run_and_wait(const Startable& one) {
    std::vector<std::string> words = one.command;
    const std::vector<char*> arguments = pointers_to(words);
    if (access(arguments.front(), X_OK) != 0) fail_to_start(one, errno);
    const pid_t here = getpid();
    const pid_t child = fork();
    if (child < 0) fail_to_start(one, errno);
    if (child == 0) become_child(arguments, here);
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) fail_to_start(one, errno);
        if (Interrupt::requested()) kill(child, SIGTERM);
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace oiler::cli
