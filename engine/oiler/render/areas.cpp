// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>

#include "oiler/render/mesh.hpp"

namespace oiler {
namespace {

using plane::Box;
using plane::Vec;

using Ring = std::vector<Vec>;

double cross(Vec a, Vec b) { return a.x * b.y - a.y * b.x; }

double area_of(const Ring& ring) {
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
    return twice / 2;
}

double perimeter_of(const Ring& ring) {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        sum += length(ring[(i + 1) % ring.size()] - ring[i]);
    return sum;
}

/// Whether all points are beyond the same side of the box.
bool is_beside(const Ring& ring, const Box& box) {
    const auto all = [&](auto is_beyond) { return std::ranges::all_of(ring, is_beyond); };
    return all([&](Vec p) { return p.x < box.low.x; }) ||
           all([&](Vec p) { return p.y < box.low.y; }) ||
           all([&](Vec p) { return p.x > box.high.x; }) ||
           all([&](Vec p) { return p.y > box.high.y; });
}

/// Removes points at the place of the one before.
Ring corners_of(const Ring& ring) {
    constexpr double least_distance = 1e-3;  // pixels
    Ring corners;
    for (const Vec& point : ring)
        if (corners.empty() || length(point - corners.back()) > least_distance)
            corners.push_back(point);
    while (corners.size() > 1 && length(corners.back() - corners.front()) <= least_distance)
        corners.pop_back();
    return corners;
}

/// From a corner to the inner side of its soft edge, half a pixel from the edges; the outer side is
/// opposite. The ring runs counter-clockwise. Mitres end at four pixels.
Vec mitre_at(Vec before, Vec at, Vec after) {
    constexpr double half = 0.5;
    constexpr double longest = 4;
    const Vec in = (1 / length(at - before)) * (at - before);
    const Vec out = (1 / length(after - at)) * (after - at);
    const double opening = std::max(1 + dot(in, out), 2 * half * half / (longest * longest));
    return (half / opening) * (left_of(in) + left_of(out));
}

/// The length of an edge of the inner ring along the same edge of the ring. It is negative where
/// the edge is so short that its mitres cross.
double inner_length(const Ring& ring, const Ring& inner, std::size_t edge) {
    const std::size_t next = (edge + 1) % ring.size();
    const Vec along = ring[next] - ring[edge];
    return dot(inner[next] - inner[edge], along) / length(along);
}

/// Whether the area is wider than its soft edges.
bool has_inside(const Ring& ring, const Ring& inner) {
    double perimeter = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) perimeter += inner_length(ring, inner, i);
    return perimeter > 0 && area_of(inner) > 0;
}

/// Shrinks short edges, whose mitres cross, to points.
void join_crossed_mitres(const Ring& ring, Ring& inner) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::size_t next = (i + 1) % ring.size();
        if (inner_length(ring, inner, i) <= 0)
            inner[i] = inner[next] = 0.5 * (inner[i] + inner[next]);
    }
}

bool is_within(Vec p, Vec a, Vec b, Vec c) {
    return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

/// Cuts off corners that have no other corner inside (Meisters, Amer. Math. Monthly 82, 1975), as
/// triples of indices of the ring. If any corner is inside, a reflex one is.
std::vector<std::uint32_t> triangulate(const Ring& ring) {
    std::vector<std::uint32_t> left(ring.size());
    std::iota(left.begin(), left.end(), 0U);
    std::vector<std::uint32_t> reflex;
    for (const std::uint32_t i : left) {
        const Vec at = ring[i];
        const Vec before = ring[(i + ring.size() - 1) % ring.size()];
        if (cross(at - before, ring[(i + 1) % ring.size()] - at) < 0) reflex.push_back(i);
    }
    std::vector<std::uint32_t> triangles;
    std::size_t tried = 0;
    for (std::size_t i = 0; left.size() > 2 && tried <= left.size();) {
        const std::size_t count = left.size();
        const std::uint32_t a = left[i % count];
        const std::uint32_t b = left[(i + 1) % count];
        const std::uint32_t c = left[(i + 2) % count];
        const bool is_convex = cross(ring[b] - ring[a], ring[c] - ring[b]) >= 0;
        const bool is_ear = is_convex && std::ranges::none_of(reflex, [&](std::uint32_t other) {
                                return other != a && other != b && other != c &&
                                       is_within(ring[other], ring[a], ring[b], ring[c]);
                            });
        if (!is_ear) {
            ++i;
            ++tried;
            continue;
        }
        triangles.insert(triangles.end(), {a, b, c});
        std::erase(reflex, b);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>((i + 1) % count));
        i %= left.size();
        tried = 0;
    }
    return triangles;
}

/// A point of an area, and where it is across the soft edge, from 0 to 1.
struct Corner {
    Vec at;
    double across;
};

using Patch = std::vector<Corner>;

