// SPDX-License-Identifier: MIT
#include "oiler/scene/draw_air.hpp"

#include <cmath>
#include <cstdint>
#include <variant>

#include "oiler/picture/shapes.hpp"
#include "oiler/scene/draw_obstacles.hpp"

namespace oiler {
namespace {

/// The velocity of all winds, m/s; empty if there is none, or if they differ.
std::optional<Vec3> velocity_of_air(const Scene& scene) {
    std::optional<Vec3> common;
    for (const SceneForce& one : scene.forces) {
        const auto* const wind = std::get_if<WindForce<double, 3>>(&one.force);
        if (!wind) continue;
        if (common && *common != wind->velocity) return {};
        common = wind->velocity;
    }
    return common;
}

/// The key of an arrow, never that of an entity or an obstacle.
ElementKey key_of_arrow(std::int64_t column, std::int64_t row) {
    const auto low_bits = [](std::int64_t n) {
        return static_cast<std::uint64_t>(n) & 0x7fffffffU;
    };
    return {.object = std::uint64_t{1} << 62U | low_bits(column) << 31U | low_bits(row)};
}

/// Arrows in a grid that moves with the air.
class Air {
public:
    Air(const Vec3& velocity, double time, Picture& picture)
        : picture_(picture),
          spacing_(std::exp2(std::round(std::log2(picture.camera.height / 5)))),
          shift_(time * velocity) {
        const Point wind = point_of(velocity);
        const float length = 0.45F * static_cast<float>(spacing_) / std::hypot(wind.x, wind.y);
        half_ = {length / 2 * wind.x, length / 2 * wind.y};
    }

    /// Draws somewhat more than the canvas: frames of other shapes show it.
    void draw() {
        constexpr double beyond = 1.5;
        const Camera& camera = picture_.camera;
        const double up = beyond * camera.height / 2;
        const double right = up * canvas_width / canvas_height;
        const Range columns = range(camera.centre.x, right, shift_[0]);
        const Range rows = range(camera.centre.y, up, shift_[1]);
        if (!(std::abs(columns.first) < farthest && std::abs(rows.first) < farthest)) return;
        for (double row = rows.first; row <= rows.last; ++row)
            for (double column = columns.first; column <= columns.last; ++column) add(column, row);
    }

private:
    static constexpr double farthest = 1e9;        // columns or rows
    static constexpr float width_of_head = 0.16F;  // of the spacing, four times that of the shaft

    struct Range {
        double first;
        double last;
    };
    [[nodiscard]] Range range(double centre, double half, double shift) const {
        return {std::floor((centre - half - shift) / spacing_),
                std::ceil((centre + half - shift) / spacing_)};
    }

    /// Whether an arrow at this place would cross the texts of a scene.
    [[nodiscard]] bool crosses_texts(Point at) const {
        constexpr float foot_low = 6, foot_high = 22, head_low = 320, head_high = 352;
        const float reach = std::abs(half_.y) + width_of_head / 2 * static_cast<float>(spacing_);
        const float low = picture_.camera.to_canvas({at.x, at.y - reach}).y;
        const float high = picture_.camera.to_canvas({at.x, at.y + reach}).y;
        return (high > foot_low && low < foot_high) || (high > head_low && low < head_high);
    }

    void add(double column, double row) {
        const Point at = point_of(shift_ + spacing_ * Vec3{column, row});
        if (crosses_texts(at)) return;
        picture_.polygons.push_back(
            {.key = key_of_arrow(static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)),
             .points = arrow({at.x - half_.x, at.y - half_.y}, {at.x + half_.x, at.y + half_.y},
                             width_of_head / 4 * static_cast<float>(spacing_)),
             .colour = palette::mix(picture_.background, palette::sky_blue, 0.4F)});
    }

    Picture& picture_;
    double spacing_;  ///< m; a power of 2, so that a zoom changes it seldom
    Vec3 shift_;      ///< m, the way of the air
    Point half_{};    ///< m, from the middle of an arrow to its tip
};

}  // namespace

void draw_air(const Scene& scene, double time, Picture& picture) {
    const std::optional<Vec3> velocity = velocity_of_air(scene);
    if (scene.view.wind && velocity && point_of(*velocity) != Point{})
        Air(*velocity, time, picture).draw();
}

}  // namespace oiler
