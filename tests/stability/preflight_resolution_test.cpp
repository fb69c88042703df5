// SPDX-License-Identifier: MIT
// The pre-flight's warnings of coordinates whose last place is too coarse for a scene.
#include <cmath>
#include <numbers>

#include "oiler/sim/bodies.hpp"
#include "support/explained_step.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Rate rate{60};

/// All lines at the start of a run.
std::vector<std::string> lines_of(const Bodies& bodies, const char* name = "velocity_verlet") {
    const Method& method = find_method(name);
    const Steps steps{rate};
    std::vector<Risk> risks = preflight(bodies, method, steps);
    add_distortions(bodies, method, steps, risks);
    std::vector<std::string> lines;
    for (const Risk& risk : risks)
        lines.push_back(
            describe(risk, method, steps, [](std::size_t row) { return std::to_string(row); }));
    return lines;
}

/// A body at a place at 2ᵉ m, whose last place in float is 2ᵉ⁻²³ m and in double 2ᵉ⁻⁵² m.
struct FarPlace {
    int exponent;
    Precision precision = Precision::single;

    [[nodiscard]] double x() const { return std::exp2(exponent); }
    [[nodiscard]] Bodies ball(double radius) const {
        Bodies bodies(2, precision);
        bodies.set_gravity({0, -10});
        bodies.add_plane({.normal = {0, 1}, .offset = x(), .restitution = 0.8});
        bodies.add({.position = {0, x() + 2}, .contact = Contact{radius}});
        return bodies;
    }
    template <class Force>
    [[nodiscard]] Bodies held(double distance, const Force& force) const {
        Bodies bodies(2, precision);
        bodies.add({.position = {x() + distance, 0}}, force);
        return bodies;
    }
    [[nodiscard]] Bodies linked(double distance, double rest_length) const {
        Bodies bodies(2, precision);
        bodies.add({.position = {x(), 0}});
        bodies.add({.position = {x() + distance, 0}});
        bodies.link(1, 0, {.stiffness = 40, .rest_length = rest_length});
        return bodies;
    }
    [[nodiscard]] std::string line(const char* what) const {
        const bool is_float = precision == Precision::single;
        return fmt::format(
            "position of body {{}}: its last place in {} is {:.3g} m, and {}: take {}an origin "
            "nearer to it",
            is_float ? "float" : "double", std::exp2(exponent - (is_float ? 23 : 52)), what,
            is_float ? "precision double, or " : "");
    }
};

std::string of_body(int row, std::string line) {
    return line.replace(line.find("{}"), 2, std::to_string(row));
}

// 16 epsilons of 2²⁰ m are 2²⁰⁺⁴⁻²³ = 2 m in float, and of 2⁵⁰ m 4 m in double.
TEST(Resolution, OfAContactIsWarnedOf) {
    const FarPlace far{20};
    EXPECT_EQ(
        lines_of(far.ball(0.5)),
        std::vector{of_body(0, far.line("rounding hides gaps of 2 m, at a radius of 0.5 m"))});
    const FarPlace in_double{50, Precision::double_};
    EXPECT_EQ(lines_of(in_double.ball(0.5)),
              std::vector{
                  of_body(0, in_double.line("rounding hides gaps of 4 m, at a radius of 0.5 m"))});
    EXPECT_TRUE(lines_of(FarPlace{20, Precision::double_}.ball(0.5)).empty());
    EXPECT_TRUE(lines_of(FarPlace{10}.ball(0.5)).empty());
}

// A ball that is carried sideways at 2²⁰ m in float has steps of 1/40 m, less than a last place.
TEST(Resolution, IsTheCauseWhereACarriedBodyDiverges) {
    Bodies bodies(2, Precision::single);
    bodies.set_gravity({0, -10});
    bodies.add_obstacle({.shape = BoxShape{.centre = {1e6, -0.5}, .size = {100, 1}},
                         .friction = 0.5,
                         .velocity = {1.5, 0}});
    bodies.add({.position = {1e6, 0.5}, .contact = Contact{0.5}});
    ASSERT_EQ(lines_of(bodies).size(), 1U);
    EXPECT_TRUE(holds(lines_of(bodies)[0], "last place in float is 0.0625 m"))
        << lines_of(bodies)[0];
}

