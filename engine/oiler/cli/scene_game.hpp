// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "oiler/app/shelf.hpp"
#include "oiler/game/game.hpp"
#include "oiler/scene/scene.hpp"
#include "oiler/scene/trails.hpp"

namespace oiler::cli {

/// A scene as a game. In a window it ends after its duration, or with R. The left mouse button
/// drags its bodies, the right one its picture; the wheel zooms.
class SceneGame final : public AnyGame {
public:
    static constexpr Action again{"restart", Key::r};
    static constexpr Action pull{"drag a body", Mouse::left};
    static constexpr Action move{"move the picture", Mouse::right};
    static constexpr Action previous{"previous scene", Key::left_bracket};
    static constexpr Action next{"next scene", Key::right_bracket};
    static constexpr Control controls[] = {again, pull, move, previous, next};

    /// Who looks: nobody, or a player, who may change to other scenes of the folder.
    enum class Watched { no, alone, among_others };

    SceneGame(std::shared_ptr<const Scene> scene, const Settings& settings, Watched watched);

    std::int64_t step(std::int64_t step, std::int64_t count, InputSource& inputs) override;
    void restart() override;
    void set_stepping(const Stepping& stepping) override { world_.set_stepping(stepping); }
    void set_threads(int threads) override { world_.set_threads(threads); }
    [[nodiscard]] std::unique_ptr<AnyGame> clone() const override {
        return std::make_unique<SceneGame>(*this);
    }
    void assign(const AnyGame& other) override;
    [[nodiscard]] bool is_over() const override {
        return is_watched() && (ends_ || world_.time() >= scene_->duration);
    }
    /// The number of scenes that the user wants to go forward; negative: back.
    [[nodiscard]] int places_to_go() const { return places_to_go_; }
    [[nodiscard]] bool takes_input() const override { return is_watched(); }
    [[nodiscard]] const World& world() const override { return world_; }
    [[nodiscard]] Picture picture() const override;
    [[nodiscard]] std::string name_of(Entity entity) const override {
        return scene_->name_of_body(entity.index);
    }
    [[nodiscard]] std::string name_of(ObstacleHandle obstacle) const override {
        return scene_->name_of_obstacle(obstacle.slot);
    }

private:
    /// A body that the mouse holds. It is pulled from the first move of the mouse on, so that a
    /// click leaves its motion as it is.
    struct Drag {
        Entity body{};
        Point from{};  ///< canvas, where the button went down
        bool pulls = false;
        Vec3 to{};  ///< m
    };

    [[nodiscard]] bool is_watched() const { return watched_ != Watched::no; }
    void take_step(const Input& input);
    void take_world_steps(std::int64_t count);
    void look(const Input& input);
    void drag(const Input& input);

    std::shared_ptr<const Scene> scene_;
    Watched watched_;
    World world_;
    SceneTrails trails_;
    Camera camera_;              ///< the user's; assign() keeps it
    std::optional<Point> held_;  ///< the place of the world that the right button holds
    std::optional<Drag> drag_;
    bool ends_ = false;  ///< the user pressed R
    int places_to_go_ = 0;
};

/// The scene files of a folder, for a window.
class SceneShelf final : public Shelf {
public:
    /// The scene of `file`. Without a file, the scene never changes and has no neighbours.
    SceneShelf(std::filesystem::path file, Scene scene);

    [[nodiscard]] std::optional<Taken> take(const AnyGame& shown,
                                            const std::optional<std::string>& dropped) override;
    /// Any thread may ask.
    [[nodiscard]] std::shared_ptr<const Scene> scene() const {
        const std::lock_guard lock(mutex_);
        return scene_;
    }
    /// Whether the scene's folder has another one.
    [[nodiscard]] bool has_neighbours() const;
    /// The scene's title and its file.
    [[nodiscard]] std::string title() const;

private:
    using Clock = std::chrono::steady_clock;

    Taken read(const std::filesystem::path& file, const std::optional<Stepping>& kept);
    /// The file that is `places` after this one in its folder. The first file follows the last.
    [[nodiscard]] std::filesystem::path neighbour(int places) const;
    [[nodiscard]] bool has_changed();

    std::filesystem::path file_;
    mutable std::mutex mutex_;
    std::shared_ptr<const Scene> scene_;  ///< guarded by mutex_
    std::filesystem::file_time_type written_{};
    int places_ = 0;  ///< of the last request
    Clock::time_point next_look_{};
};

}  // namespace oiler::cli
