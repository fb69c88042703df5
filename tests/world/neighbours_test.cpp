// SPDX-License-Identifier: MIT
#include "oiler/world/neighbours.hpp"

#include <random>

#include "oiler/sim/bodies.hpp"
#include "support/dice.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double most = std::numeric_limits<double>::max();

World world_of(int axes, Precision precision = Precision::double_) {
    return World(axes, {.rate = {60}, .precision = precision});
}
Vec3 random_vector(Dice& random, int axes, double size) {
    Vec3 vector{};
    for (int i = 0; i < axes; ++i) vector[i] = random.uniform(-size, size);
    return vector;
}

std::vector<Entity> brute_force(const World& world, const Vec3& point, double radius) {
    std::vector<Entity> near;
    for (std::size_t row = 0; row < world.bodies().size(); ++row) {
        const Vec3 x = world.bodies().position(row);
        long double distance = 0;
        for (int i = 0; i < world.bodies().axes(); ++i)
            distance = std::hypot(distance, static_cast<long double>(x[i]) - point[i]);
        if (distance <= radius) near.push_back(world.entity_of_row(row));
    }
    return near;
}

/// Both queries find the same as brute force.
std::size_t expect_same(const World& world, const Neighbours& neighbours, const Vec3& point,
                        double radius) {
    const std::vector<Entity> expected = brute_force(world, point, radius);
    EXPECT_EQ(neighbours.within(point, radius), expected) << radius;
    EXPECT_EQ(world.within(point, radius), expected) << radius;
    return expected.size();
}

TEST(Neighbours, AreThoseOfBruteForce) {
    std::size_t found = 0;
    for (unsigned seed = 0; seed < 2000; ++seed) {
        Dice random(seed);
        const int axes = static_cast<int>(seed % 3) + 1;
        World world = world_of(axes, static_cast<Precision>(seed / 3 % 3));
        Neighbours neighbours;
        for (unsigned i = 0; i < seed % 97; ++i) {
            const double size = seed % 2 == 0 ? 10 : std::pow(10, random.uniform(-9, 9));
            static_cast<void>(world.spawn({.position = random_vector(random, axes, size)}));
        }
        neighbours.update(world);
        for (int i = 0; i < 20; ++i)
            found += expect_same(world, neighbours, random_vector(random, 3, 10),
                                 std::pow(10, random.uniform(-3, 2)));
    }
    EXPECT_GT(found, 100'000U);
}

TEST(Neighbours, AreThoseOfBruteForceInALargeWorld) {
    for (const int axes : {1, 2, 3}) {
        Dice random(1);
        World world = world_of(axes);
        for (int i = 0; i < 20'000; ++i)
            static_cast<void>(
                world.spawn({.position = random_vector(random, axes, i % 100 == 0 ? 1e9 : 1e3)}));
        Neighbours neighbours;
        neighbours.update(world);
        for (const double radius : {0.0, 1.0, 30.0, 1e3, 1e6, 1e10})
            for (int i = 0; i < 10; ++i)
                expect_same(world, neighbours, random_vector(random, axes, 1e3), radius);
    }
}

TEST(Neighbours, AreInAClosedBall) {
    World world = world_of(2);
    const Entity at = world.spawn({.position = {3, 4}});
    Neighbours neighbours;
    neighbours.update(world);
    EXPECT_EQ(expect_same(world, neighbours, {0, 0}, 5), 1U);
    EXPECT_EQ(expect_same(world, neighbours, {0, 0}, std::nextafter(5, 0)), 0U);
    EXPECT_EQ(expect_same(world, neighbours, {3, 4}, 0), 1U);
    EXPECT_EQ(expect_same(world, neighbours, {3, std::nextafter(4, 5)}, 0), 0U);
    world.teleport(at, {1e-25, 0});
    neighbours.update(world);
    EXPECT_EQ(neighbours.within({-1, 0}, 1), std::vector{at}) << "1 + 1e-25 is 1 in a double";
    EXPECT_EQ(world.within({-1, 0}, 1), std::vector{at}) << "1 + 1e-25 is 1 in a double";
    world.teleport(at, {3, 4});
    neighbours.update(world);
    EXPECT_EQ(neighbours.within({3, 4, 1e9}, 0), std::vector{at}) << "the world has no z";
    EXPECT_EQ(world.within({3, 4, NAN}, 0), std::vector{at}) << "the world has no z";
}

TEST(Neighbours, AreThoseOfTheLastUpdate) {
    World world = world_of(1);
    const Entity first = world.spawn({.position = {0}});
    const Entity last = world.spawn({.position = {1}});
    Neighbours neighbours;
    EXPECT_TRUE(neighbours.within({0}, 10).empty());
    neighbours.update(world);
    world.destroy(first);
    EXPECT_EQ(neighbours.within({0}, 10), (std::vector{first, last}));
    neighbours.update(world);
    EXPECT_EQ(neighbours.within({0}, 10), std::vector{last});
}

TEST(Neighbours, MayAllBeInOnePlace) {
    for (const double place : {0.0, 1.0, 1e9, -1e300}) {
        World world = world_of(3);
        for (int i = 0; i < 1000; ++i)
            static_cast<void>(world.spawn({.position = {place, place, place}}));
        Neighbours neighbours;
        neighbours.update(world);
        EXPECT_EQ(expect_same(world, neighbours, {place, place, place}, 0), 1000U);
        EXPECT_EQ(expect_same(world, neighbours, {-place - 1, 0, 0}, 0.5), 0U);
    }
}

TEST(Neighbours, AreFoundAtTheLimitsOfNumbers) {
    constexpr double least = std::numeric_limits<double>::denorm_min();
    World world = world_of(2);
    for (const double x : {-most, -1.0, -least, 0.0, least, 1.0, most})
        static_cast<void>(world.spawn({.position = {x, -x}}));
    Neighbours neighbours;
    neighbours.update(world);
    for (const double radius : {0.0, least, 2 * least, 1.0, 1e300, most})
        for (const double x : {-most, -1.0, 0.0, least, most})
            expect_same(world, neighbours, {x, -x}, radius);
}

TEST(Neighbours, LeaveOutBodiesThatAreNotFinite) {
    World world(2, {.rate = {1}, .precision = Precision::extended});
    for (int i = 0; i < 20; ++i) static_cast<void>(world.spawn({.velocity = {1e308, i * 1e306}}));
    const Entity near = world.spawn({.position = {1}});
    world.step(200);
    EXPECT_EQ(world.bodies().position(0)[0], INFINITY);
    Neighbours neighbours;
    neighbours.update(world);
    for (const double radius : {1.0, most}) {
        EXPECT_EQ(neighbours.within({}, radius), std::vector{near});
        EXPECT_EQ(world.within({}, radius), std::vector{near});
    }
}

TEST(Neighbours, RefuseBallsThatAreNotFinite) {
    const World world = world_of(2);
    const auto line_of = [&](const Vec3& point, double radius) {
        return line_of_error(Exit::usage, [&] { (void)world.within(point, radius); });
    };
    const std::string remedy = ": give a radius that is finite and 0 or more";
    EXPECT_EQ(line_of({}, -1), "a query within -1 m" + remedy);
    EXPECT_EQ(line_of({}, NAN), "a query within nan m" + remedy);
    EXPECT_EQ(line_of({}, INFINITY), "a query within inf m" + remedy);
    EXPECT_EQ(line_of({0, NAN}, 1), "a query around y = nan: give a finite number");
    Neighbours neighbours;
    neighbours.update(world);
    EXPECT_THROW(static_cast<void>(neighbours.within({}, -1)), Error);
}

}  // namespace
}  // namespace oiler::test