// The last place of 2²³ m is 1 m in float.
TEST(Resolution, OfASpringIsWarnedOf) {
    const FarPlace far{23};
    const double x = far.x();
    const std::vector ends{of_body(0, far.line("the ends of its spring are apart by 1 m"))};
    EXPECT_EQ(lines_of(far.held(1, Spring{.anchor = {x}, .stiffness = 40})), ends);
    const std::vector rest{of_body(0, far.line("the rest length of its spring is 3 m"))};
    const CoilSpring coil{.anchor = {x}, .stiffness = 40, .rest_length = 3};
    EXPECT_EQ(lines_of(far.held(5, coil)), rest);
    EXPECT_EQ(lines_of(far.linked(5, 3)),
              std::vector{of_body(1, far.line("the rest length of its spring is 3 m"))});
    EXPECT_EQ(lines_of(far.linked(1, 0)),
              std::vector{of_body(1, far.line("the ends of its spring are apart by 1 m"))});
    // The last place of 2²⁷ m is 16 m: body and anchor are in one point.
    const FarPlace one{27};
    EXPECT_EQ(lines_of(one.held(1, Spring{.anchor = {one.x() + 2}, .stiffness = 40})),
              std::vector{of_body(0, one.line("the ends of its spring are apart by 0 m"))});
}

// A body at rest on its spring, near or far, is not warned of.
TEST(Resolution, IsNoRiskOfABodyThatHangs) {
    for (const int exponent : {0, 6, 10, 13}) {
        const FarPlace place{exponent};
        EXPECT_TRUE(
            lines_of(place.held(0, Spring{.anchor = {place.x()}, .stiffness = 40})).empty());
        Bodies hung = place.held(0, Spring{.anchor = {place.x(), 0.25}, .stiffness = 40});
        hung.set_gravity({0, -10});
        EXPECT_TRUE(lines_of(hung).empty()) << exponent;
    }
}

// F·sin(ωt) moves 1 kg by F/ω·t − F/ω²·sin(ωt), which is 1.36 m after 512 steps of 1/60 s.
TEST(Resolution, OfADriveIsComparedWithARunInDouble) {
    const double omega = 2 * std::numbers::pi;
    const double time = 512 / 60.0;
    const double way = time / omega - std::sin(omega * time) / (omega * omega);
    for (const int exponent : {20, 23, 30}) {
        const FarPlace far{exponent};
        const auto lines = lines_of(far.held(0, Drive{.amplitude = {1}, .frequency = 1}));
        ASSERT_EQ(lines.size(), 1U) << exponent;
        EXPECT_TRUE(holds(lines[0], fmt::format("in a motion of {:.2g} m", way))) << lines[0];
        EXPECT_TRUE(holds(lines[0], fmt::format("rounded to {:.3g} m", far.x() / (1 << 23))))
            << lines[0];
    }
    EXPECT_TRUE(lines_of(FarPlace{10}.held(0, Drive{.amplitude = {1}, .frequency = 1})).empty());
}

// The circle of 1 m around gm = 1 m³/s² keeps its energy in double with all these methods.
TEST(Resolution, IsTheCauseOfAnOrbitThatGainsEnergy) {
    for (const double x : {1e6, 1e7})
        for (const char* method : {"velocity_verlet", "rk4", "blanes_moan_srkn6b"})
            for (const Precision precision : {Precision::single, Precision::double_}) {
                Bodies bodies(2, precision);
                bodies.add({.position = {x + 1, 0}, .velocity = {0, 1}},
                           Attractor{.centre = {x, 0}, .gm = 1});
                const auto lines = lines_of(bodies, method);
                const std::string where = fmt::format("{} at {}", method, x);
                ASSERT_EQ(lines.size(), precision == Precision::single ? 1U : 0U) << where;
                for (const std::string& line : lines)
                    EXPECT_TRUE(holds(line, "take precision double")) << line;
            }
}

}  // namespace
}  // namespace oiler::test
