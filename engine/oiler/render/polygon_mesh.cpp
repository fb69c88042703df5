// SPDX-License-Identifier: MIT
#include "oiler/render/polygon_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "oiler/render/plane.hpp"

namespace oiler {
namespace {

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

/// The part of a ring where sign · coordinate ≥ sign · limit: Sutherland & Hodgman, CACM 17 (1974).
Ring cut(const Ring& ring, double Vec::*coordinate, double sign, double limit) {
    const auto height = [&](Vec p) { return sign * (p.*coordinate - limit); };
    Ring kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec from = ring[i];
        const Vec to = ring[(i + 1) % ring.size()];
        const double a = height(from);
        const double b = height(to);
        if (a >= 0) kept.push_back(from);
        if ((a >= 0) == (b >= 0)) continue;
        kept.push_back(from + a / (a - b) * (to - from));
        kept.back().*coordinate = limit;  // exactly, even if an end is 1e30 pixels away
    }
    return kept;
}

/// Cuts the ring to a box around the frame: the coordinates of a rasteriser are limited.
Ring clipped(const Ring& ring, Size frame) {
    constexpr double margin = 8;
    return cut(cut(cut(cut(ring, &Vec::x, 1, -margin), &Vec::y, 1, -margin), &Vec::x, -1,
                   frame.width + margin),
               &Vec::y, -1, frame.height + margin);
}

/// Removes points at the place of the one before.
Ring corners_of(const Ring& ring) {
    constexpr double closest = 1e-3;  // pixels
    Ring corners;
    for (const Vec& point : ring)
        if (corners.empty() || length(point - corners.back()) > closest) corners.push_back(point);
    while (corners.size() > 1 && length(corners.back() - corners.front()) <= closest)
        corners.pop_back();
    return corners;
}

/// Both sides of a soft edge at a corner, half a pixel away from it.
struct Edge {
    Vec inner;
    Vec outer;
};

/// The ring runs counter-clockwise. Mitres end at four pixels.
Edge edge_at(Vec before, Vec at, Vec after) {
    constexpr double half = 0.5;
    constexpr double longest = 4;
    const Vec in = (1 / length(at - before)) * (at - before);
    const Vec out = (1 / length(after - at)) * (after - at);
    const double opening = std::max(1 + dot(in, out), 2 * half * half / (longest * longest));
    const Vec mitre = (half / opening) * (left_of(in) + left_of(out));
    return {at + mitre, at - mitre};
}

/// The inner sides of the edges, or none if the area is too narrow for them.
std::optional<Ring> inner_ring(const Ring& ring, const std::vector<Edge>& edges) {
    Ring inner;
    for (const Edge& edge : edges) inner.push_back(edge.inner);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::size_t next = (i + 1) % ring.size();
        if (dot(inner[next] - inner[i], ring[next] - ring[i]) <= 0) return {};
    }
    return area_of(inner) > 0 ? std::optional(inner) : std::nullopt;
}

bool is_within(Vec p, Vec a, Vec b, Vec c) {
    return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

/// Cuts off corners that have no other corner inside (Meisters, Amer. Math. Monthly 82, 1975), as
/// triples of indices of the ring.
std::vector<std::uint32_t> triangulate(const Ring& ring) {
    std::vector<std::uint32_t> left(ring.size());
    std::iota(left.begin(), left.end(), 0U);
    std::vector<std::uint32_t> triangles;
    std::size_t tried = 0;
    for (std::size_t i = 0; left.size() > 2 && tried <= left.size();) {
        const std::size_t count = left.size();
        const std::uint32_t a = left[i % count];
        const std::uint32_t b = left[(i + 1) % count];
        const std::uint32_t c = left[(i + 2) % count];
        const bool is_convex = cross(ring[b] - ring[a], ring[c] - ring[b]) >= 0;
        const bool is_ear =
            is_convex && std::none_of(left.begin(), left.end(), [&](std::uint32_t other) {
                return other != a && other != b && other != c &&
                       is_within(ring[other], ring[a], ring[b], ring[c]);
            });
        if (!is_ear) {
            ++i;
            ++tried;
            continue;
        }
        triangles.insert(triangles.end(), {a, b, c});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>((i + 1) % count));
        i %= left.size();
        tried = 0;
    }
    return triangles;
}

std::uint32_t add_vertex(Vec position, float across, Colour colour, LineMesh& mesh) {
    constexpr float half_width = 0.5F;
    mesh.vertices.push_back({{static_cast<float>(position.x), static_cast<float>(position.y)},
                             across,
                             0,
                             half_width,
                             1,
                             colour});
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_area(const Ring& inner, const std::vector<Edge>& edges, Colour colour, LineMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Edge& edge : edges) {
        add_vertex(edge.inner, 0, colour, mesh);
        add_vertex(edge.outer, 1, colour, mesh);
    }
    for (const std::uint32_t corner : triangulate(inner))
        mesh.indices.push_back(first + 2 * corner);
    const auto count = static_cast<std::uint32_t>(edges.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t here = first + 2 * i;
        const std::uint32_t next = first + 2 * ((i + 1) % count);
        mesh.indices.insert(mesh.indices.end(), {here, here + 1, next,  //
                                                 next, here + 1, next + 1});
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
    ring = corners_of(clipped(ring, frame));
    double area = area_of(ring);
    if (area < 0) {
        std::reverse(ring.begin(), ring.end());
        area = -area;
    }
    if (ring.size() < 3 || colour.a == 0) return;
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < ring.size(); ++i)
        edges.push_back(edge_at(ring[(i + ring.size() - 1) % ring.size()], ring[i],
                                ring[(i + 1) % ring.size()]));
    if (const std::optional<Ring> inner = inner_ring(ring, edges))
        add_area(*inner, edges, colour, mesh);
    else
        add_sliver(ring, area, colour, frame, mesh);
}

}  // namespace oiler
