// SPDX-License-Identifier: MIT
// Flights among obstacles without code of the engine: the gaps of a parabola to faces and round
// corners are polynomials of degree 2 and 4, whose roots are found between those of the derivative.
#pragma once

#include "oiler/sim/obstacle.hpp"
#include "support/test.hpp"

namespace oiler::test {

using Polynomial = std::vector<Real>;  ///< the constant first

inline Real value(const Polynomial& p, Real t) {
    Real sum = 0;
    for (std::size_t i = p.size(); i-- > 0;) sum = sum * t + p[i];
    return sum;
}

/// All roots in (0, end) at which the sign changes, in their order.
inline std::vector<Real> roots(const Polynomial& p, Real end) {
    if (p.size() < 2) return {};
    Polynomial slope;
    for (std::size_t i = 1; i < p.size(); ++i) slope.push_back(p[i] * static_cast<Real>(i));
    std::vector<Real> bounds = roots(slope, end);
    bounds.push_back(end);
    std::vector<Real> found;
    Real low = 0;
    for (const Real bound : bounds) {
        Real from = std::exchange(low, bound);
        Real to = bound;
        const bool positive = value(p, from) > 0;
        if (positive == (value(p, to) > 0)) continue;
        for (int i = 0; i < 80; ++i) {
            const Real middle = (from + to) / 2;
            ((value(p, middle) > 0) == positive ? from : to) = middle;
        }
        found.push_back(from);
    }
    return found;
}

struct Point {
    Real x = 0;
    Real y = 0;
    friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
    friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
    friend Point operator*(Point a, Real s) { return {a.x * s, a.y * s}; }
};
inline Real dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline Point left_of(Point a) { return {-a.y, a.x}; }
inline Point point(const Vec3& v) { return {v[0], v[1]}; }

/// x + v·t + a·t²
struct Path {
    Point x, v, a;
    [[nodiscard]] Point at(Real t) const { return x + v * t + a * (t * t); }
};

/// The corners of a shape, counterclockwise, and the radius of its edge: one corner for a circle.
struct Outline {
    std::vector<Point> corners;
    Real radius = 0;
};
inline Outline outline(const Shape& shape) {
    if (const auto* circle = std::get_if<CircleShape>(&shape))
        return {{point(circle->centre)}, circle->radius};
    if (const auto* segment = std::get_if<SegmentShape>(&shape))
        return {{point(segment->from), point(segment->to)}, 0};
    const auto& box = std::get<BoxShape>(shape);
    const Point across = Point{std::cos(Real(box.angle)), std::sin(Real(box.angle))};
    const Point right = across * (Real(box.size[0]) / 2);
    const Point up = left_of(across) * (Real(box.size[1]) / 2);
    const Point c = point(box.centre);
    return {{c - right - up, c + right - up, c + right + up, c - right + up}, 0};
}

/// The distance of a disc from the outline; −1 if its centre is inside of all faces.
inline Real gap(const Outline& of, Point x, Real radius) {
    Real least = std::numeric_limits<Real>::infinity();
    bool inside = of.corners.size() > 2;
    for (std::size_t i = 0; i < of.corners.size(); ++i) {
        const Point from = of.corners[i];
        const Point side = of.corners[(i + 1) % of.corners.size()] - from;
        const Real square = dot(side, side);
        const Real s = square > 0 ? std::clamp(dot(x - from, side) / square, Real(0), Real(1)) : 0;
        const Point away = x - (from + side * s);
        least = std::min(least, std::sqrt(dot(away, away)));
        inside = inside && dot(x - from, left_of(side)) > 0;
    }
    return inside ? -1 : least - of.radius - radius;
}

/// An instant at which a path enters an outline, and the normal there.
struct Entry {
    Real t;
    Point normal;
};

/// The first entry in (0, end) of a disc that begins outside.
inline std::optional<Entry> first_entry(const Outline& of, const Path& path, Real radius,
                                        Real end) {
    std::optional<Entry> first;
    const auto take = [&](Real t, Point normal) {
        if (!first || t < first->t) first = Entry{t, normal};
    };
    const Real reach = of.radius + radius;
    for (std::size_t i = 0; i < of.corners.size(); ++i) {
        const Point c = of.corners[i];
        const Point d = path.x - c;
        const Polynomial square{dot(d, d) - reach * reach, 2 * dot(d, path.v),
                                dot(path.v, path.v) + 2 * dot(d, path.a), 2 * dot(path.v, path.a),
                                dot(path.a, path.a)};
        for (const Real t : roots(square, end))
            if (const Point away = path.at(t) - c; dot(away, path.v + path.a * (2 * t)) < 0)
                take(t, away * (1 / reach));
        if (of.corners.size() == 1) continue;
        const Point side = of.corners[(i + 1) % of.corners.size()] - c;
        const Real length = std::sqrt(dot(side, side));
        const Point n = left_of(side) * (-1 / length);
        for (const Real t : roots({dot(d, n) - reach, dot(path.v, n), dot(path.a, n)}, end)) {
            const Real along = dot(path.at(t) - c, side);
            if (dot(path.v + path.a * (2 * t), n) < 0 && along >= 0 && along <= length * length)
                take(t, n);
        }
    }
    return first;
}

}  // namespace oiler::test
