// SPDX-License-Identifier: MIT
// The smallest game: a mass on a spring. Space kicks it.
#include "oiler/app/run.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"

using namespace oiler;

struct Hello {
    static constexpr About about{.name = "hello", .title = "Hello, Oiler: Space kicks", .rate = 60};

    World world;
    Entity mass;

    explicit Hello(const Settings& settings)
        : world(1, settings),
          mass(world.spawn(Body{.mass = 1, .position = {2}},
                           Spring{.stiffness = 40, .damping = 0.8})) {}

    void update(const Input& input) {
        if (input.pressed(Key::space)) world.set_velocity(mass, {world.velocity(mass)[0] + 15});
    }

    Picture picture() const {
        const Point at = to_point(world.position(mass));
        const ElementKey key = key_of(world, mass);
        return {.camera = {.height = 6},
                .polylines = {{.key = key,
                               .points = coil({-5, 0}, at, 14, 0.3F),
                               .width = 2,
                               .colour = palette::grey}},
                .discs = {{.key = key, .centre = at, .radius = 0.5F, .colour = palette::blue}},
                .labels = {{.at = {12, 12},
                            .text = "Space kicks, P pauses, Q quits",
                            .colour = palette::ink}}};
    }
};

int main(int argc, char** argv) { return run<Hello>(argc, argv); }
