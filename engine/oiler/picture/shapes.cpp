// SPDX-License-Identifier: MIT
#include "oiler/picture/shapes.hpp"

#include <cmath>
#include <numbers>

namespace oiler {
namespace {

constexpr float turn = 2 * std::numbers::pi_v<float>;

}  // namespace

std::vector<Point> coil(Point from, Point to, int turns, float radius) {
    constexpr int points_per_turn = 24;
    constexpr float lead = 0.08F;
    const float dx = to.x - from.x;
    const float dy = to.y - from.y;
    const float length = std::hypot(dx, dy);
    const Point across = length > 0 ? Point{-dy / length, dx / length} : Point{0, 1};
    const auto at = [&](float along, float aside) {
        return Point{from.x + dx * along + across.x * aside,
                     from.y + dy * along + across.y * aside};
    };
    std::vector<Point> points{from};
    const int count = turns * points_per_turn;
    for (int i = 0; i <= count; ++i) {
        const float fraction = static_cast<float>(i) / static_cast<float>(count);
        points.push_back(at(lead + (1 - 2 * lead) * fraction,
                            radius * std::sin(turn * static_cast<float>(turns) * fraction)));
    }
    points.push_back(to);
    return points;
}

std::vector<Point> circle(Point centre, float radius) {
    constexpr int sides = 48;
    std::vector<Point> points;
    for (int i = 0; i <= sides; ++i) {
        const float angle = turn * static_cast<float>(i) / sides;
        points.push_back(
            {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
    return points;
}

}  // namespace oiler
