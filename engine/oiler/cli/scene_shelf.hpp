// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>

#include "oiler/app/shelf.hpp"
#include "oiler/scene/scene.hpp"

namespace oiler::cli {

/// The scene files of a folder, for a window.
class SceneShelf final : public Shelf {
public:
    /// The scene of `file`. An empty file is none: such a scene never changes, and has no folder.
    SceneShelf(std::filesystem::path file, Scene scene);

    [[nodiscard]] std::optional<Taken> take(const AnyGame& shown,
                                            const std::optional<std::string>& dropped) override;
    [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }
    /// The scene's title and its file.
    [[nodiscard]] std::string title() const;

private:
    using Clock = std::chrono::steady_clock;

    Taken read(const std::filesystem::path& file, const std::optional<Stepping>& kept);
    /// The file so many places further in its folder.
    [[nodiscard]] std::filesystem::path neighbour(int places) const;
    [[nodiscard]] bool has_changed();

    std::filesystem::path file_;
    std::shared_ptr<const Scene> scene_;
    std::filesystem::file_time_type written_{};
    int places_ = 0;  ///< that were tried last
    Clock::time_point next_look_{};
};

}  // namespace oiler::cli