/// The part of a convex patch where sign · coordinate ≥ sign · limit: Sutherland & Hodgman, CACM 17
/// (1974). The cut of an edge is computed from its kept end, to the same bits for both neighbours.
Patch cut(const Patch& patch, double Vec::*coordinate, double sign, double limit) {
    const auto height = [&](const Corner& c) { return sign * (c.at.*coordinate - limit); };
    Patch kept;
    for (std::size_t i = 0; i < patch.size(); ++i) {
        Corner from = patch[i];
        Corner to = patch[(i + 1) % patch.size()];
        if (height(from) >= 0) kept.push_back(from);
        if ((height(from) >= 0) == (height(to) >= 0)) continue;
        if (height(from) < 0) std::swap(from, to);
        const double t = height(from) / (height(from) - height(to));
        kept.push_back(
            {from.at + t * (to.at - from.at), from.across + t * (to.across - from.across)});
        kept.back().at.*coordinate = limit;  // exactly, even if an end is 1e30 pixels away
    }
    return kept;
}

std::uint32_t add_vertex(const Corner& corner, Colour colour, LineMesh& mesh) {
    constexpr float half_width = 0.5F;
    mesh.vertices.push_back({{static_cast<float>(corner.at.x), static_cast<float>(corner.at.y)},
                             static_cast<float>(corner.across),
                             0,
                             half_width,
                             1,
                             colour});
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

/// Adds the part of a triangle within the box: the coordinates of a rasteriser are limited.
void add_clipped(Patch patch, const Box& box, Colour colour, LineMesh& mesh) {
    patch = cut(cut(patch, &Vec::x, 1, box.low.x), &Vec::y, 1, box.low.y);
    patch = cut(cut(patch, &Vec::x, -1, box.high.x), &Vec::y, -1, box.high.y);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Corner& corner : patch) {
        const std::uint32_t last = add_vertex(corner, colour, mesh);
        if (last >= first + 2) mesh.indices.insert(mesh.indices.end(), {first, last - 1, last});
    }
}

/// The triangles of the area and of its soft edge, as triples of indices of the inner (even) and
/// outer (odd) corners. Where the ring is narrower than its soft edges, the inner one crosses
/// itself and cannot be cut; then its corners follow the triangles of the ring.
std::vector<std::uint32_t> triangles_of(const Ring& ring, const Ring& inner) {
    std::vector<std::uint32_t> triangles = triangulate(inner);
    if (triangles.size() < 3 * (ring.size() - 2)) triangles = triangulate(ring);
    for (std::uint32_t& corner : triangles) corner *= 2;
    const auto count = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t here = 2 * i;
        const std::uint32_t next = 2 * ((i + 1) % count);
        triangles.insert(triangles.end(), {here, here + 1, next, next, here + 1, next + 1});
    }
    return triangles;
}

/// The frame clips the triangles, not the ring, which it may clip into several parts.
void add_area(const Ring& inner, const Ring& outer, const std::vector<std::uint32_t>& triangles,
              Colour colour, const Box& box, LineMesh& mesh) {
    Patch corners;
    for (std::size_t i = 0; i < inner.size(); ++i) {
        corners.push_back({inner[i], 0});
        corners.push_back({outer[i], 1});
    }
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Corner& corner : corners) add_vertex(corner, colour, mesh);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const std::span<const std::uint32_t> triangle(&triangles[i], 3);
        if (std::ranges::all_of(triangle, [&](auto c) { return box.holds(corners[c].at); }))
            for (const std::uint32_t corner : triangle) mesh.indices.push_back(first + corner);
        else
            add_clipped({corners[triangle[0]], corners[triangle[1]], corners[triangle[2]]}, box,
                        colour, mesh);
    }
}

/// An area narrower than a pixel: its outline, as dark as the area is wide.
void add_sliver(const Ring& ring, double area, Colour colour, Size frame, LineMesh& mesh) {
    std::vector<Point> outline;
    for (const Vec& point : ring)
        outline.push_back({static_cast<float>(point.x), static_cast<float>(point.y)});
    outline.push_back(Point(outline.front()));
    append_polyline(outline, {static_cast<float>(area / perimeter_of(ring)), colour}, frame, mesh);
}

}  // namespace

void append_polygon(std::span<const Point> points, Colour colour, Size frame, LineMesh& mesh) {
    Ring ring;
    for (const Point& point : points) {
        if (!std::isfinite(point.x) || !std::isfinite(point.y)) return;
        ring.push_back({point.x, point.y});
    }
    ring = corners_of(ring);
    double area = area_of(ring);
    if (area < 0) {
        std::reverse(ring.begin(), ring.end());
        area = -area;
    }
    constexpr double margin = 8;
    const Box box{{-margin, -margin}, {frame.width + margin, frame.height + margin}};
    if (ring.size() < 3 || colour.a == 0 || is_beside(ring, box)) return;
    Ring inner;
    Ring outer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec mitre = mitre_at(ring[(i + ring.size() - 1) % ring.size()], ring[i],
                                   ring[(i + 1) % ring.size()]);
        inner.push_back(ring[i] + mitre);
        outer.push_back(ring[i] - mitre);
    }
    if (!has_inside(ring, inner)) return add_sliver(ring, area, colour, frame, mesh);
    join_crossed_mitres(ring, inner);
    add_area(inner, outer, triangles_of(ring, inner), colour, box, mesh);
}

}  // namespace oiler
