// SPDX-License-Identifier: MIT
#include "oiler/physics/contacts/support.hpp"

#include <random>

#include "support/test.hpp"

namespace oiler::test {
namespace {

template <class T>
class Supports : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(Supports, Precisions);

// A body thrown towards the edge of a wedge of angle θ presses into the floor or the ceiling; after
// either has taken its part, the rest presses into the other one. What both leave is along the
// edge. Their reactions are up to v/θ, so that round-off leaves some ε·v/θ.
TYPED_TEST(Supports, OfANarrowWedgeAreBothPlanes) {
    using T = TypeParam;
    std::mt19937_64 random(1);
    const auto between = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(random);
    };
    for (int i = 0; i < 20000; ++i) {
        const double angle = between(0.02, 0.2);
        const double to_edge = between(0, 6.28);
        const double c = std::cos(to_edge);
        const double s = std::sin(to_edge);
        const double speed = between(1, 20);
        const double along = between(-5, 5);
        std::array<PlaneOf<T, 3>, 2> planes{};
        planes[0].normal = {T(0), T(0), T(1)};
        planes[1].normal = {T(std::sin(angle) * c), T(std::sin(angle) * s), T(-std::cos(angle))};
        const Vec<T, 3> push{T(-speed * c - along * s), T(-speed * s + along * c),
                             T(-between(0.01, 0.99) * speed * std::tan(angle))};
        const auto support = Support<T, 3>::against(push, planes, 0b11);
        ASSERT_EQ(support.size(), 2U) << "case " << i;
        const Vec<T, 3> rest = support.without_push(push);
        const double round_off = 64 * std::numeric_limits<T>::epsilon() * speed / angle;
        for (const auto& plane : planes)
            ASSERT_NEAR(dot(plane.normal, rest), 0, round_off) << "case " << i;
        ASSERT_NEAR(-rest.axis[0] * s + rest.axis[1] * c, along, round_off) << "case " << i;
    }
}

}  // namespace
}  // namespace oiler::test
