// SPDX-License-Identifier: MIT
#include <box2d/box2d.h>

#include <memory>

#include "bench/peers.hpp"

namespace oiler::bench {
namespace {

b2Body* add_body(b2World& world, std::size_t i) {
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.allowSleep = false;
    definition.position = {static_cast<float>(i % 1000) * 4, static_cast<float>(i / 1000) * 4};
    return world.CreateBody(&definition);
}

PeerWork work_of(const std::shared_ptr<b2World>& world) {
    return {repeated([=] { world->Step(static_cast<float>(peer_dt), 0, 0); }),
            [=] { return double{world->GetBodyList()->GetPosition().y}; }};
}

}  // namespace

PeerWork box2d_fall(std::size_t bodies) {
    const auto world = std::make_shared<b2World>(b2Vec2(0, -9.81F));
    const b2MassData mass{1, {0, 0}, 1};
    for (std::size_t i = 0; i < bodies; ++i) add_body(*world, i)->SetMassData(&mass);
    return work_of(world);
}

PeerWork box2d_fall_fixtures(std::size_t bodies) {
    const auto world = std::make_shared<b2World>(b2Vec2(0, -9.81F));
    b2CircleShape shape;
    shape.m_radius = 0.1F;
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.density = 1;
    fixture.filter.maskBits = 0;
    for (std::size_t i = 0; i < bodies; ++i) add_body(*world, i)->CreateFixture(&fixture);
    return work_of(world);
}

PeerWork box2d_tiles(const TiledGround& ground) {
    const auto world = std::make_shared<b2World>(b2Vec2(0, static_cast<float>(ground.gravity())));
    const b2BodyDef standing;
    b2Body* const floor = world->CreateBody(&standing);
    for (std::size_t i = 0; i < ground.tiles; ++i) {
        const Vec3 at = ground.tile(i);
        b2PolygonShape box;
        box.SetAsBox(static_cast<float>(ground.width() / 2), 0.5F,
                     {static_cast<float>(at[0]), static_cast<float>(at[1])}, 0);
        floor->CreateFixture(&box, 0);
    }
    b2CircleShape circle;
    circle.m_radius = 0.1F;
    b2FixtureDef fixture;
    fixture.shape = &circle;
    fixture.density = 1;
    fixture.friction = 0;
    fixture.restitution = static_cast<float>(ground.restitution());
    fixture.filter.groupIndex = -1;
    for (std::size_t i = 0; i < ground.balls; ++i) {
        const Body ball = ground.ball(i);
        b2BodyDef definition;
        definition.type = b2_dynamicBody;
        definition.position = {static_cast<float>(ball.position[0]),
                               static_cast<float>(ball.position[1])};
        definition.linearVelocity = {static_cast<float>(ball.velocity[0]),
                                     static_cast<float>(ball.velocity[1])};
        world->CreateBody(&definition)->CreateFixture(&fixture);
    }
    return {repeated([=] { world->Step(static_cast<float>(peer_dt), 8, 3); }),
            [=] { return double{world->GetBodyList()->GetPosition().y}; }};
}

BouncingBall box2d_ball(double speed, double restitution, double dt) {
    const auto world = std::make_shared<b2World>(b2Vec2(0, -9.81F));
    // Bodies touch the skin of an edge, not the edge.
    b2EdgeShape edge;
    edge.SetTwoSided({-10, -b2_polygonRadius}, {10, -b2_polygonRadius});
    const b2BodyDef floor;
    world->CreateBody(&floor)->CreateFixture(&edge, 0);

    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.position = {0, static_cast<float>(ball_radius)};
    definition.linearVelocity = {0, static_cast<float>(speed)};
    b2CircleShape circle;
    circle.m_radius = static_cast<float>(ball_radius);
    b2FixtureDef fixture;
    fixture.shape = &circle;
    fixture.density = 1;
    fixture.restitution = static_cast<float>(restitution);
    b2Body* const ball = world->CreateBody(&definition);
    ball->CreateFixture(&fixture);
    return {[=] { world->Step(static_cast<float>(dt), 8, 3); },
            [=] { return double{ball->GetPosition().y} - ball_radius; },
            [=] { return double{ball->GetLinearVelocity().y}; }};
}

}  // namespace oiler::bench
