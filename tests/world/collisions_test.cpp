// SPDX-License-Identifier: MIT
#include "oiler/world/collisions.hpp"

#include <random>

#include "oiler/sim/bodies.hpp"
#include "support/dice.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

World world_of(int axes, Precision precision = Precision::double_) {
    return World(axes, {.rate = {60}, .precision = precision});
}
Entity spawn(World& world, const Vec3& position, double radius) {
    return world.spawn({.position = position, .contact = Contact{radius}});
}
/// The pair that touches, if it is the only one.
Collision only_pair(const Collisions& collisions) {
    EXPECT_EQ(collisions.pairs().size(), 1U);
    return collisions.pairs().empty() ? Collision{} : collisions.pairs().front();
}

/// All pairs, by trying each with a search of the smallest distance instead of its formula.
class BruteForce {
public:
    struct Pair {
        Entity a, b;
        double fraction;
        bool touching;
        bool certain;  ///< far from the limit of a touch, compared with round-off
    };

    std::vector<Pair> update(const World& world) {
        std::map<std::uint64_t, Seen> now;
        std::vector<Way> ways;
        for (std::size_t row = 0; row < world.bodies().size(); ++row) {
            const auto contact = world.bodies().contact(row);
            if (!contact) continue;
            const Entity entity = world.entity_of_row(row);
            const Seen seen{world.position(entity), world.jumps(entity)};
            const auto old = before_.find(entity.id());
            const bool moved = old != before_.end() && old->second.jumps == seen.jumps;
            ways.push_back(
                {entity, moved ? old->second.position : seen.position, seen.position, *contact});
            now[entity.id()] = seen;
        }
        before_ = now;
        std::vector<Pair> pairs;
        for (std::size_t i = 0; i < ways.size(); ++i)
            for (std::size_t j = i + 1; j < ways.size(); ++j) try_pair(ways[i], ways[j], pairs);
        return pairs;
    }

private:
    struct Seen {
        Vec3 position;
        std::uint32_t jumps;
    };
    struct Way {
        Entity entity;
        Vec3 start, end;
        Contact contact;
    };

    static long double distance(const Way& a, const Way& b, long double t) {
        long double sum = 0;
        for (int i = 0; i < 3; ++i) {
            const long double at = (1 - t) * a.start[i] + t * a.end[i];
            const long double other = (1 - t) * b.start[i] + t * b.end[i];
            sum += (at - other) * (at - other);
        }
        return std::sqrt(sum);
    }
    /// The distance is a convex function of time: a search of thirds.
    static long double time_of_least(const Way& a, const Way& b) {
        long double low = 0, high = 1;
        for (int i = 0; i < 120; ++i) {
            const long double third = (high - low) / 3;
            (distance(a, b, low + third) <= distance(a, b, high - third) ? high : low) +=
                distance(a, b, low + third) <= distance(a, b, high - third) ? -third : third;
        }
        const long double inside = (low + high) / 2;
        const long double end = distance(a, b, 0) <= distance(a, b, 1) ? 0 : 1;
        return distance(a, b, end) <= distance(a, b, inside) ? end : inside;
    }
    static void try_pair(const Way& a, const Way& b, std::vector<Pair>& pairs) {
        const long double reach = static_cast<long double>(a.contact.radius) + b.contact.radius;
        const double paths = length(a.end - a.start) + length(b.end - b.start);
        if (distance(a, b, 0) > 1.001L * (reach + paths)) return;
        const long double least = time_of_least(a, b);
        const long double gap = distance(a, b, least) - reach;
        const long double noise =
            1e-15L * (reach + distance(a, b, 0) + distance(a, b, 1) + largest(a.end));
        if (gap > noise) return;
        long double low = 0, high = least;
        for (int i = 0; i < 80; ++i) {
            const long double middle = (low + high) / 2;
            (distance(a, b, middle) <= reach ? high : low) = middle;
        }
        pairs.push_back({a.entity, b.entity,
                         distance(a, b, 0) <= reach ? 0 : static_cast<double>(high),
                         distance(a, b, 1) <= reach, gap < -noise || gap == 0});
    }

    std::map<std::uint64_t, Seen> before_;
};

