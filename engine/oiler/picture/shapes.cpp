// SPDX-License-Identifier: MIT
#include "oiler/picture/shapes.hpp"

#include <algorithm>
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

std::vector<Point> rope(Point from, Point to, float length) {
    constexpr int parts = 24;
    const float dx = to.x - from.x;
    const float dy = to.y - from.y;
    // The length of a flat parabola of this sag is chord + 8·sag²/(3·chord).
    const float sag = std::sqrt(3.0F / 16 * std::max(0.0F, length * length - (dx * dx + dy * dy)));
    std::vector<Point> points;
    for (int i = 0; i <= parts; ++i) {
        const float part = static_cast<float>(i) / parts;
        points.push_back({from.x + dx * part, from.y + dy * part - 4 * sag * part * (1 - part)});
    }
    return points;
}

std::vector<Point> rectangle(Point centre, Point size, float angle) {
    const float c = std::cos(angle) / 2;
    const float s = std::sin(angle) / 2;
    const Point along{c * size.x, s * size.x};
    const Point up{-s * size.y, c * size.y};
    return {{centre.x - along.x - up.x, centre.y - along.y - up.y},
            {centre.x + along.x - up.x, centre.y + along.y - up.y},
            {centre.x + along.x + up.x, centre.y + along.y + up.y},
            {centre.x - along.x + up.x, centre.y - along.y + up.y}};
}

std::vector<Point> bar(Point from, Point to, float width) {
    const Point along{to.x - from.x, to.y - from.y};
    return rectangle({(from.x + to.x) / 2, (from.y + to.y) / 2},
                     {std::hypot(along.x, along.y), width}, std::atan2(along.y, along.x));
}

std::vector<Point> regular_polygon(Point centre, float radius, int corners) {
    std::vector<Point> points;
    for (int i = 0; i < corners; ++i) {
        const float angle = turn * static_cast<float>(i) / static_cast<float>(corners);
        points.push_back(
            {centre.x - radius * std::sin(angle), centre.y + radius * std::cos(angle)});
    }
    return points;
}

std::vector<Point> arrow(Point from, Point to, float width) {
    constexpr float head_widths = 4;
    const float dx = to.x - from.x;
    const float dy = to.y - from.y;
    const float length = std::hypot(dx, dy);
    if (!(length > 0)) return std::vector<Point>(7, from);
    const float head = std::min(head_widths * width, length);
    const auto at = [&](float along, float aside) {
        return Point{from.x + (dx * along - dy * aside) / length,
                     from.y + (dy * along + dx * aside) / length};
    };
    const float half = std::min(width, head / head_widths) / 2;
    const float neck = length - head;
    return {at(0, -half),       at(neck, -half), at(neck, -head / 2), at(length, 0),
            at(neck, head / 2), at(neck, half),  at(0, half)};
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
