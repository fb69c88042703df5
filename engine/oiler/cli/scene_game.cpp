// SPDX-License-Identifier: MIT
#include "oiler/cli/scene_game.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "oiler/cli/startable.hpp"
#include "oiler/core/error.hpp"
#include "oiler/lab/sweep/judge.hpp"
#include "oiler/overlay/follower.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/theme.hpp"
#include "oiler/scene/draw.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::cli {
namespace {

constexpr double highest_frequency = 10;  // Hz, of the spring that drags
constexpr double most_periods_per_step = 0.05;
constexpr float widest_click = 3;  // canvas units; moves beyond it drag

constexpr float zoom_of_notch = 0.9F;

namespace fs = std::filesystem;

fs::file_time_type written(const fs::path& file) {
    std::error_code error;
    return file.empty() ? fs::file_time_type{} : fs::last_write_time(file, error);
}

}  // namespace

SceneGame::SceneGame(std::shared_ptr<const Scene> scene, const Settings& settings, Watched watched)
    : scene_(std::move(scene)),
      watched_(watched),
      world_(make_world(*scene_, settings)),
      trails_(*scene_, world_),
      camera_(camera_of(*scene_, world_)) {}

std::int64_t SceneGame::step(std::int64_t step, std::int64_t count, InputSource& inputs) {
    if (is_watched())
        for (std::int64_t taken = 0; taken < count; ++taken) take_step(inputs.next(step + taken));
    else
        take_world_steps(count);
    return count;
}

/// As many steps per call as there are up to the next sample of the trails.
void SceneGame::take_world_steps(std::int64_t count) {
    const Stopwatch stopwatch(times_, &StepTimes::step);
    while (count > 0) {
        const std::int64_t steps = std::min(count, trails_.steps_to_sample(world_));
        world_.step(steps);
        trails_.sample(world_);
        count -= steps;
    }
}

void SceneGame::take_step(const Input& input) {
    if (input.restarts()) restart();
    if (input.pressed(again)) ends_ = true;
    places_to_go_ += input.presses(next) - input.presses(previous);
    look(input);
    drag(input);
    take_world_steps(1);
}

void SceneGame::look(const Input& input) {
    const auto canvas = input.pointer_canvas();
    if (!canvas || !input.held(move)) held_.reset();
    if (!canvas) return;
    const Point at = camera_.to_world(*canvas);
    camera_.zoom(std::pow(zoom_of_notch, static_cast<float>(input.wheel())), at);
    if (input.pressed(move)) held_ = at;
    if (!held_) return;
    camera_.centre.x += held_->x - at.x;
    camera_.centre.y += held_->y - at.y;
}

/// The body hangs on a critically damped spring, slow enough for the timestep, whatever the method.
void SceneGame::drag(const Input& input) {
    const auto at = input.pointer();
    const auto canvas = input.pointer_canvas();
    if (!at || !input.held(pull)) return drag_.reset();
    if (input.pressed(pull))
        if (const auto body = body_at(*at, camera_.height, world_, [&](std::size_t row) {
                return std::optional(world_.position_of_row(row));
            }))
            drag_ = Drag{.body = *body, .from = *canvas};
    if (!drag_) return;
    drag_->pulls = drag_->pulls ||
                   std::hypot(canvas->x - drag_->from.x, canvas->y - drag_->from.y) > widest_click;
    if (!drag_->pulls) return;
    drag_->to = world_.position(drag_->body);
    drag_->to[0] = at->x;
    if (world_.axes() > 1) drag_->to[1] = at->y;
    const double frequency = std::min(highest_frequency, most_periods_per_step / world_.dt());
    const double omega = 2 * std::numbers::pi * frequency;
    const Vec3 acceleration = (drag_->to - world_.position(drag_->body)) * (omega * omega) -
                              world_.velocity(drag_->body) * (2 * omega);
    world_.apply_force(drag_->body, acceleration * world_.mass(drag_->body));
}

void SceneGame::restart() {
    world_ = make_world(*scene_, Settings(world_.settings()));
    trails_ = SceneTrails(*scene_, world_);
    drag_.reset();
    ends_ = false;
    places_to_go_ = 0;
    ++cuts_;
}

void SceneGame::assign(const AnyGame& other) {
    const auto& source = dynamic_cast<const SceneGame&>(other);
    if (std::exchange(scene_, source.scene_) != source.scene_) {
        camera_ = source.camera_;
        held_.reset();
    }
    world_ = source.world_;
    trails_ = source.trails_;
    places_to_go_ = source.places_to_go_;
    drag_ = source.drag_;
    ends_ = source.ends_;
    ++cuts_;
}

Picture SceneGame::picture() const {
    Picture picture = draw_scene(*scene_, world_, camera_, trails_);
    if (is_watched())
        picture.labels.push_back(
            {.at = {8, 6},
             .text =
                 fmt::format("repeats after {:g} s; drag bodies, R restarts{}", scene_->duration,
                             watched_ == Watched::among_others ? ", [ ] change the scene" : ""),
             .size = 9,
             .colour = theme_of(picture.background).ink});
    if (drag_ && drag_->pulls)
        picture.polylines.push_back(
            {.points = {to_point(world_.position(drag_->body)), to_point(drag_->to)},
             .width = 1,
             .colour = palette::grey});
    return picture;
}

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

/// A scene keeps the setting that the player chose, unless its file now has another one.
Shelf::Taken SceneShelf::read(const fs::path& file, const std::optional<Stepping>& kept) {
    Scene scene = read_scene(file.string());
    const std::shared_ptr<const Scene> shown = this->scene();
    const bool keeps =
        kept && scene.stepping == shown->stepping && lab::why_not(scene, Settings{*kept}).empty();
    const Stepping stepping = keeps ? *kept : scene.stepping;
    make_world(scene, Settings{.stepping = stepping}).require_applicable();
    places_ = 0;
    file_ = file;
    written_ = written(file);
    {
        const std::lock_guard lock(mutex_);
        scene_ = std::make_shared<const Scene>(std::move(scene));
    }
    return {title(), stepping};
}

std::string SceneShelf::title() const {
    const std::string file = file_.filename().string();
    const std::string name = scene()->title;
    return name.empty() ? file : name + " – " + file;
}

bool SceneShelf::has_neighbours() const {
    return !file_.empty() && neighbour(1).filename() != file_.filename();
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

/// Checks the file at most four times a second. Reports a change once, even if the file is not a
/// valid scene.
bool SceneShelf::has_changed() {
    const Clock::time_point now = Clock::now();
    if (now < next_look_) return false;
    next_look_ = now + std::chrono::milliseconds(250);
    const fs::file_time_type time = written(file_);
    return time != fs::file_time_type{} && std::exchange(written_, time) != time;
}

}  // namespace oiler::cli
