// SPDX-License-Identifier: MIT
#include "oiler/stability/oscillations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

/// A spring or damper along the line `d`, m, with a part in all directions.
Coupling along_line(std::size_t a, std::size_t b, const Vec3& d, double coefficient, double all) {
    const Direction<double, 3> line(d);
    const double total = std::max(coefficient, 0.0);
    if (!(line.length > 0) || !std::isfinite(line.length)) return {a, b, {}, 0, total};
    const double across = std::clamp(all, 0.0, total);
    return {a, b, line.unit, total - across, across};
}

/// The tension of a spring per length, which is its stiffness across its line, N/m.
double tension(double stiffness, double rest_length, const Vec3& d) {
    return stiffness * (1 - rest_length / std::sqrt(squared_length(d)));
}

/// Adds a spring of the body `index` at `position`.
void add_line_spring(std::size_t index, const Vec3& position, double mass,
                     const CoilSpring& per_mass, Component& to) {
    if (per_mass.stiffness == 0 && per_mass.damping == 0) return;
    const Vec3 d = position - per_mass.anchor;
    const double k = per_mass.stiffness * mass;
    to.springs.push_back(
        along_line(index, Coupling::ground, d, k, tension(k, per_mass.rest_length, d)));
    if (per_mass.damping > 0)
        to.dampers.push_back(along_line(index, Coupling::ground, d, per_mass.damping * mass, 0));
}

void add_body(const Bodies& bodies, std::size_t row, Component& to) {
    const std::size_t index = to.rows.size();
    const double mass = bodies.mass(row);
    double stiffness = 0;
    double drag = 0;
    for_each_force_on(bodies, row, [&]<class Force>(const Force& force) {
        if constexpr (Linear<Force>) {
            stiffness += linear_form(force).stiffness * mass;
            drag += linear_form(force).damping;
        } else if constexpr (LineSpring<Force>) {
            add_line_spring(index, bodies.position(row), mass, force.line_spring(), to);
        }
    });
    if (stiffness > 0) to.springs.push_back({index, Coupling::ground, {}, 0, stiffness});
    to.drag.push_back(std::max(drag, 0.0));
    to.inverse_root_mass.push_back(1 / std::sqrt(mass));
    to.rows.push_back(row);
}

/// Adds a link of body `a` of the component with body `b`, or with a point: then `b` is `ground`.
void add_link(const Bodies& bodies, std::size_t i, std::size_t a, std::size_t b, Component& to) {
    const Link link = bodies.link_at(i);
    const Vec3 d =
        bodies.position(to.rows[a]) -
        (b == Coupling::ground ? bodies.link_ends(i).point : bodies.position(to.rows[b]));
    const bool everywhere = link.rest_length == 0;
    const auto add = [&](std::vector<Coupling>& couplings, double coefficient, double all) {
        couplings.push_back(along_line(a, b, d, coefficient, all));
        couplings.back().is_rope = link.pulls_only;
    };
    add(to.springs, link.stiffness,
        everywhere ? link.stiffness : tension(link.stiffness, link.rest_length, d));
    if (link.damping > 0) add(to.dampers, link.damping, everywhere ? link.damping : 0);
}

}  // namespace

std::vector<OwnMotion> own_motions(const Bodies& bodies) {
    std::vector<OwnMotion> own(bodies.size());
    for (std::size_t row = 0; row < own.size(); ++row)
        for_each_force_on(bodies, row, [&of = own[row]]<class Force>(const Force& force) {
            if constexpr (Linear<Force>) {
                const auto one = linear_form(force);
                of.linear = {of.linear.k + one.stiffness, of.linear.c + one.damping};
                of.all = {of.all.k + one.stiffness, of.all.c + one.damping};
            } else if constexpr (LineSpring<Force>) {
                const auto one = force.line_spring();
                of.has_lines = of.has_lines || one.stiffness != 0 || one.damping != 0;
                of.all = {of.all.k + one.stiffness, of.all.c + one.damping};
            }
        });
    return own;
}

