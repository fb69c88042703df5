// SPDX-License-Identifier: MIT
#include "trap/truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "oiler/scene/make_world.hpp"

namespace oiler::trap {
namespace {

Point point_of(const Vec3& vector) { return {vector[0], vector[1], vector[2]}; }

void add_force(const SceneForce& force, CoupledBody& body) {
    std::visit(
        [&]<class Force>(const Force& one) {
            if constexpr (requires { one.frequency; })
                body.drives.push_back(
                    {point_of(one.amplitude), 2 * std::acos(Real(-1)) * one.frequency, one.phase});
            else if constexpr (requires { one.velocity; })
                body.winds.push_back({point_of(one.velocity), one.coefficient});
        },
        force.force);
}

/// All bodies of the scene at their start, in the order of its rows.
System system_of(const Scene& scene) {
    System system;
    const World world = make_world(scene, Settings{});
    const auto add = [&](const SceneMatter& matter) {
        const std::size_t row = system.bodies.size();
        CoupledBody& body = system.bodies.emplace_back();
        body.mass = matter.mass;
        body.drag = matter.linear_drag;
        body.quadratic_drag = matter.quadratic_drag;
        body.x = point_of(world.bodies().position(row));
        body.v = point_of(world.bodies().velocity(row));
        if (matter.contact) body.contact = *matter.contact;
    };
    for (const SceneBody& body : scene.bodies) add(body.matter);
    for (const SceneScatter& scatter : scene.scatters)
        for (std::int64_t i = 0; i < scatter.count; ++i) add(scatter.matter);
    for (const SceneSpring& one : scene.springs)
        system.springs.push_back(
            {one.body, one.to, point_of(one.anchor), one.stiffness, one.damping, one.rest_length});
    for (const SceneAttractor& one : scene.attractors)
        system.attractors.push_back({point_of(one.position), one.gm});
    for (const SceneForce& one : scene.forces) add_force(one, system.bodies[one.body]);
    system.surfaces = surfaces_of(scene);
    if (scene.gravity) system.gravity = point_of(*scene.gravity);
    return system;
}

/// The rows of each group of linked bodies.
std::vector<std::vector<std::size_t>> groups_of(const System& system) {
    std::vector<std::size_t> root(system.bodies.size());
    std::iota(root.begin(), root.end(), 0U);
    const auto find = [&](std::size_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (const CoupledSpring& spring : system.springs)
        if (spring.to) root[find(*spring.to)] = find(spring.body);
    std::map<std::size_t, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < root.size(); ++i) groups[find(i)].push_back(i);
    std::vector<std::vector<std::size_t>> list;
    for (auto& [first, rows] : groups) list.push_back(std::move(rows));
    return list;
}

/// The bodies of `rows` alone, with the springs given by `of`, the springs of each body.
System part_of(const System& whole, const std::vector<std::size_t>& rows,
               const std::vector<std::vector<std::size_t>>& springs_of) {
    System part{
        .attractors = whole.attractors, .gravity = whole.gravity, .surfaces = whole.surfaces};
    const auto local = [&](std::size_t row) {
        return static_cast<std::size_t>(std::ranges::lower_bound(rows, row) - rows.begin());
    };
    for (const std::size_t row : rows) {
        part.bodies.push_back(whole.bodies[row]);
        for (const std::size_t i : springs_of[row]) {
            part.springs.push_back(whole.springs[i]);
            CoupledSpring& spring = part.springs.back();
            spring.body = local(spring.body);
            if (spring.to) spring.to = local(*spring.to);
        }
    }
    return part;
}

OscillatorBody oscillator_of(const System& system) {
    const CoupledBody& body = system.bodies[0];
    OscillatorBody one{.c = body.drag / body.mass, .f = system.gravity, .x = body.x, .v = body.v};
    for (const CoupledSpring& spring : system.springs) {
        one.k += spring.stiffness / body.mass;
        one.c += spring.damping / body.mass;
        for (std::size_t axis = 0; axis < 3; ++axis)
            one.centre[axis] += spring.stiffness / body.mass * spring.anchor[axis];
    }
    for (Real& number : one.centre) number = one.k > 0 ? number / one.k : 0;
    return one;
}

bool is_orbit(const System& system) {
    return system.bodies.size() == 1 && system.attractors.size() == 1 && system.springs.empty() &&
           system.gravity == Point{} && system.bodies[0].drag == 0 && !system.has_contacts() &&
           system.bodies[0].quadratic_drag == 0 && system.bodies[0].winds.empty() &&
           system.bodies[0].drives.empty();
}

}  // namespace

Truth::Truth(const Scene& scene, From from, std::size_t most_segments)
    : most_segments_(most_segments) {
    const System whole = system_of(scene);
    size_ = whole.bodies.size();
    std::vector<std::vector<std::size_t>> springs_of(size_);
    for (std::size_t i = 0; i < whole.springs.size(); ++i)
        springs_of[whole.springs[i].body].push_back(i);
    auto oscillators = std::make_unique<Oscillators>();
    std::vector<std::size_t> oscillator_rows;
    for (const auto& rows : groups_of(whole)) {
        const System part = part_of(whole, rows, springs_of);
        if (from == From::best && rows.size() == 1 && part.is_linear()) {
            oscillators->add(oscillator_of(part));
            oscillator_rows.push_back(rows[0]);
        } else {
            add(part, rows, scene.duration, from);
        }
    }
    if (!oscillator_rows.empty()) parts_.push_back({std::move(oscillators), oscillator_rows});
}

void Truth::add(const System& system, const std::vector<std::size_t>& rows, Real duration,
                From from) {
    if (from != From::integration && system.is_linear())
        parts_.push_back({std::make_unique<LinearSystem>(system), rows});
    else if (from == From::best && is_orbit(system))
        parts_.push_back(
            {std::make_unique<Orbit>(system.attractors[0].centre, system.attractors[0].gm,
                                     system.bodies[0].x, system.bodies[0].v),
             rows});
    else
        add_integration(system, rows, duration);
}

void Truth::add_integration(const System& system, const std::vector<std::size_t>& rows,
                            Real duration) {
    auto fine = std::make_unique<Integration>(system, duration, 1e-16L, most_segments_);
    fine->compare_with(Integration(system, duration, 1e-13L, most_segments_));
    parts_.push_back({std::move(fine), rows});
}

Real Truth::shortest_period() const {
    Real shortest = std::numeric_limits<Real>::infinity();
    for (const Part& part : parts_) shortest = std::min(shortest, part.motion->shortest_period());
    return shortest;
}

Real Truth::cost() const {
    Real sum = 0;
    for (const Part& part : parts_)
        sum += part.motion->cost() * static_cast<Real>(part.motion->size());
    return sum;
}

Real Truth::uncertainty() const {
    Real largest = 0;
    for (const Part& part : parts_) largest = std::max(largest, part.motion->uncertainty());
    return largest;
}

void Truth::prepare(std::int64_t rate, std::size_t inside) {
    inside_ = inside;
    samples_.assign(size_ * (inside + 1), Point{});
    buffer_ = samples_;
    for (const Part& part : parts_) part.motion->prepare(rate, inside);
}

const std::vector<Point>& Truth::sample(std::int64_t n) {
    const auto stride = static_cast<std::ptrdiff_t>(inside_ + 1);
    for (const Part& part : parts_) {
        part.motion->sample(n, buffer_.data());
        auto from = buffer_.begin();
        for (const std::size_t row : part.rows) {
            std::copy_n(from, stride, samples_.begin() + static_cast<std::ptrdiff_t>(row) * stride);
            from += stride;
        }
    }
    return samples_;
}

Real Truth::extent(Real duration) {
    const std::size_t inside =
        std::clamp(std::size_t{200'000} / size_, std::size_t{7}, std::size_t{499});
    const auto rate = static_cast<std::int64_t>(std::max(Real(1), std::floor(1 / duration)));
    prepare(rate, inside);
    const auto ticks = static_cast<std::int64_t>(std::ceil(duration * static_cast<Real>(rate)));
    const std::vector<Point> start = sample(0);
    Real largest = 0;
    for (std::int64_t n = 0; n < ticks; ++n) {
        const std::vector<Point>& points = sample(n);
        for (std::size_t row = 0; row < size_; ++row) {
            const Point& from = start[row * (inside + 1)];
            for (std::size_t j = 0; j <= inside; ++j) {
                if (static_cast<Real>(n) + share_of(j, inside) > duration * static_cast<Real>(rate))
                    break;
                const Point& to = points[row * (inside + 1) + j];
                largest = std::max(largest,
                                   std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]));
            }
        }
    }
    return largest;
}

}  // namespace oiler::trap
