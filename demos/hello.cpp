// SPDX-License-Identifier: MIT
#include "oiler/oiler.hpp"
using namespace oiler;

struct Hello {  // Space kicks a mass on a spring
    static constexpr About about{.name = "hello", .title = "Hello, Oiler", .rate = 60};
    World world;
    Entity mass = world.spawn(Body{.position = {2}}, Spring{.stiffness = 40, .damping = 0.8});

    explicit Hello(const Settings& settings) : world(1, settings) {}
    void update(const Input& input) {
        if (input.pressed(Key::space)) world.set_velocity(mass, {world.velocity(mass)[0] + 15});
    }
    Picture picture() const {
        const ElementKey key = key_of(world, mass);
        const Point at = to_point(world.position(mass));
        return {.camera = {.height = 6},
                .polygons = {{{}, rectangle({0, -11}, {40, 20}), palette::pale}},
                .polylines = {{key, coil({-5, 0}, at, 14, 0.6F), 3, palette::grey}},
                .discs = {{key, at, 1, palette::blue}},
                .labels = {{{}, {12, 12}, "Space kicks, F3 pauses, Escape quits", 16}}};
    }
};

int main(int argc, char** argv) { return run<Hello>(argc, argv); }