/// Every certain pair is found, in order; no pair is found that is not even uncertain.
void expect_same(const Collisions& found, const std::vector<BruteForce::Pair>& expected) {
    std::size_t next = 0;
    for (const BruteForce::Pair& pair : expected) {
        const bool here = next < found.pairs().size() && found.pairs()[next].a == pair.a &&
                          found.pairs()[next].b == pair.b;
        if (!pair.certain && !here) continue;
        ASSERT_TRUE(here) << "pair of entities " << pair.a.index << ", " << pair.b.index;
        if (pair.certain) {
            EXPECT_NEAR(found.pairs()[next].fraction, pair.fraction, 1e-6);
            EXPECT_EQ(found.pairs()[next].touching, pair.touching);
        }
        ++next;
    }
    EXPECT_EQ(next, found.pairs().size());
}

/// Of any magnitude between two powers of ten.
double power(Dice& random, double low, double high) {
    return std::pow(10, random.uniform(low, high));
}

Vec3 random_vector(Dice& random, int axes, double size) {
    Vec3 vector{};
    for (int i = 0; i < axes; ++i) vector[i] = random.uniform(-size, size);
    return vector;
}

/// The sizes of a random world.
struct Sizes {
    int axes;
    double extent = 10;  ///< m
    double least_radius = -1;
    double greatest_radius = 0;  ///< powers of ten
};

void spawn_random(World& world, Dice& random, const Sizes& sizes) {
    const Entity entity =
        world.spawn({.position = random_vector(random, sizes.axes, sizes.extent)});
    if (random.chance(0.9))
        world.set_contact(entity, Contact{random.chance(0.1) ? 0
                                                             : power(random, sizes.least_radius,
                                                                     sizes.greatest_radius)});
}

/// Moves some bodies a little, some far; some jump, some are replaced.
void change(World& world, Dice& random, const Sizes& sizes) {
    for (std::size_t row = world.bodies().size(); row-- > 0;) {
        const Entity entity = world.entity_of_row(row);
        const Vec3 place = random_vector(random, sizes.axes, sizes.extent);
        const double kind = random.uniform(0, 1);
        if (kind < 0.3) world.set_position(entity, place);
        if (kind > 0.5) world.set_position(entity, world.position(entity) + place * 0.01);
        if (kind > 0.8) world.teleport(entity, place);
        if (kind > 0.85) world.destroy(entity);
        if (kind > 0.95) spawn_random(world, random, sizes);
        if (kind > 0.3 && kind < 0.35) world.set_contact(entity, Contact{});
        if (kind > 0.35 && kind < 0.4) world.set_contact(entity, std::nullopt);
    }
    for (int i = 0; i < 3; ++i) spawn_random(world, random, sizes);
}

void compare_with_brute_force(unsigned seed, const Sizes& sizes, std::size_t bodies) {
    Dice random(seed);
    World world = world_of(sizes.axes, seed % 2 == 0 ? Precision::double_ : Precision::single);
    Collisions collisions;
    BruteForce brute_force;
    for (std::size_t i = 0; i < bodies; ++i) spawn_random(world, random, sizes);
    for (int i = 0; i < 4; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", update " + std::to_string(i));
        collisions.update(world);
        expect_same(collisions, brute_force.update(world));
        change(world, random, sizes);
    }
}

TEST(Collisions, AreThoseOfBruteForce) {
    for (unsigned seed = 0; seed < 2000; ++seed)
        compare_with_brute_force(seed, {.axes = static_cast<int>(seed % 3) + 1, .extent = 8},
                                 seed % 23);
}

TEST(Collisions, AreThoseOfBruteForceAtAllSizes) {
    for (unsigned seed = 0; seed < 600; ++seed) {
        Dice random(seed);
        const double scale = random.uniform(-12, 12);
        compare_with_brute_force(seed,
                                 {.axes = static_cast<int>(seed % 3) + 1,
                                  .extent = std::pow(10, scale),
                                  .least_radius = scale - random.uniform(0, 12),
                                  .greatest_radius = scale - random.uniform(0, 2)},
                                 20);
    }
}

TEST(Collisions, AreThoseOfBruteForceInALargeWorld) {
    for (const int axes : {1, 2, 3})
        compare_with_brute_force(2, {.axes = axes, .extent = axes == 1 ? 500.0 : 20.0}, 600);
}

