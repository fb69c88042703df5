// SPDX-License-Identifier: MIT
#include <ode/ode.h>

#include <memory>

#include "bench/peers.hpp"

namespace oiler::bench {
namespace {

struct Falling {
    dWorldID world;
    std::vector<dBodyID> bodies;

    Falling() {
        dInitODE2(0);
        world = dWorldCreate();
        dWorldSetGravity(world, 0, -9.81, 0);
    }
    ~Falling() {
        dWorldDestroy(world);
        dCloseODE();
    }
    Falling(const Falling&) = delete;
    Falling& operator=(const Falling&) = delete;
};

/// A ball over a floor.
struct Bouncing : Falling {
    dSpaceID space = dSimpleSpaceCreate(nullptr);
    dJointGroupID contacts = dJointGroupCreate(0);
    double restitution;

    explicit Bouncing(double e) : restitution(e) {
        const dBodyID ball = bodies.emplace_back(dBodyCreate(world));
        dBodySetPosition(ball, 0, ball_radius, 0);
        dCreatePlane(space, 0, 1, 0, 0);
        dGeomSetBody(dCreateSphere(space, ball_radius), ball);
    }
    ~Bouncing() {
        dJointGroupDestroy(contacts);
        dSpaceDestroy(space);
    }

    void step(double dt) {
        dSpaceCollide(space, this, &meet);
        dWorldQuickStep(world, dt);
        dJointGroupEmpty(contacts);
    }
    static void meet(void* self, dGeomID a, dGeomID b) {
        const auto& scene = *static_cast<const Bouncing*>(self);
        dContact contact{};
        if (dCollide(a, b, 1, &contact.geom, sizeof contact) == 0) return;
        contact.surface.mode = dContactBounce;
        contact.surface.bounce = scene.restitution;
        contact.surface.bounce_vel = 0.1;
        dJointAttach(dJointCreateContact(scene.world, scene.contacts, &contact), dGeomGetBody(a),
                     dGeomGetBody(b));
    }
};

}  // namespace

PeerWork ode_fall(std::size_t bodies) {
    const auto falling = std::make_shared<Falling>();
    for (std::size_t i = 0; i < bodies; ++i) {
        const dBodyID body = dBodyCreate(falling->world);
        dBodySetPosition(body, static_cast<double>(i % 1000) * 4, 0,
                         static_cast<double>(i / 1000) * 4);
        dBodySetGyroscopicMode(body, 0);
        falling->bodies.push_back(body);
    }
    return {repeated([=] { dWorldQuickStep(falling->world, peer_dt); }),
            [=] { return double{dBodyGetPosition(falling->bodies.front())[1]}; }};
}

BouncingBall ode_ball(double speed, double restitution, double dt) {
    const auto scene = std::make_shared<Bouncing>(restitution);
    const dBodyID ball = scene->bodies.front();
    dBodySetLinearVel(ball, 0, speed, 0);
    return {[=] { scene->step(dt); },
            [=] { return double{dBodyGetPosition(ball)[1]} - ball_radius; },
            [=] { return double{dBodyGetLinearVel(ball)[1]}; }};
}

}  // namespace oiler::bench
