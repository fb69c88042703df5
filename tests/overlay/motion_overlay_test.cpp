// SPDX-License-Identifier: MIT
// What the inspector draws over a picture: arrows, springs and their scales. The oracle of an
// acceleration is a step of the engine: explicit kicks change a velocity by acceleration·dt.
#include "oiler/overlay/motion_overlay.hpp"

#include "oiler/game/look.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double dt = 1.0 / 64;
const Settings at_64_hz{.stepping = {.rate = {64}, .damping = Damping::in_kick}};

/// Every kind of force and link.
World crowd() {
    World world(2, at_64_hz);
    world.set_gravity({0.5, -9.81});
    const Body start{.mass = 2, .position = {1, 2}, .velocity = {-3, 4}};
    const Entity free = world.spawn(start);
    const Entity pulled = world.spawn(start, Spring{{0, 1}, 30, 0.5}, LinearDrag{0.25});
    const Entity coiled = world.spawn(start, CoilSpring{{3, 3}, 20, 0.75, 1.5});
    world.attach_at(1, coiled, CoilSpring{{-3, 3}, 10, 0, 1});
    const Entity falling = world.spawn(start, Attractor{{5, 5}, 40}, QuadraticDrag{0.125});
    world.link(free, falling, {.stiffness = 5, .damping = 0.5, .rest_length = 0.25});
    world.set_position(falling, {2, 2.5});
    world.link(pulled, coiled, {.stiffness = 7, .damping = 0.5});
    world.set_position(coiled, {0, -1});
    world.link_to_point(free, {0, 0}, {.stiffness = 3, .rest_length = 1});
    return world;
}

std::vector<Entity> bodies_of(const World& world) {
    std::vector<Entity> bodies;
    for (std::size_t row = 0; row < world.bodies().size(); ++row)
        bodies.push_back(world.entity_of_row(row));
    return bodies;
}

// Velocities are of size 10 and known to 2⁻⁵², so their difference over dt to 64·10·2⁻⁵² ≈ 1.5e-13;
// the sums of some ten forces of size 100 are known to as much.
TEST(BodyMotion, HasTheAccelerationOfTheNextKick) {
    World world = crowd();
    const std::vector<BodyMotion> motions = motions_of(world, bodies_of(world));
    ASSERT_EQ(motions.size(), 4U);
    world.step();
    for (const BodyMotion& motion : motions) {
        const Vec3 kick = (world.velocity(motion.body) - motion.velocity) / dt;
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(motion.acceleration[axis], kick[axis], 1e-12) << motion.body.index;
    }
}

TEST(BodyMotion, IsInterpolatedForBodiesThatBothHave) {
    const Entity one{1, 1};
    const Entity two{2, 1};
    const std::vector<BodyMotion> quarter =
        between({{one, {0, 0}, {4, 0}, {0, 8}}}, {{two}, {one, {8, 0}, {0, 4}, {0, 0}}}, 0.25);
    ASSERT_EQ(quarter.size(), 1U);
    EXPECT_EQ(quarter[0].position, (Vec3{2, 0}));
    EXPECT_EQ(quarter[0].velocity, (Vec3{3, 1}));
    EXPECT_EQ(quarter[0].acceleration, (Vec3{0, 6}));
}

TEST(Springs, ThatAreSlackRopesHaveNeitherStrainNorForce) {
    World world(2);
    const Entity slack = world.spawn(Body{.position = {1, 0}});
    const Entity taut = world.spawn(Body{.position = {3, 0}});
    const Link rope{.stiffness = 5, .rest_length = 2, .pulls_only = true};
    world.link_to_point(slack, {}, rope);
    world.link_to_point(taut, {}, rope);
    EXPECT_EQ(springs_of(world)[0].stretch(), 0);
    EXPECT_EQ(springs_of(world)[1].stretch(), 1);
    const std::vector<BodyMotion> motions = motions_of(world, {slack, taut});
    EXPECT_EQ(motions[0].acceleration, Vec3{});
    EXPECT_EQ(motions[1].acceleration, (Vec3{-5, 0}));
}

