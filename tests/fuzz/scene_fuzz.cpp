// SPDX-License-Identifier: MIT
// Any bytes are either a valid scene, from which a world can be made, or refused in one line that
// names the file.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "oiler/core/error.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/sim/bodies.hpp"

namespace {

using namespace oiler;

/// Larger scenes would take the time of many small ones.
constexpr std::int64_t most_made = 10'000;

void expect(bool holds) {
    if (!holds) std::abort();
}

void make(const Scene& scene) {
    if (scene.body_count() > most_made) return;
    const World world = make_world(scene, Settings{scene.stepping});
    world.require_applicable();
    expect(world.bodies().size() == static_cast<std::size_t>(scene.body_count()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Scene scene;
    try {
        scene = parse_scene({reinterpret_cast<const char*>(data), size}, "file");
    } catch (const Error& error) {
        const std::string_view line = error.what();
        expect(error.exit() == Exit::usage);
        expect(line.starts_with("file:") && line.find('\n') == std::string_view::npos);
        return 0;
    }
    make(scene);
    return 0;
}