std::vector<BodyOscillation> oscillations(const Bodies& bodies, bool dampers_split) {
    std::vector<Oscillation> all;
    for (const OwnMotion& own : own_motions(bodies))
        all.push_back({own.all.k, dampers_split ? own.linear.c : own.all.c});
    const auto add = [&](std::size_t row, const Link& link) {
        all[row].k += link.stiffness / bodies.mass(row);
        if (!dampers_split) all[row].c += link.damping / bodies.mass(row);
    };
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const LinkEnds ends = bodies.link_ends(i);
        add(ends.row, bodies.link_at(i));
        if (ends.other) add(*ends.other, bodies.link_at(i));
    }
    const std::vector<bool> linked = bodies.linked_rows();
    std::vector<BodyOscillation> found;
    for (std::size_t row = 0; row < all.size(); ++row)
        if (!linked[row]) found.push_back({row, std::nullopt, all[row]});
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const auto [a, b, point] = bodies.link_ends(i);
        const Oscillation other = b ? all[*b] : Oscillation{};
        found.push_back({a, b, {all[a].k + other.k, all[a].c + other.c}});
    }
    return found;
}

Vec3 Component::between(const Coupling& coupling, const WeightedVectors& u) const {
    Vec3 d = u[coupling.a] * inverse_root_mass[coupling.a];
    if (coupling.b != Coupling::ground) d = d - u[coupling.b] * inverse_root_mass[coupling.b];
    return d;
}

void Component::add_product(const Coupling& coupling, const WeightedVectors& u, double scale,
                            WeightedVectors& to) const {
    const Vec3 d = between(coupling, u);
    const Vec3 force =
        coupling.direction * (coupling.along * dot(coupling.direction, d)) + d * coupling.all;
    to[coupling.a] = to[coupling.a] + force * (scale * inverse_root_mass[coupling.a]);
    if (coupling.b != Coupling::ground)
        to[coupling.b] = to[coupling.b] - force * (scale * inverse_root_mass[coupling.b]);
}

double Component::energy(const Coupling& coupling, const WeightedVectors& u) const {
    const Vec3 d = between(coupling, u);
    const double along = dot(coupling.direction, d);
    return coupling.along * along * along + coupling.all * squared_length(d);
}

const Coupling* Component::most_strained(const WeightedVectors& u) const {
    const Coupling* strained = nullptr;
    double most = 0;
    for (const auto* couplings : {&springs, &dampers})
        for (const Coupling& coupling : *couplings)
            if (const double held = energy(coupling, u); held > most) {
                most = held;
                strained = &coupling;
            }
    return strained;
}

std::vector<std::size_t> component_labels(const Bodies& bodies) {
    std::vector<std::size_t> label(bodies.size());
    std::iota(label.begin(), label.end(), std::size_t{0});
    const auto root = [&](std::size_t row) {
        while (label[row] != row) row = label[row] = label[label[row]];
        return row;
    };
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const LinkEnds ends = bodies.link_ends(i);
        if (!ends.other) continue;
        const std::size_t one = root(ends.row);
        const std::size_t other = root(*ends.other);
        label[std::max(one, other)] = std::min(one, other);
    }
    for (std::size_t row = 0; row < label.size(); ++row) label[row] = root(row);
    return label;
}

Component component_of_row(const Bodies& bodies, std::size_t row) {
    Component component{.axes = bodies.axes()};
    add_body(bodies, row, component);
    return component;
}

std::vector<Component> linked_components(const Bodies& bodies,
                                         const std::vector<std::size_t>& labels) {
    constexpr std::size_t none = Coupling::ground;
    const std::vector<bool> linked = bodies.linked_rows();
    std::vector<Component> all;
    std::vector<std::size_t> component(labels.size(), none);
    std::vector<std::size_t> place(labels.size(), none);
    for (std::size_t row = 0; row < labels.size(); ++row) {
        if (!linked[row]) continue;
        const std::size_t label = labels[row];
        if (label == row) {
            component[row] = all.size();
            all.push_back({.axes = bodies.axes()});
        }
        component[row] = component[label];
        place[row] = all[component[row]].rows.size();
        add_body(bodies, row, all[component[row]]);
    }
    for (const std::size_t i : bodies.damping_order()) {
        const LinkEnds ends = bodies.link_ends(i);
        add_link(bodies, i, place[ends.row], ends.other ? place[*ends.other] : Coupling::ground,
                 all[component[ends.row]]);
    }
    return all;
}

}  // namespace oiler