TEST(Springs, AreThoseOfTheWorld) {
    World world(2);
    const Entity a = world.spawn(Body{.position = {3, 4}}, Spring{.stiffness = 1});
    const Entity b =
        world.spawn(Body{.position = {3, 0}}, CoilSpring{.stiffness = 1, .rest_length = 4});
    (void)world.spawn(Body{}, LinearDrag{1});
    world.link(a, b, {.stiffness = 1, .rest_length = 2});
    world.link_to_point(b, {3, -1}, {.stiffness = 1, .rest_length = 1});
    const std::vector<DrawnSpring> springs = springs_of(world);
    ASSERT_EQ(springs.size(), 4U);
    EXPECT_EQ(springs[0].stretch(), 4 - 2) << "between the bodies";
    EXPECT_EQ(springs[1].stretch(), 0) << "to the point";
    EXPECT_EQ(springs[2].stretch(), 5) << "to the origin, without a rest length";
    EXPECT_EQ(springs[3].stretch(), 3 - 4) << "compressed";
    EXPECT_FALSE(springs[2].has_strain());
    EXPECT_EQ(springs[0].from.body, a);
    EXPECT_EQ(springs[0].to.body, b);
    EXPECT_FALSE(springs[1].to.body);
    // Strains of 1, 0 and -1/4: twice their root mean square is more than 1.
    EXPECT_EQ(full_colour(springs).strain, 1);
    EXPECT_EQ(full_colour(springs).stretch, 5);
}

TEST(Springs, AFewDoNotMakeAllOthersGrey) {
    std::vector<DrawnSpring> springs(99, {.to = {.at = {1.1}}, .rest_length = 1});
    springs.push_back({.to = {.at = {3}}, .rest_length = 1});
    const double mean_square = (99 * 0.1 * 0.1 + 2 * 2) / 100;
    EXPECT_NEAR(full_colour(springs).strain, 2 * std::sqrt(mean_square), 1e-12);
}

TEST(Springs, DivergeFromGreyToBlueAndVermilion) {
    EXPECT_EQ(colour_of_strain(0), palette::grey);
    EXPECT_EQ(colour_of_strain(-1), palette::blue);
    EXPECT_EQ(colour_of_strain(1), palette::vermilion);
    EXPECT_EQ(colour_of_strain(-7), palette::blue);
    EXPECT_LT(colour_of_strain(-0.5).r, palette::grey.r);
    EXPECT_GT(colour_of_strain(0.5).r, palette::grey.r);
}

TEST(Springs, AreDrawnWhereTheirBodiesAre) {
    World world(2);
    const Entity body = world.spawn(Body{.position = {3, 0}}, Spring{{1, 0}, 2});
    Picture picture;
    const Picture moved{.discs = {{.key = key_of(world, body), .centre = {5, 1}}}};
    add_springs(picture, DrawnBodies(moved), springs_of(world), {.stretch = 4});
    ASSERT_EQ(picture.polylines.size(), 1U);
    EXPECT_EQ(picture.polylines[0].points, (std::vector<Point>{{1, 0}, {5, 1}}));
    EXPECT_EQ(picture.polylines[0].colour, colour_of_strain(0.5)) << "2 m of 4 m";
}

/// A falling body in a picture of 10 m, with the overlay.
struct Shot {
    World world{2, at_64_hz};
    Entity body = world.spawn(Body{.velocity = {3, 0}});
    MotionOverlay overlay;

    Shot() { world.set_gravity({0, -9.81}); }
    Picture draw(const Shown& shown, double share_of_step = 1) {
        const Vec3 at = world.position(body);
        Picture picture{.camera = {.height = 10},
                        .discs = {{.key = key_of(world, body), .centre = to_point(at)}}};
        overlay.add(picture, world, shown,
                    {.time = world.time() - (1 - share_of_step) * world.dt()});
        return picture;
    }
};

