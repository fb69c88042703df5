// SPDX-License-Identifier: MIT
#include "trap/surfaces.hpp"

#include <algorithm>
#include <limits>

namespace oiler::trap {
namespace {

using Shape = Surface::Shape;

Point point_of(const Vec3& vector) { return {vector[0], vector[1], vector[2]}; }

Real dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Real length(const Point& d) { return std::sqrt(dot(d, d)); }

/// a + factor·b.
Point sum(const Point& a, Real factor, const Point& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

Point turned(const Point& normal) { return {normal[1], -normal[0], 0}; }

/// Collects the surfaces of obstacles that share restitution, friction and motion.
class Collector {
public:
    void plane(const Plane& plane) {
        Surface one{.restitution = plane.restitution, .friction = plane.friction};
        const Point normal = point_of(plane.normal);
        const Real size = length(normal);
        one.normal = sum({}, 1 / size, normal);
        one.centre = sum({}, plane.offset / size, one.normal);
        all.push_back(one);
    }
    void like(const Obstacle& obstacle) {
        like_ = {.restitution = obstacle.restitution,
                 .friction = obstacle.friction,
                 .velocity = point_of(obstacle.velocity)};
        if (!obstacle.swing) return;
        like_.swing = point_of(obstacle.swing->way);
        like_.omega = 2 * std::acos(Real(-1)) / obstacle.swing->period;
        like_.phase = obstacle.swing->phase;
    }
    void disc(const Point& centre, Real radius) {
        const bool is_there = std::ranges::any_of(all, [&](const Surface& one) {
            return one.shape == Shape::disc && one.size == radius &&
                   length(sum(one.centre, -1, centre)) < 1e-12L && one.velocity == like_.velocity &&
                   one.swing == like_.swing;
        });
        if (!is_there) add(Shape::disc, centre, {}, radius, 0);
    }
    void segment(const Point& from, const Point& to) {
        const Point way = sum(to, -1, from);
        const Real size = length(way);
        add(Shape::bar, sum(from, 0.5L, way), turned(sum({}, 1 / size, way)), 0, size / 2);
        disc(from, 0);
        disc(to, 0);
    }
    void box(const Point& centre, Real width, Real height, Real angle) {
        const Point right{std::cos(angle), std::sin(angle), 0};
        const Point up{-right[1], right[0], 0};
        add(Shape::bar, centre, up, height / 2, width / 2);
        add(Shape::bar, centre, right, width / 2, height / 2);
        for (const int side : {-1, 1})
            for (const int end : {-1, 1})
                disc(sum(sum(centre, side * width / 2, right), end * height / 2, up), 0);
    }

    std::vector<Surface> all{};

private:
    void add(Shape shape, const Point& centre, const Point& normal, Real size, Real reach) {
        Surface one = like_;
        one.shape = shape;
        one.centre = centre;
        one.normal = normal;
        one.size = size;
        one.reach = reach;
        all.push_back(one);
    }
    Surface like_{};
};

void add(const SceneChain& chain, Collector& to) {
    to.like(chain.like);
    for (std::size_t i = 1; i < chain.points.size(); ++i)
        to.segment(point_of(chain.points[i - 1]), point_of(chain.points[i]));
    if (chain.closed) to.segment(point_of(chain.points.back()), point_of(chain.points.front()));
}

void add(const SceneTiles& tiles, Collector& to) {
    to.like({.restitution = tiles.restitution, .friction = tiles.friction});
    const Real side = tiles.tile;
    for (std::size_t row = 0; row < tiles.rows.size(); ++row)
        for (std::size_t column = 0; column < tiles.rows[row].size(); ++column) {
            if (!is_tile(tiles.rows[row][column])) continue;
            const Real right = side * (static_cast<Real>(column) + 0.5L);
            const Real up = side * (static_cast<Real>(tiles.rows.size() - row) - 0.5L);
            to.box({tiles.origin[0] + right, tiles.origin[1] + up, 0}, side, side, 0);
        }
}

void add(const Obstacle& obstacle, Collector& to) {
    to.like(obstacle);
    if (const auto* circle = std::get_if<CircleShape>(&obstacle.shape))
        to.disc(point_of(circle->centre), circle->radius);
    if (const auto* segment = std::get_if<SegmentShape>(&obstacle.shape))
        to.segment(point_of(segment->from), point_of(segment->to));
    if (const auto* box = std::get_if<BoxShape>(&obstacle.shape))
        to.box(point_of(box->centre), box->size[0], box->size[1], box->angle);
}

}  // namespace

Point Surface::from_centre(const Real* x, Real t) const {
    const Real swung = swing == Point{} ? 0 : std::sin(omega * t + phase);
    const Point place = sum(sum(centre, t, velocity), swung, swing);
    return {x[0] - place[0], x[1] - place[1], x[2] - place[2]};
}

Point Surface::velocity_at(Real t) const {
    return sum(velocity, omega * std::cos(omega * t + phase), swing);
}

Point Surface::acceleration_at(Real t) const {
    return sum({}, -omega * omega * std::sin(omega * t + phase), swing);
}

Point Surface::normal_at(const Real* x, Real t) const {
    if (shape == Shape::half_space) return normal;
    const Point d = from_centre(x, t);
    return shape == Shape::disc ? sum({}, 1 / length(d), d)
                                : sum({}, dot(normal, d) < 0 ? -1 : 1, normal);
}

Real Surface::height(const Real* x, Real t, Real contact) const {
    const Point d = from_centre(x, t);
    if (shape == Shape::half_space) return dot(normal, d) - contact;
    return (shape == Shape::disc ? length(d) : std::abs(dot(normal, d))) - size - contact;
}

Real Surface::beyond(const Real* x, Real t) const {
    if (shape != Shape::bar) return -std::numeric_limits<Real>::infinity();
    return std::abs(dot(turned(normal), from_centre(x, t))) - reach;
}

Real Surface::gap(const Real* x, Real t, Real contact, Real lid) const {
    return std::max(height(x, t, contact) - (shape == Shape::bar ? lid : 0), beyond(x, t));
}

Real Surface::curvature(Real contact) const {
    return shape == Shape::disc ? 1 / (size + contact) : 0;
}

std::vector<Surface> surfaces_of(const Scene& scene) {
    Collector to;
    for (const ScenePlane& one : scene.planes) to.plane(one.plane);
    for (const SceneObstacle& one : scene.obstacles) add(one.obstacle, to);
    for (const SceneChain& one : scene.chains) add(one, to);
    for (const SceneTiles& one : scene.tiles) add(one, to);
    return to.all;
}

}  // namespace oiler::trap