TEST(Collisions, FindFastBodiesThatPassEachOther) {
    World world = world_of(2);
    const Entity target = spawn(world, {0, 0}, 0.5);
    const Entity bullet =
        world.spawn({.position = {-50, 0}, .velocity = {6000, 0}, .contact = Contact{0.25}});
    spawn(world, {0, 0.76}, 0);
    Collisions collisions;
    collisions.update(world);
    EXPECT_TRUE(collisions.pairs().empty());
    world.step();
    collisions.update(world);
    const Collision pair = only_pair(collisions);
    EXPECT_EQ(pair.a, target);
    EXPECT_EQ(pair.b, bullet);
    EXPECT_NEAR(pair.fraction, (50 - 0.75) / 100, 1e-14);
    EXPECT_FALSE(pair.touching);
    collisions.update(world);
    EXPECT_TRUE(collisions.pairs().empty());
}

TEST(Collisions, TouchAtTheSumOfTheRadii) {
    World world = world_of(3);
    spawn(world, {1, 1, 1}, 2);
    const Entity other = spawn(world, {4, 5, 1}, 3);
    Collisions collisions;
    collisions.update(world);
    EXPECT_TRUE(only_pair(collisions).touching);
    world.teleport(other, {4, std::nextafter(5, 6), 1});
    collisions.update(world);
    EXPECT_TRUE(collisions.pairs().empty());
    world.teleport(other, {-100, 1, 6});
    collisions.update(world);
    world.set_position(other, {200, 1, 6});
    collisions.update(world);
    EXPECT_NEAR(only_pair(collisions).fraction, 101.0 / 300, 1e-9) << "a graze";
}

TEST(Collisions, OfPointsAreMeetingsInOnePlace) {
    World world = world_of(2);
    const Entity one = spawn(world, {1, 2}, 0);
    const Entity other = spawn(world, {1, 2}, 0);
    Collisions collisions;
    collisions.update(world);
    EXPECT_TRUE(only_pair(collisions).touching);
    world.teleport(one, {-1, 0});
    world.teleport(other, {-1, 4});
    collisions.update(world);
    EXPECT_TRUE(collisions.pairs().empty());
    world.set_position(one, {3, 4});
    world.set_position(other, {3, 0});
    collisions.update(world);
    EXPECT_EQ(only_pair(collisions).fraction, 0.5);
}

TEST(Collisions, KnowBodiesByTheirEntities) {
    World world = world_of(1);
    const Entity first = spawn(world, {-10}, 1);
    spawn(world, {0}, 1);
    const Entity last = spawn(world, {10}, 1);
    Collisions collisions;
    collisions.update(world);
    world.destroy(first);
    EXPECT_EQ(world.row(last), 0U);
    collisions.update(world);
    EXPECT_TRUE(collisions.pairs().empty()) << "the last row moved to the first";
    const Entity reborn = spawn(world, {-10}, 1);
    EXPECT_EQ(reborn.index, first.index);
    collisions.update(world);
    world.destroy(reborn);
    EXPECT_EQ(spawn(world, {20}, 1).index, first.index);
    collisions.update(world);
    EXPECT_TRUE(collisions.pairs().empty()) << "another entity has the slot";
}

TEST(Collisions, DoNotSweepJumpsAndAbsences) {
    World world = world_of(1);
    const Entity mover = spawn(world, {-10}, 1);
    spawn(world, {0}, 1);
    Collisions collisions;
    collisions.update(world);
    world.teleport(mover, {10});
    collisions.update(world);
    EXPECT_TRUE(collisions.pairs().empty());
    world.remove_body(mover);
    collisions.update(world);
    world.add_body(mover, {.position = {-10}, .contact = Contact{1}});
    collisions.update(world);
    EXPECT_TRUE(collisions.pairs().empty());
    world.set_position(mover, {10});
    collisions.update(world);
    EXPECT_EQ(collisions.pairs().size(), 1U);
}

TEST(Collisions, AreInTheOrderOfTheRows) {
    World world = world_of(2);
    for (int i = 0; i < 20; ++i)
        spawn(world, {i * 0.37 - i % 7, i % 5 * 0.4}, 4e-3 * (1 << i % 10));
    Collisions collisions;
    collisions.update(world);
    ASSERT_GE(collisions.pairs().size(), 20U);
    std::pair<std::size_t, std::size_t> before{0, 0};
    for (const Collision& pair : collisions.pairs()) {
        const std::pair rows(world.row(pair.a), world.row(pair.b));
        EXPECT_LT(rows.first, rows.second);
        EXPECT_LT(before, rows);
        before = rows;
    }
}

