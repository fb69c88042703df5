// SPDX-License-Identifier: MIT
#include "oiler/cli/scene_shelf.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "oiler/cli/files.hpp"
#include "oiler/cli/scene_game.hpp"
#include "oiler/core/error.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::cli {
namespace {

namespace fs = std::filesystem;

fs::file_time_type written(const fs::path& file) {
    std::error_code error;
    return file.empty() ? fs::file_time_type{} : fs::last_write_time(file, error);
}

bool is_possible(const Scene& scene, const Stepping& stepping) {
    try {
        make_world(scene, Settings{.stepping = stepping}).require_applicable();
        return true;
    } catch (const Error& error) {
        if (error.exit() != Exit::usage) throw;
        return false;
    }
}

}  // namespace

SceneShelf::SceneShelf(fs::path file, Scene scene)
    : file_(std::move(file)),
      scene_(std::make_shared<const Scene>(std::move(scene))),
      written_(written(file_)) {}

std::optional<Shelf::Taken> SceneShelf::take(const AnyGame& shown,
                                             const std::optional<std::string>& dropped) {
    const int places = dynamic_cast<const SceneGame&>(shown).places_to_go();
    if (dropped) return read(*dropped, std::nullopt);
    // An invalid scene file is tried once. The next press takes the file after it.
    if (std::exchange(places_, places) != places && places != 0 && !file_.empty())
        return read(neighbour(places), std::nullopt);
    if (has_changed()) return read(file_, shown.world().settings().stepping);
    return std::nullopt;
}

/// A scene keeps the setting that the player chose, unless its file now says another one.
Shelf::Taken SceneShelf::read(const fs::path& file, const std::optional<Stepping>& kept) {
    Scene scene = read_scene(file.string());
    const bool keeps = kept && scene.stepping == scene_->stepping && is_possible(scene, *kept);
    const Stepping stepping = keeps ? *kept : scene.stepping;
    make_world(scene, Settings{.stepping = stepping}).require_applicable();
    places_ = 0;
    file_ = file;
    written_ = written(file);
    scene_ = std::make_shared<const Scene>(std::move(scene));
    return {title(), stepping};
}

std::string SceneShelf::title() const {
    const std::string file = file_.filename().string();
    return scene_->title.empty() ? file : scene_->title + " – " + file;
}

fs::path SceneShelf::neighbour(int places) const {
    const fs::path folder = file_.has_parent_path() ? file_.parent_path() : ".";
    const std::vector<fs::path> files = scene_files(folder);
    if (files.empty()) return file_;
    const auto is_shown = [&](const fs::path& one) { return one.filename() == file_.filename(); };
    const auto at = std::ranges::find_if(files, is_shown) - files.begin();
    const auto count = std::ssize(files);
    const auto place = ((at + places) % count + count) % count;
    return files[static_cast<std::size_t>(place)];
}

/// Looked at some times a second; a change is reported once, even if the file is then no scene.
bool SceneShelf::has_changed() {
    const Clock::time_point now = Clock::now();
    if (now < next_look_) return false;
    next_look_ = now + std::chrono::milliseconds(250);
    const fs::file_time_type time = written(file_);
    return time != fs::file_time_type{} && std::exchange(written_, time) != time;
}

}  // namespace oiler::cli
