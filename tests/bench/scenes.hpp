// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/limits.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/world/world.hpp"

namespace oiler::bench {

/// Bodies that fall, or oscillate on springs of equal anchor, stiffness and damping.
enum class Scene { projectiles, springs };

[[nodiscard]] std::string_view name_of(Scene scene);

/// "float, 3 axes"
[[nodiscard]] std::string columns(Precision precision, int axes);

inline constexpr Rate rate{60};

/// Springs so soft and lightly damped that no method diverges or comes to rest in the millions of
/// steps of a long measurement: infinite and subnormal numbers change step times.
inline constexpr Spring soft_spring{.anchor = {1, 2, 3}, .stiffness = 0.01, .damping = 0.01 / 60};
inline constexpr Vec3 gravity{0.25, -9.81, 0.5};

/// A vector with 0 for the axes that a world does not have.
[[nodiscard]] Vec3 within(const Vec3& vector, int axes);

/// The initial position and velocity of body `i`, different for a few thousand bodies.
[[nodiscard]] Body start_of(std::size_t i, int axes);

template <class T>
inline constexpr Precision precision_of = sizeof(T) == sizeof(float) ? Precision::single
                                                                     : Precision::double_;

[[nodiscard]] World make_world(Scene scene, int axes, std::size_t bodies, const Settings& settings);
[[nodiscard]] Bodies make_bodies(Scene scene, int axes, std::size_t count, Precision precision);

/// The scene in columns for the hand-written loops.
template <class T>
class HandBodies {
public:
    HandBodies(int axes, std::size_t bodies);
    [[nodiscard]] const HandScene<T>& scene() const { return scene_; }

private:
    std::vector<std::vector<T>> columns_;
    HandScene<T> scene_;
};

}  // namespace oiler::bench
