// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "oiler/picture/picture.hpp"
#include "oiler/scene/scene.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// The paths of a scene's single bodies, for its picture only. A world keeps no past, so a game
/// samples it between its steps. In a scene of one axis, the past moves down, as on a recorder.
class SceneTrails {
public:
    SceneTrails() = default;
    /// Takes the first sample.
    SceneTrails(const Scene& scene, const World& world);

    /// The number of steps from the world's tick to the next sample.
    [[nodiscard]] std::int64_t steps_to_sample(const World& world) const;
    /// Takes a sample if one is due at the world's tick.
    void sample(const World& world);
    /// Adds the paths up to the bodies, fading with their age.
    void draw(const Scene& scene, const World& world, Picture& picture) const;

private:
    [[nodiscard]] std::int64_t stride(const World& world) const;
    /// A body now, or where a sample of it is drawn.
    [[nodiscard]] static Point now(const World& world, std::size_t body);
    [[nodiscard]] Point then(const World& world, std::size_t body, std::size_t sample,
                             float camera_height) const;
    /// The number of samples within the duration, before the newest.
    [[nodiscard]] std::size_t most(const World& world) const;
    void add_sample(const World& world);
    void draw_path(const World& world, std::size_t body, Colour colour, Picture& picture) const;

    double duration_ = 0;  ///< s
    std::size_t bodies_ = 0;
    std::size_t most_samples_ = 0;
    std::vector<Point> points_;  ///< sample by sample, of each body
};

}  // namespace oiler
