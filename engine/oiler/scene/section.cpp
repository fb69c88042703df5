// SPDX-License-Identifier: MIT
#include "oiler/scene/section.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/core/nearest.hpp"
#include "oiler/core/require.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/sim/limits.hpp"

namespace oiler {
namespace {

/// Adds place and key to the error that `f` throws.
template <class F>
void at(const Place& place, std::string_view key, F f) {
    try {
        f();
    } catch (const Error& error) {
        refuse(place, "{}: {}", key, error.what());
    }
}

/// Checks values against the limits of the scene's precision.
template <class... Checked>
void check_at(const Scene& scene, const Section& section, std::string_view key,
              const Checked&... checked) {
    at(section.place(key), fmt::format("{}.{}", section.name(), key),
       [&] { Limits(scene.stepping.precision, scene.axes).check(checked...); });
}

void check_size(const Scene& scene, const Section& section) {
    if (scene.body_count() > most_bodies)
        refuse(section.place("count"),
               "{}.count: expected at most {} bodies in the scene, got {}; give fewer",
               section.name(), most_bodies, scene.body_count());
}

/// Checks a box from `low` to `high`.
void check_box(const Scene& scene, const Section& section, std::string_view key, const Vec3& low,
               const Vec3& high) {
    check_numbers(scene, section, key, high);
    check_numbers(scene, section, key, high - low);
    for (int i = 0; i < scene.axes; ++i)
        if (high[i] < low[i])
            refuse(section.place(key), "{}.{}: expected at least {} along {}, got {}",
                   section.name(), key, low[i], axis_names[static_cast<std::size_t>(i)], high[i]);
}

}  // namespace

Section::Section(std::string_view file, std::string_view name, const Value& value)
    : file_(file), name_(name), value_(value) {
    if (value.kind != ValueKind::table)
        refuse({file, value.line}, "{}: expected a table, got {}; write {}", name, value.shown(),
               scene_table(name).is_repeated() ? fmt::format("[[{}]]", name)
                                               : fmt::format("[{}]", name));
    for (const Value& member : value.items)
        if (!find_scene_key(name, member.key)) refuse_unknown(member);
}

void Section::refuse_unknown(const Value& member) const {
    std::vector<std::string_view> names;
    std::string tables;
    for (const SceneKey& key : scene_keys()) {
        if (key.table == name_) names.push_back(key.name);
        if (key.name == member.key) tables += fmt::format(" [{}]", key.table);
    }
    std::string remedy = did_you_mean(member.key, names);
    if (remedy.empty() && !tables.empty()) remedy = "; it is a key of" + tables;
    if (remedy.empty()) remedy = fmt::format("; it has {}", fmt::join(names, ", "));
    refuse({file_, member.line}, "{}.{}: [{}] has no such key{}", name_, printable(member.key),
           name_, remedy);
}

std::string Section::example(const SceneKey& key) const {
    constexpr std::array<std::string_view, 3> vectors{"[1.0]", "[1.0, 2.0]", "[1.0, 2.0, 3.0]"};
    constexpr std::array<std::string_view, 3> more{"[2.0]", "[2.0, 1.0]", "[2.0, 1.0, 3.0]"};
    const auto i = static_cast<std::size_t>(axes_ - 1);
    if (key.kind == KeyKind::vector) return fmt::format("{} = {}", key.name, vectors[i]);
    if (key.kind == KeyKind::points)
        return fmt::format("{} = [{}, {}]", key.name, vectors[i], more[i]);
    return fmt::format("{} = {}", key.name, key.value);
}

void Section::refuse_value(const SceneKey& key, const Value& value, std::string_view hint) const {
    refuse({file_, value.line}, "{}.{}: expected {}, got {}{}; for example {}", key.table, key.name,
           expectation(key, axes_), value.shown(), hint, example(key));
}

const SceneKey& Section::entry(std::string_view key) const {
    const SceneKey* const found = find_scene_key(name_, key);
    require(found, "scene_keys() lacks a key that is read");
    return *found;
}

bool Section::has(std::string_view key) const { return value_.find(key) != nullptr; }

Place Section::place(std::string_view key) const {
    const Value* const found = value_.find(key);
    return {file_, found ? found->line : value_.line};
}

const Value* Section::find(const SceneKey& key) const {
    const Value* const found = value_.find(key.name);
    if (!found && key.required())
        refuse(place(), "{}.{}: missing; [{}] needs {}, for example {}", key.table, key.name,
               key.table, expectation(key, axes_), example(key));
    return found;
}

double Section::number(const SceneKey& key, const Value& value) const {
    const bool is_number = value.kind == ValueKind::number || value.kind == ValueKind::whole;
    if (!is_number || !std::isfinite(value.number) || !key.range.holds(value.number))
        refuse_value(key, value);
    return value.number;
}

std::int64_t Section::whole(const SceneKey& key, const Value& value) const {
    if (value.kind != ValueKind::whole || !key.range.holds(value.number)) refuse_value(key, value);
    return value.whole;
}

const std::string& Section::text(const SceneKey& key, const Value& value) const {
    if (value.kind != ValueKind::text) refuse_value(key, value);
    return value.text;
}

const std::string& Section::printed(const SceneKey& key, const Value& value,
                                    std::size_t longest) const {
    const std::string& read = text(key, value);
    if (read.size() > longest)
        refuse({file_, value.line}, "{}.{}: expected a text of at most {} bytes, got {}", name_,
               key.name, longest, read.size());
    for (const char c : read)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
            refuse({file_, value.line}, "{}.{}: control character 0x{:02x}; leave it out", name_,
                   key.name, static_cast<unsigned char>(c));
    return read;
}

Vec3 Section::vector(const SceneKey& key, const Value& value) const {
    if (value.kind != ValueKind::list || value.items.size() != static_cast<std::size_t>(axes_))
        refuse_value(key, value);
    Vec3 read{};
    for (std::size_t i = 0; i < value.items.size(); ++i) read.axis[i] = number(key, value.items[i]);
    return read;
}

void Section::read(std::string_view key, std::string& target) const {
    constexpr std::size_t longest = 200;
    if (const Value* const value = find(entry(key))) target = printed(entry(key), *value, longest);
}

void Section::read(std::string_view key, std::int64_t& target) const {
    if (const Value* const value = find(entry(key))) target = whole(entry(key), *value);
}

void Section::read(std::string_view key, double& target) const {
    if (const Value* const value = find(entry(key))) target = number(entry(key), *value);
}

void Section::read(std::string_view key, bool& target) const {
    const Value* const value = find(entry(key));
    if (!value) return;
    if (value->kind != ValueKind::flag) refuse_value(entry(key), *value);
    target = value->flag;
}

void Section::read(std::string_view key, Vec3& target) const {
    if (const Value* const value = find(entry(key))) target = vector(entry(key), *value);
}

void Section::read(std::string_view key, std::vector<Vec3>& target) const {
    const Value* const value = find(entry(key));
    if (!value) return;
    if (value->kind != ValueKind::list) refuse_value(entry(key), *value);
    for (const Value& item : value->items) target.push_back(vector(entry(key), item));
}

void Section::read(std::string_view key, std::vector<std::string>& target) const {
    const Value* const value = find(entry(key));
    if (!value) return;
    if (value->kind != ValueKind::list) refuse_value(entry(key), *value);
    for (const Value& item : value->items)
        target.push_back(printed(entry(key), item, most_toml_bytes));
}

void Section::read(std::string_view key, std::array<std::int64_t, 2>& target) const {
    const Value* const value = find(entry(key));
    if (!value) return;
    if (value->kind != ValueKind::list || value->items.empty() || value->items.size() > 2)
        refuse_value(entry(key), *value);
    for (std::size_t i = 0; i < value->items.size(); ++i)
        target[i] = whole(entry(key), value->items[i]);
}

void Section::read(std::string_view key, Colour& target) const {
    const Value* const value = find(entry(key));
    if (!value) return;
    const std::optional<Colour> colour = find_colour(text(entry(key), *value));
    if (!colour) refuse_value(entry(key), *value, did_you_mean(value->text, colour_names()));
    target = *colour;
}

std::string Section::word(std::string_view key) const {
    const SceneKey& known = entry(key);
    const Value* const value = find(known);
    if (!value) return {};
    const std::vector<std::string_view> words = known.words();
    if (std::ranges::find(words, text(known, *value)) == words.end())
        refuse_value(known, *value, did_you_mean(value->text, words));
    return value->text;
}

void check_number(const Scene& scene, const Section& section, std::string_view key, double number) {
    check_at(scene, section, key, number, key);
}

void check_numbers(const Scene& scene, const Section& section, std::string_view key,
                   const Vec3& vector) {
    check_at(scene, section, key, vector, key);
}

void check_matter(const Scene& scene, const Section& section, const SceneMatter& matter) {
    check_number(scene, section, "mass", matter.mass);
    check_at(scene, section, "mass", 1 / matter.mass, "the inverse mass");
    check_at(scene, section, "linear_drag", given(LinearDrag{matter.linear_drag}), matter.mass);
    check_at(scene, section, "quadratic_drag", given(QuadraticDrag{matter.quadratic_drag}),
             matter.mass);
    if (matter.contact) check_at(scene, section, "contact", Contact{*matter.contact});
}

void check_spring(const Scene& scene, const Section& section, const SceneSpring& spring) {
    const double mass = scene.bodies[spring.body].matter.mass;
    check_numbers(scene, section, "anchor", spring.anchor);
    check_at(scene, section, "stiffness", given(Spring{.stiffness = spring.stiffness}), mass);
    check_at(scene, section, "damping", given(Spring{.damping = spring.damping}), mass);
    check_at(scene, section, "rest_length",
             Link{spring.stiffness, spring.damping, spring.rest_length});
    check_at(scene, section, "pulls_only", link_of(spring));
}

void check_force(const Scene& scene, const Section& section, const SceneForce& force) {
    const double mass = scene.bodies[force.body].matter.mass;
    std::visit(
        [&]<class Force>(const Force& all) {
            for_each_field<Force>([&](const auto& field) {
                Force one{};
                one.*field.member = all.*field.member;
                check_at(scene, section, field.key, given(one), mass);
            });
        },
        force.force);
}

void check_plane(const Scene& scene, const Section& section, const Plane& plane) {
    Obstacle obstacle{.shape = HalfSpaceShape{plane.normal}};
    check_obstacle(scene, section, "normal", obstacle);
    obstacle.shape = HalfSpaceShape{plane.normal, plane.offset};
    check_obstacle(scene, section, "offset", obstacle);
    obstacle.friction = plane.friction;
    check_obstacle(scene, section, "friction", obstacle);
}

void check_obstacle(const Scene& scene, const Section& section, std::string_view key,
                    const Obstacle& obstacle) {
    check_at(scene, section, key, obstacle);
}

void check_grid(const Scene& scene, const Section& section, const SceneGrid& grid) {
    check_size(scene, section);
    if (scene.axes == 1 && grid.count[1] > 1)
        refuse(section.place("count"),
               "grid.count: expected one row with one axis, got {} rows; give axes = 2",
               grid.count[1]);
    check_matter(scene, section, grid.matter);
    check_numbers(scene, section, "origin", grid.origin);
    check_numbers(scene, section, "velocity", grid.velocity);
    check_numbers(scene, section, "spacing",
                  node_position(grid, grid.count[0] - 1, grid.count[1] - 1));
    const Spring hung{.stiffness = grid.stiffness, .damping = grid.damping};
    check_at(scene, section, "stiffness", given(hung), grid.matter.mass);
    for (const GridLink& link : links_of(grid)) check_at(scene, section, "rest_length", link.link);
}

void check_scatter(const Scene& scene, const Section& section, const SceneScatter& scatter) {
    check_size(scene, section);
    check_matter(scene, section, scatter.matter);
    check_numbers(scene, section, "position_from", scatter.position_from);
    check_numbers(scene, section, "velocity_from", scatter.velocity_from);
    check_box(scene, section, "position_to", scatter.position_from, scatter.position_to);
    check_box(scene, section, "velocity_to", scatter.velocity_from, scatter.velocity_to);
}

void check_forces(const Scene& scene, const Place& place) {
    std::vector<std::int64_t> springs(scene.bodies.size() + 1);
    for (const SceneSpring& spring : scene.springs)
        if (!spring.is_link()) ++springs[spring.body];
    for (const SceneForce& force : scene.forces) ++springs[force.body];
    const std::int64_t forces = std::ranges::max(springs) + std::ssize(scene.attractors);
    if (forces * scene.body_count() > most_forces)
        refuse(place,
               "expected at most {} forces, got {} forces of one body and attractors for "
               "each of {} bodies; give fewer",
               most_forces, forces, scene.body_count());
}

void check_method(const Scene& scene, const Place& place) {
    Scene small = scene;  // with few bodies: the method depends on the forces alone
    for (SceneGrid& grid : small.grids)
        for (std::int64_t& count : grid.count) count = std::min<std::int64_t>(count, 2);
    for (SceneScatter& scatter : small.scatters) scatter.count = 1;
    at(place, "scene.method",
       [&] { make_world(small, Settings{small.stepping}).require_applicable(); });
}

}  // namespace oiler
