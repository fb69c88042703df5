// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace oiler::bench {
namespace {

struct Health {
    int points;
};
struct Shield {
    int strength;
};

/// An operation on a fresh world, timed as a whole.
struct Deed {
    std::string name;
    /// Applies it to each entity that `prepare` has made.
    void (*act)(World& world, std::vector<Entity>& entities);
    void (*prepare)(World& world, std::vector<Entity>& entities);
};

void nothing(World&, std::vector<Entity>&) {}

void create(World& world, std::vector<Entity>& entities) {
    for (Entity& entity : entities) entity = world.create();
}

void spawn(World& world, std::vector<Entity>& entities) {
    for (Entity& entity : entities) entity = world.spawn({});
}

void equip(World& world, std::vector<Entity>& entities) {
    create(world, entities);
    for (const Entity entity : entities) {
        world.add(entity, Health{1});
        world.add(entity, Shield{2});
    }
}

void spawn_shuffled(World& world, std::vector<Entity>& entities) {
    spawn(world, entities);
    std::shuffle(entities.begin(), entities.end(), std::mt19937(1));
}

void iterate_one(World& world, std::vector<Entity>&) {
    int sum = 0;
    world.each<Health>([&](Entity, const Health& health) { sum += health.points; });
    keep(sum);
}

void iterate_two(World& world, std::vector<Entity>&) {
    int sum = 0;
    world.each<Health, Shield>([&](Entity, Health& health, const Shield& shield) {
        sum += health.points += shield.strength;
    });
    keep(sum);
}

void destroy(World& world, std::vector<Entity>& entities) {
    for (const Entity entity : entities) world.destroy(entity);
}

void churn(World& world, std::vector<Entity>& entities) {
    for (Entity& entity : entities) {
        world.destroy(entity);
        entity = world.create();
    }
}

void churn_bodies(World& world, std::vector<Entity>& entities) {
    for (Entity& entity : entities) {
        world.destroy(entity);
        entity = world.spawn({});
    }
}

const std::vector<Deed>& deeds() {
    static const std::vector<Deed> all{
        {"create", create, nothing},
        {"spawn", spawn, nothing},
        {"iterate one component", iterate_one, equip},
        {"iterate two components", iterate_two, equip},
        {"destroy", destroy, create},
        {"destroy bodies", destroy, spawn},
        {"destroy in any order", destroy, spawn_shuffled},
        {"churn", churn, create},
        {"churn bodies", churn_bodies, spawn},
        {"churn in any order", churn_bodies, spawn_shuffled},
    };
    return all;
}

/// The least of several worlds, s.
double seconds_of(const Deed& deed, std::size_t count, int repetitions) {
    double least = INFINITY;
    for (int i = 0; i < repetitions; ++i) {
        World world(3, {.precision = Precision::single});
        world.reserve(count);
        std::vector<Entity> entities(count);
        deed.prepare(world, entities);
        const auto start = std::chrono::steady_clock::now();
        deed.act(world, entities);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        least = std::min(least, took.count());
    }
    return least;
}

/// Limits in ns, at 10⁴ and at 10⁶ entities.
struct Limit {
    std::string_view deed;
    double few;
    double many;
};
/// A body's row costs as much as an entity's slot, so bodies have the same limits. Operations in
/// any order have none, because they access memory at random in any design.
constexpr Limit limits[]{
    {"create", 10, 20},      {"spawn", 10, 20},          {"iterate one component", 0.5, 1},
    {"destroy", 20, 60},     {"destroy bodies", 20, 60}, {"churn", 20, 60},
    {"churn bodies", 20, 60}};

void add_target(Bench& bench, const Deed& deed, std::size_t count, double cost) {
    const auto* const limit = std::ranges::find(limits, deed.name, &Limit::deed);
    if (limit == std::end(limits) || (count != 10'000 && count != 1'000'000)) return;
    bench.report.target({"T6", deed.name + ", " + in_powers(count), cost,
                         at_most(count == 10'000 ? limit->few : limit->many, "ns")});
}

/// The bytes in use by malloc.
double bytes_in_use() {
    const struct mallinfo2 use = mallinfo2();
    return static_cast<double>(use.uordblks + use.hblkhd);
}

double bytes_of(int axes, std::size_t bodies) {
    const double before = bytes_in_use();
    World world(axes, {.precision = Precision::single});
    world.reserve(bodies);
    for (std::size_t i = 0; i < bodies; ++i) keep(world.spawn({}));
    return bytes_in_use() - before;
}

/// The bytes of one more body, without the kilobytes of a world.
void measure_memory(Bench& bench, int axes, double most) {
    constexpr std::size_t few = 1 << 20;
    const double more = bytes_of(axes, 2 * few) - bytes_of(axes, few);
    bench.report.target({"T6", fmt::format("bytes for a body and its handle, {} axes", axes),
                         more / few, at_most(most), "float, from 2²⁰ to 2²¹ bodies"});
}

}  // namespace

void bench_entities(Bench& bench) {
    const int repetitions = bench.full ? 15 : 3;
    for (const std::size_t count : {1000, 10'000, 100'000, 1'000'000}) {
        if (!bench.wants("entities: " + in_powers(count))) continue;
        Row row{in_powers(count), {}};
        for (const Deed& deed : deeds()) {
            const int times = repetitions * (count <= 10'000 ? 20 : 1);
            const double cost =
                Bench::ns(seconds_of(deed, count, times), static_cast<double>(count));
            row.numbers.emplace_back(deed.name, cost);
            add_target(bench, deed, count, cost);
        }
        bench.report.add("Entities, ns each", std::move(row));
    }
}

void bench_memory(Bench& bench) {
    if (!bench.wants("memory")) return;
    measure_memory(bench, 3, 36);
    measure_memory(bench, 2, 28);
}

}  // namespace oiler::bench
