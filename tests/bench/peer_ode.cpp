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
    return {[=](long times) {
                for (long i = 0; i < times; ++i) dWorldQuickStep(falling->world, peer_dt);
            },
            [=] { return double{dBodyGetPosition(falling->bodies.front())[1]}; }};
}

}  // namespace oiler::bench