/// The vector from the body to the tip of an arrow.
Point way_of(const Polygon& arrow, Point from) {
    const Point tip = arrow.points.at(3);
    return {tip.x - from.x, tip.y - from.y};
}

TEST(MotionOverlay, DrawsArrowsToTheStatedScale) {
    Shot shot;
    const Picture picture = shot.draw({.velocities = true, .accelerations = true});
    ASSERT_EQ(picture.polygons.size(), 2U);
    const Inspected::Scales& scales = shot.overlay.scales();
    // The longest arrows are at most 2 m of 10 m: 3 m/s need 1.5 m/s a metre, 9.81 m/s² 4.9.
    EXPECT_EQ(scales.velocity, 2);
    EXPECT_EQ(scales.acceleration, 5);
    EXPECT_NEAR(way_of(picture.polygons[0], {}).y, -9.81 / 5, 1e-6);
    EXPECT_NEAR(way_of(picture.polygons[1], {}).x, 1.5, 1e-6);
    EXPECT_EQ(scales.bodies, 0U) << "all";
    shot.world.step(64);
    const Picture faster = shot.draw({.velocities = true, .accelerations = true});
    EXPECT_EQ(shot.overlay.scales().velocity, 10) << "10.3 m/s need 5.1 m/s a metre";
}

TEST(MotionOverlay, MovesArrowsBetweenSteps) {
    Shot shot;
    const Shown shown{.velocities = true};
    (void)shot.draw(shown);
    shot.world.step();
    const Picture quarter = shot.draw(shown, 0.25);
    const Point at = quarter.discs[0].centre;
    EXPECT_NEAR(way_of(quarter.polygons.at(0), at).y * shot.overlay.scales().velocity,
                -9.81 * dt / 4, 1e-6);
}

TEST(MotionOverlay, AddsNothingUnlessItIsSwitchedOnAndChangesNoGame) {
    Shot shot;
    const std::uint64_t hash = shot.world.state_hash();
    const Picture none = shot.draw({});
    EXPECT_TRUE(none.polygons.empty() && none.polylines.empty());
    (void)shot.draw({true, true, true, true});
    EXPECT_EQ(shot.world.state_hash(), hash);
    shot.world.step();
    EXPECT_FALSE(shot.draw({.trails = true}).polylines.empty());
    EXPECT_TRUE(shot.draw({}).polylines.empty());
    shot.world.step();
    EXPECT_TRUE(shot.draw({.trails = true}).polylines.empty()) << "begins anew";
}

TEST(MotionOverlay, HasArrowsForTheFirstHundredBodiesAndTheFollowedOne) {
    World world(2);
    for (int i = 0; i < 150; ++i) (void)world.spawn(Body{.velocity = {1}});
    MotionOverlay overlay;
    const auto arrows = [&](std::optional<Entity> followed) {
        Picture picture;
        overlay.add(picture, world, {.velocities = true}, {.followed = followed});
        return picture.polygons.size();
    };
    EXPECT_EQ(arrows({}), 100U);
    EXPECT_EQ(overlay.scales().bodies, 100U);
    EXPECT_EQ(arrows(world.entity_of_row(3)), 100U);
    EXPECT_EQ(arrows(world.entity_of_row(120)), 101U);
}

TEST(MotionOverlay, FindsBodiesDrawnAsPolygonsAndSprites) {
    World world(2);
    const Entity square = world.spawn({});
    const Entity hero = world.spawn({});
    const Picture picture{
        .sprites = {{.key = key_of(world, hero), .centre = {7, 8}}},
        .polygons = {{.key = key_of(world, square), .points = {{0, 0}, {2, 0}, {2, 4}, {0, 4}}}}};
    const DrawnBodies bodies(picture);
    ASSERT_TRUE(bodies.find(square) && bodies.find(hero));
    EXPECT_EQ(bodies.find(square)->centre, (Point{1, 2}));
    EXPECT_EQ(bodies.find(hero)->centre, (Point{7, 8}));
    EXPECT_FALSE(bodies.find(world.create()));
}

}  // namespace
}  // namespace oiler::test