struct Ball {
    int hits = 0;
};
struct Target {};

// Two balls, two targets and a bystander in one place: four pairs of a ball and a target.
TEST(Collisions, AreVisitedByComponentsInEitherOrder) {
    World world = world_of(2);
    std::vector<Entity> entities;
    for (int i = 0; i < 5; ++i) entities.push_back(spawn(world, {}, 1));
    for (const std::size_t i : {0U, 3U}) world.add(entities[i], Ball{});
    for (const std::size_t i : {1U, 4U}) world.add(entities[i], Target{});
    Collisions collisions;
    collisions.update(world);
    ASSERT_EQ(collisions.pairs().size(), 10U);
    std::vector<std::pair<Entity, Entity>> met;
    collisions.each<Ball, Target>(world, [&](Entity ball, Ball& by, Entity target, Target&) {
        ++by.hits;
        met.emplace_back(ball, target);
    });
    const std::vector<std::pair<Entity, Entity>> expected{{entities[0], entities[1]},
                                                          {entities[0], entities[4]},
                                                          {entities[3], entities[1]},
                                                          {entities[3], entities[4]}};
    std::ranges::sort(
        met, {}, [](const auto& pair) { return std::pair(pair.first.index, pair.second.index); });
    EXPECT_EQ(met, expected);
    EXPECT_EQ(world.get<Ball>(entities[0]).hits, 2);

    int visited = 0;
    collisions.each<Ball, Target>(world, [&](Entity, Ball&, Entity target, Target&) {
        ++visited;
        world.destroy(target);
    });
    EXPECT_EQ(visited, 2) << "a target is destroyed by the first ball";
    int twins = 0;
    collisions.each<Ball, Ball>(world, [&](Entity a, Ball&, Entity b, Ball&) {
        ++twins;
        EXPECT_EQ(a, entities[0]);
        EXPECT_EQ(b, entities[3]);
    });
    EXPECT_EQ(twins, 1);
}

TEST(Collisions, WorkAtTheLimitsOfNumbers) {
    constexpr double most = std::numeric_limits<double>::max();
    constexpr double least = std::numeric_limits<double>::denorm_min();
    World world = world_of(3);
    const Entity huge = spawn(world, {most, -most, 0}, most);
    spawn(world, {-most, most, 0}, 1);
    spawn(world, {most / 2, -most, 0}, 0);
    const Entity tiny = spawn(world, {}, 0);
    const Entity near = spawn(world, {least}, 0);
    Collisions collisions;
    collisions.update(world);
    EXPECT_EQ(only_pair(collisions).a, huge);
    world.set_contact(near, Contact{least});
    world.set_position(huge, {-most, most, 0});
    collisions.update(world);
    ASSERT_EQ(collisions.pairs().size(), 5U);
    EXPECT_EQ(collisions.pairs().back().a, tiny);
    EXPECT_EQ(collisions.pairs().back().b, near);
}

TEST(Collisions, LeaveOutBodiesThatAreNotFinite) {
    World world(1, {.rate = {1}, .precision = Precision::extended});
    spawn(world, {0}, 1);
    const Entity second = spawn(world, {0.5}, 1);
    const Entity lost = world.spawn({.velocity = {1e308}, .contact = Contact{1}});
    Collisions collisions;
    collisions.update(world);
    EXPECT_EQ(collisions.pairs().size(), 3U);
    for (int i = 0; i < 2; ++i) {
        world.step(20);
        collisions.update(world);
        EXPECT_EQ(world.position(lost)[0], INFINITY);
        EXPECT_EQ(only_pair(collisions).b, second);
    }
}

TEST(Collisions, AreFastAmongVeryDifferentBodies) {
    Dice random(1);
    World world = world_of(2);
    for (int i = 0; i < 20'000; ++i) spawn(world, random_vector(random, 2, 1e3), 0.1);
    for (int i = 0; i < 20; ++i) spawn(world, random_vector(random, 2, 1e9), power(random, -9, 12));
    const Entity fast = spawn(world, {-1e4, 0}, 2);
    Collisions collisions;
    collisions.update(world);
    world.set_position(fast, {1e4, 1});
    collisions.update(world);
    const auto of_fast = std::ranges::count(collisions.pairs(), fast, &Collision::b);
    EXPECT_GT(of_fast, 20);
    EXPECT_LT(of_fast, 1000);
}

}  // namespace
}  // namespace oiler::test
