// SPDX-License-Identifier: MIT
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <memory>

#include "bench/peers.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::bench {
namespace {

/// Bullet's world and the bodies that it steps.
struct Falling {
    btSoftBodyRigidBodyCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btSphereShape shape{0.1F};
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};

    Falling() { world.setGravity({0, -9.81F, 0}); }
    ~Falling() {
        for (const auto& body : bodies) world.removeRigidBody(body.get());
    }
    Falling(const Falling&) = delete;
    Falling& operator=(const Falling&) = delete;

    void step(long times) {
        for (long i = 0; i < times; ++i) world.stepSimulation(static_cast<float>(peer_dt), 0);
    }
};

/// Adds a body without collisions: its group is empty.
void add_body(Falling& falling, std::size_t i) {
    const btVector3 at(static_cast<float>(i % 1000) * 4, 0, static_cast<float>(i / 1000) * 4);
    btVector3 inertia;
    falling.shape.calculateLocalInertia(1, inertia);
    auto body = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &falling.shape, inertia));
    body->setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
    body->setActivationState(DISABLE_DEACTIVATION);
    falling.world.addRigidBody(body.get(), 0, 0);
    falling.bodies.push_back(std::move(body));
}

/// A soft body whose springs are solved once per step.
btSoftBody* make_net(btSoftBodyWorldInfo& info, const Net& net) {
    std::vector<btVector3> places;
    for (std::size_t i = 0; i < net.bodies(); ++i) {
        const Vec3 at = net.position(i);
        places.emplace_back(static_cast<float>(at[0]), static_cast<float>(at[1]),
                            static_cast<float>(at[2]));
    }
    auto* const body =
        new btSoftBody(&info, static_cast<int>(places.size()), places.data(), nullptr);
    for (const auto& [a, b] : net.links())
        body->appendLink(static_cast<int>(a), static_cast<int>(b));
    body->m_cfg.piterations = 1;
    body->m_cfg.collisions = 0;
    body->setActivationState(DISABLE_DEACTIVATION);
    return body;
}

/// A ball over a floor.
struct Bouncing {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    btStaticPlaneShape plane{{0, 1, 0}, 0};
    btSphereShape sphere{static_cast<btScalar>(ball_radius)};
    btRigidBody floor{{0, nullptr, &plane}};
    btRigidBody ball{{1, nullptr, &sphere, inertia()}};

    /// The restitutions of both bodies are multiplied.
    Bouncing(double speed, double restitution) {
        world.setGravity({0, -9.81F, 0});
        floor.setRestitution(1);
        ball.setRestitution(static_cast<btScalar>(restitution));
        ball.setWorldTransform(
            btTransform(btQuaternion::getIdentity(), {0, sphere.getRadius(), 0}));
        ball.setLinearVelocity({0, static_cast<btScalar>(speed), 0});
        world.addRigidBody(&floor);
        world.addRigidBody(&ball);
    }
    ~Bouncing() {
        world.removeRigidBody(&ball);
        world.removeRigidBody(&floor);
    }
    Bouncing(const Bouncing&) = delete;
    Bouncing& operator=(const Bouncing&) = delete;

    [[nodiscard]] btVector3 inertia() const {
        btVector3 of_sphere;
        sphere.calculateLocalInertia(1, of_sphere);
        return of_sphere;
    }
};

}  // namespace

PeerWork bullet_fall(std::size_t bodies) {
    const auto falling = std::make_shared<Falling>();
    for (std::size_t i = 0; i < bodies; ++i) add_body(*falling, i);
    return {[=](long times) { falling->step(times); },
            [=] { return falling->bodies.front()->getWorldTransform().getOrigin().y(); }};
}

PeerWork bullet_tiles(const TiledGround& ground) {
    const auto scene = std::make_shared<Falling>();
    scene->world.setGravity({0, static_cast<btScalar>(ground.gravity()), 0});
    const auto box = std::make_shared<btBoxShape>(
        btVector3(static_cast<btScalar>(ground.width() / 2), 0.5F, 0.5F));
    const auto add = [&](btScalar mass, btCollisionShape* shape, const Vec3& at, int group,
                         int mask) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) shape->calculateLocalInertia(mass, inertia);
        auto body = std::make_unique<btRigidBody>(
            btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, shape, inertia));
        body->setWorldTransform(
            btTransform(btQuaternion::getIdentity(),
                        {static_cast<btScalar>(at[0]), static_cast<btScalar>(at[1]), 0}));
        body->setRestitution(static_cast<btScalar>(ground.restitution()));
        body->setFriction(0);
        scene->world.addRigidBody(body.get(), group, mask);
        scene->bodies.push_back(std::move(body));
        return scene->bodies.back().get();
    };
    for (std::size_t i = 0; i < ground.balls; ++i) {
        const Body ball = ground.ball(i);
        add(1, &scene->shape, ball.position, 1, 2)
            ->setLinearVelocity({static_cast<btScalar>(ball.velocity[0]),
                                 static_cast<btScalar>(ball.velocity[1]), 0});
    }
    for (std::size_t i = 0; i < ground.tiles; ++i) add(0, box.get(), ground.tile(i), 2, 1);
    return {[=](long times) {
                scene->step(times);
                keep(box);
            },
            [=] { return scene->bodies.front()->getWorldTransform().getOrigin().y(); }};
}

PeerWork bullet_net(const Net& net) {
    const auto falling = std::make_shared<Falling>();
    btSoftBody* const body = make_net(falling->world.getWorldInfo(), net);
    falling->world.addSoftBody(body, 0, 0);
    const std::shared_ptr<btSoftBody> owner(body, [falling](btSoftBody* gone) {
        falling->world.removeSoftBody(gone);
        delete gone;
    });
    return {[=](long times) { falling->step(times); },
            [=] { return double{owner->m_nodes[0].m_x.y()}; }};
}

BouncingBall bullet_ball(double speed, double restitution, double dt) {
    const auto scene = std::make_shared<Bouncing>(speed, restitution);
    return {[=] { scene->world.stepSimulation(static_cast<btScalar>(dt), 0); },
            [=] { return double{scene->ball.getWorldTransform().getOrigin().y()} - ball_radius; },
            [=] { return double{scene->ball.getLinearVelocity().y()}; }};
}

}  // namespace oiler::bench
