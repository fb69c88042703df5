// SPDX-License-Identifier: MIT
#include "trap/traps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "oiler/scene/read.hpp"

namespace oiler::trap {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Four significant digits keep a file readable.
double rounded(double number) { return std::stod(fmt::format("{:.4g}", number)); }

double mass_of(Dice& dice) { return rounded(dice.log_uniform(0.1, 10)); }

/// No, weak, exactly critical or strong damping of a spring, N·s/m.
double damping_of(Dice& dice, double mass, double stiffness) {
    const double critical = 2 * std::sqrt(mass * stiffness);
    const int choice = dice.whole(0, 4);
    if (choice == 0) return 0;
    if (choice == 1) return critical;
    if (choice == 2) return rounded(critical * dice.log_uniform(1, 50));
    return rounded(critical * dice.log_uniform(1e-5, 1));
}

std::vector<double> random_point(Dice& dice, double size) {
    std::vector<double> point(3);
    for (double& number : point) number = rounded(dice.uniform(-size, size));
    return point;
}

/// A chain between two anchors. Rest lengths make it nonlinear.
void add_chain(Dice& dice, Draft& draft, int count, double rest, double periods) {
    const double omega = dice.log_uniform(0.5, 300);
    const double damping = dice.chance(0.5) ? 0 : rounded(omega * dice.log_uniform(1e-4, 1));
    const double stiffness = rounded(omega * omega);
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i)
        names.push_back(draft.body(
            dice.chance(0.5) ? 1 : mass_of(dice),
            {i + 1 + rounded(dice.uniform(-0.2, 0.2)), rounded(dice.uniform(-0.1, 0.1))}, {0}));
    draft.spring(names.front(), {0}, stiffness, damping, rest);
    for (int i = 1; i < count; ++i)
        draft.link(names[static_cast<std::size_t>(i)], names[static_cast<std::size_t>(i - 1)],
                   stiffness, damping, rest);
    if (dice.chance(0.5))
        draft.spring(names.back(), {static_cast<double>(count + 1)}, stiffness, damping, rest);
    draft.limit(omega * 6 / turn, periods);
}

/// A body on a spring that oscillates by about `size` at `omega`, rad/s.
void add_oscillator(Dice& dice, Draft& draft, double omega, double size, bool damped) {
    // Squares of powers of two: damping can be exactly critical.
    const bool exact = dice.chance(0.3);
    const double mass = exact ? 1 : mass_of(dice);
    if (exact) omega = std::exp2(std::round(std::log2(omega)));
    const double stiffness = exact ? omega * omega : rounded(mass * omega * omega);
    const std::vector<double> anchor = random_point(dice, dice.chance(0.5) ? 0 : 10 * size);
    std::vector<double> position = anchor;
    for (double& number : position) number += rounded(dice.uniform(-size, size));
    const double speed = dice.chance(0.5) ? 0 : omega * size;
    const std::string body = draft.body(mass, position, random_point(dice, speed));
    draft.spring(body, anchor, stiffness, damped ? damping_of(dice, mass, stiffness) : 0);
    draft.limit(omega / turn);
}

void single_spring(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 3);
    if (dice.chance(0.5)) draft.gravity(9.81);
    add_oscillator(dice, draft, dice.log_uniform(0.01, 1e4), dice.log_uniform(0.01, 1000), true);
}

void several_springs(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    if (dice.chance(0.5)) draft.gravity(9.81);
    for (int i = dice.whole(2, 12); i > 0; --i)
        add_oscillator(dice, draft, dice.log_uniform(0.01, 1e3), dice.log_uniform(0.1, 100), true);
}

void many_springs(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    const double omega = dice.log_uniform(0.1, 1e3);
    for (int i = dice.whole(30, 200); i > 0; --i)
        add_oscillator(dice, draft, omega * dice.uniform(0.5, 1), dice.uniform(0.5, 2), false);
    draft.limit(omega / turn, 100);
}

/// A slow large oscillation beside small fast ones.
void slow_and_fast(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    if (dice.chance(0.3)) draft.gravity(9.81);
    add_oscillator(dice, draft, dice.log_uniform(0.05, 2), dice.log_uniform(10, 1000), false);
    for (int i = dice.whole(1, 3); i > 0; --i)
        add_oscillator(dice, draft, turn * dice.log_uniform(10, 1000), dice.log_uniform(0.1, 5),
                       dice.chance(0.5));
}

/// A spring whose frequency is a multiple of a usual rate: samples at that rate see it at rest.
void aliased(Dice& dice, Draft& draft) {
    constexpr double rates[]{1, 10, 30, 60};
    const double hertz = rates[dice.whole(0, 3)] * dice.whole(1, 16);
    const double stiffness = turn * hertz * turn * hertz;
    const double size = rounded(dice.log_uniform(0.1, 10));
    if (dice.chance(0.3)) draft.gravity(9.81);
    const bool released = dice.chance(0.5);
    const std::string body =
        draft.body(1, {released ? size : 0}, {released ? 0 : turn * hertz * size});
    draft.spring(body, {0}, stiffness, dice.chance(0.7) ? 0 : rounded(dice.log_uniform(1e-4, 1)));
    if (dice.chance(0.5))
        add_oscillator(dice, draft, dice.log_uniform(0.05, 2), dice.log_uniform(10, 300), false);
    draft.limit(hertz);
}

void linked_pair(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 3);
    const double omega = dice.log_uniform(0.1, 1e3);
    const double mass = mass_of(dice);
    const double stiffness = rounded(mass * omega * omega);
    const std::string a = draft.body(mass, random_point(dice, 5), random_point(dice, 5));
    const std::string b = draft.body(mass_of(dice), random_point(dice, 5), {0});
    draft.link(a, b, stiffness, damping_of(dice, mass, stiffness));
    if (dice.chance(0.7)) draft.spring(a, random_point(dice, 5), rounded(stiffness / 3), 0);
    if (dice.chance(0.5)) draft.spring(b, {0}, rounded(stiffness * dice.log_uniform(0.1, 10)), 0);
    if (dice.chance(0.3)) draft.gravity(9.81);
    draft.limit(omega * 3 / turn, 5000);
}

void linear_chain(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    if (dice.chance(0.3)) draft.gravity(9.81);
    add_chain(dice, draft, dice.whole(3, 20), 0, 1000);
}

void coiled_chain(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    if (dice.chance(0.3)) draft.gravity(1);
    add_chain(dice, draft, dice.whole(2, 8), rounded(dice.uniform(0.3, 0.9)), 100);
}

/// An elastic pendulum; its spring never vanishes.
void pendulum(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(2, 3);
    const double omega = dice.log_uniform(3, 300);
    const double mass = mass_of(dice);
    const double length = rounded(dice.uniform(0.5, 3));
    draft.gravity(9.81);
    const double angle = dice.uniform(0.1, 1.2);
    const std::string body = draft.body(
        mass, {rounded(length * std::sin(angle)), rounded(-length * std::cos(angle) - 0.1)}, {0});
    draft.spring(body, {0}, rounded(mass * omega * omega),
                 dice.chance(0.5) ? 0 : rounded(mass * omega * dice.log_uniform(1e-3, 1)), length);
    draft.limit(omega / turn, 300);
}

std::string drags(double linear, double quadratic) {
    return fmt::format("linear_drag = {}\nquadratic_drag = {}\n", rounded(linear),
                       rounded(quadratic));
}

/// A body on an ellipse, at the perihelion or at the aphelion.
void add_orbit(Dice& dice, Draft& draft, double gm, double distance) {
    const double e = dice.chance(0.15) ? 0 : rounded(dice.uniform(0, 0.99));
    const bool near = dice.chance(0.5);
    const double speed = std::sqrt(gm / distance * (near ? 1 + e : 1 - e));
    const double angle = dice.uniform(0, turn);
    draft.body(1, {distance * std::cos(angle), distance * std::sin(angle)},
               {-speed * std::sin(angle), speed * std::cos(angle)});
    const double perihelion = near ? distance : distance * (1 - e) / (1 + e);
    draft.limit(std::sqrt(gm / (perihelion * perihelion * perihelion)) / turn, 2e4);
}

void orbit(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(2, 3);
    const double gm = rounded(dice.log_uniform(0.01, 1e4));
    draft.attractor(dice.chance(0.5) ? std::vector<double>{0} : std::vector<double>{0, 0}, gm);
    for (int i = dice.whole(1, 3); i > 0; --i)
        add_orbit(dice, draft, gm, rounded(dice.log_uniform(0.5, 50)));
}

void attractors(Dice& dice, Draft& draft) {
    draft.axes = 2;
    const double gm = rounded(dice.log_uniform(0.1, 100));
    draft.attractor({0, 0}, gm);
    for (int i = dice.whole(1, 2); i > 0; --i)
        draft.attractor({rounded(dice.sign() * dice.uniform(4, 8)), rounded(dice.uniform(-8, 8))},
                        rounded(gm * dice.uniform(0.1, 1)));
    const double distance = rounded(dice.uniform(0.7, 2));
    draft.body(1, {distance, 0}, {0, rounded(std::sqrt(gm / distance) * dice.uniform(0.7, 1.2))});
    draft.limit(std::sqrt(gm) / turn, 30);
}

void projectiles(Dice& dice, Draft& draft, bool linear, bool quadratic) {
    draft.axes = dice.whole(1, 3);
    if (dice.chance(0.8)) draft.gravity(9.81);
    const double strength = dice.log_uniform(1e-4, 10);
    for (int i = dice.whole(1, 4); i > 0; --i)
        draft.body(mass_of(dice), random_point(dice, 10),
                   random_point(dice, dice.log_uniform(1, 300)),
                   drags(linear ? strength : 0, quadratic ? strength / 10 : 0));
    draft.longest = 60;
}

void linear_drag(Dice& dice, Draft& draft) { projectiles(dice, draft, true, false); }
void quadratic_drag(Dice& dice, Draft& draft) { projectiles(dice, draft, false, true); }
void both_drags(Dice& dice, Draft& draft) { projectiles(dice, draft, true, true); }
void free_flight(Dice& dice, Draft& draft) { projectiles(dice, draft, false, false); }

/// Different forces in one scene, without links.
void mixture(Dice& dice, Draft& draft) {
    draft.axes = 2;
    draft.gravity(9.81);
    add_oscillator(dice, draft, dice.log_uniform(0.1, 1e3), dice.log_uniform(0.1, 10), true);
    draft.body(mass_of(dice), {0}, random_point(dice, 50), drags(0, dice.log_uniform(1e-4, 0.1)));
    draft.body(mass_of(dice), {0}, random_point(dice, 50), drags(dice.log_uniform(1e-3, 1), 0));
    draft.body(1, {100, 100}, random_point(dice, 50));
    draft.longest = std::min(draft.longest, 30.0);
}

/// Up to 10,000 bodies from one table.
void many(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(2, 3);
    draft.gravity(9.81);
    const bool quadratic = dice.chance(0.3);
    const int count = static_cast<int>(dice.log_uniform(100, quadratic ? 300 : 10'000));
    const double drag = dice.log_uniform(1e-3, 1);
    const double speed = rounded(dice.log_uniform(1, 100));
    draft.text += fmt::format(
        "[[scatter]]\ncount = {}\nseed = {}\nposition_from = {}\nposition_to = {}\n"
        "velocity_from = {}\nvelocity_to = {}\n{}",
        count, dice.whole(0, 1000), draft.vector({-10, 0, -10}), draft.vector({10, 5, 10}),
        draft.vector({-speed, 0, -speed}), draft.vector({speed, speed, speed}),
        drags(quadratic ? 0 : drag, quadratic ? drag / 10 : 0));
    draft.longest = 3;
}

/// Nothing moves: springs at their anchors, a body in balance, a body without forces.
void at_rest(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 3);
    const bool falls = dice.chance(0.3);
    if (falls) draft.gravity(8);
    const std::string body = draft.body(1, {0, 0}, {0});
    // Stretched by 0.5 m, 16 N/m carry 8 N.
    std::vector<double> anchor{0, 0};
    if (falls) anchor[draft.axes == 1 ? 0 : 1] = 0.5;
    draft.spring(body, anchor, 16, dice.chance(0.5) ? 0 : 0.5);
    if (!falls) draft.body(1, random_point(dice, 10), {0});
}

double restitution_of(Dice& dice) {
    const int choice = dice.whole(0, 3);
    return choice == 0 ? 0 : choice == 1 ? 1 : rounded(dice.uniform(0.2, 0.95));
}

double friction_of(Dice& dice) { return dice.chance(0.4) ? 0 : rounded(dice.uniform(0.02, 1)); }

/// A body over a floor, with `contact` m.
std::string add_ball(Dice& dice, Draft& draft, double height, const std::string& more = "") {
    return draft.body(mass_of(dice), {rounded(dice.uniform(-1, 1)), height},
                      {rounded(dice.uniform(-5, 5)), rounded(dice.uniform(-3, 3))},
                      more + "contact = 0.125\n");
}

std::string some_drag(Dice& dice) {
    const int choice = dice.whole(0, 2);
    if (choice == 0) return "";
    return drags(choice == 1 ? dice.log_uniform(0.01, 1) : 0,
                 choice == 2 ? dice.log_uniform(0.01, 0.3) : 0);
}

/// Balls that bounce on a floor, which may be a slope, until they slide or rest.
void balls(Dice& dice, Draft& draft) {
    draft.axes = 2;
    draft.gravity(9.81);
    draft.plane({dice.chance(0.5) ? 0 : rounded(dice.uniform(-0.4, 0.4)), 1}, -1,
                restitution_of(dice), friction_of(dice));
    for (int i = dice.whole(1, 3); i > 0; --i)
        add_ball(dice, draft, rounded(dice.uniform(0.1, 3)), some_drag(dice));
    draft.longest = 4;
}

/// A body that slides from its start on, with friction and drag.
void slide(Dice& dice, Draft& draft) {
    draft.axes = 2;
    draft.gravity(9.81);
    draft.plane({0, 1}, 0, restitution_of(dice), friction_of(dice));
    const std::string body =
        draft.body(mass_of(dice), {0, 0.125}, {rounded(dice.uniform(1, 20)), 0},
                   some_drag(dice) + "contact = 0.125\n");
    if (dice.chance(0.3)) draft.spring(body, {0, 0.125}, rounded(dice.log_uniform(0.1, 10)), 0);
    draft.longest = 5;
}

void wind(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(2, 3);
    if (dice.chance(0.7)) draft.gravity(9.81);
    for (int i = dice.whole(1, 3); i > 0; --i) {
        const double omega = dice.log_uniform(0.5, 50);
        const double mass = mass_of(dice);
        const std::string body = draft.body(mass, random_point(dice, 3), random_point(dice, 10));
        draft.wind(body, random_point(dice, 15), rounded(mass * dice.log_uniform(1e-3, 0.3)));
        if (dice.chance(0.6)) draft.spring(body, {0}, rounded(mass * omega * omega), 0);
        draft.limit(omega / turn, 200);
    }
    draft.longest = std::min(draft.longest, 20.0);
}

void drive(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    const double omega = dice.log_uniform(0.5, 200);
    const double mass = mass_of(dice);
    const double stiffness = rounded(mass * omega * omega);
    const std::string body = draft.body(mass, random_point(dice, 1), {0});
    draft.spring(body, {0}, stiffness, damping_of(dice, mass, stiffness));
    draft.drive(body, random_point(dice, stiffness),
                rounded(omega / turn * dice.log_uniform(0.1, 3)), rounded(dice.uniform(0, turn)));
    draft.limit(omega / turn, 200);
}

/// A driven ball over a floor.
void driven_ball(Dice& dice, Draft& draft) {
    draft.axes = 2;
    draft.gravity(9.81);
    draft.plane({0, 1}, 0, restitution_of(dice), friction_of(dice));
    const std::string body = add_ball(dice, draft, rounded(dice.uniform(0.2, 2)));
    draft.drive(body, {0, rounded(dice.uniform(1, 40))}, rounded(dice.log_uniform(0.3, 5)),
                rounded(dice.uniform(0, turn)));
    draft.longest = 2;
}

/// A small net that falls onto a floor.
void falling_net(Dice& dice, Draft& draft) {
    draft.axes = 2;
    draft.gravity(9.81);
    draft.plane({0, 1}, 0, rounded(dice.uniform(0.2, 0.9)), dice.chance(0.5) ? 0 : 0.3);
    const double omega = dice.log_uniform(5, 60);
    const double damping = dice.chance(0.5) ? 0 : rounded(dice.uniform(0.1, 3));
    std::vector<std::string> names;
    for (int i = 0; i < 4; ++i)
        names.push_back(draft.body(1,
                                   {0.5 * (i % 2) + rounded(dice.uniform(-0.1, 0.1)),
                                    1 + 0.5 * (i / 2) + rounded(dice.uniform(-0.1, 0.1))},
                                   {rounded(dice.uniform(-1, 1)), rounded(dice.uniform(-3, 0))},
                                   "contact = 0.0625\n"));
    const auto join = [&](std::size_t a, std::size_t b, double length) {
        draft.link(names[a], names[b], rounded(omega * omega), damping, length);
    };
    join(0, 1, 0.5);
    join(2, 3, 0.5);
    join(0, 2, 0.5);
    join(1, 3, 0.5);
    join(0, 3, 0.707);
    draft.longest = 0.8;
}

constexpr Kind all[]{
    {"spring", single_spring},
    {"slow and fast", slow_and_fast},
    {"aliased", aliased},
    {"orbit", orbit},
    {"springs", several_springs},
    {"pair", linked_pair},
    {"chain", linear_chain},
    {"linear drag", linear_drag},
    {"quadratic drag", quadratic_drag},
    {"pendulum", pendulum},
    {"attractors", attractors},
    {"coiled chain", coiled_chain},
    {"mixture", mixture},
    {"many", many},
    {"both drags", both_drags},
    {"free flight", free_flight},
    {"at rest", at_rest},
    {"many springs", many_springs},
    {"balls", balls},
    {"wind", wind},
    {"drive", drive},
    {"slide", slide},
    {"driven ball", driven_ball},
    {"falling net", falling_net},
};

constexpr double smallest_tolerance = 1e-6;  ///< of the extent

/// The scene file. The default rate does not suit short scenes; few keep it.
std::string file_of(const Draft& draft, double duration, bool keeps_rate) {
    const double rate = std::clamp(std::ceil(4 / duration), 100.0, 1e6);
    return fmt::format("[scene]\naxes = {}\nduration = {}\n{}{}", draft.axes, duration,
                       keeps_rate ? "" : fmt::format("rate = {}\n", rate), draft.text);
}

/// The truth, if it is much better than any tolerance will be.
bool find_truth(Trap& trap) {
    try {
        trap.truth = std::make_unique<Truth>(trap.scene);
    } catch (const std::domain_error&) {
        return false;
    }
    trap.extent = static_cast<double>(trap.truth->extent(trap.scene.duration));
    return trap.truth->uncertainty() <= 1e-3 * smallest_tolerance * trap.extent;
}

Question question_of(Dice& dice, double extent, bool plain) {
    Question question;
    // Round-off is no motion.
    const double size = extent > 1e-15 ? extent : 1;
    question.tolerance =
        std::stod(fmt::format("{:.3g}", size * dice.log_uniform(smallest_tolerance, 0.3)));
    const int choice = dice.whole(0, 5);
    if (choice == 1 && !plain) question.meaning = Meaning::at_steps;
    if (choice == 2 && !plain) question.meaning = Meaning::display;
    if (choice == 3) question.gives_min_rate = true;
    if (choice == 4)
        for (int i = dice.whole(2, 4); i > 0; --i)
            question.methods.emplace_back(methods()[static_cast<std::size_t>(dice.whole(
                                                        0, static_cast<int>(methods().size()) - 1))]
                                              .name);
    return question;
}

}  // namespace

std::string Draft::vector(const std::vector<double>& numbers) const {
    std::string list;
    for (int axis = 0; axis < axes; ++axis)
        list += fmt::format("{}{}", axis > 0 ? ", " : "",
                            static_cast<std::size_t>(axis) < numbers.size()
                                ? numbers[static_cast<std::size_t>(axis)]
                                : 0.0);
    return "[" + list + "]";
}

std::string Draft::body(double mass, const std::vector<double>& position,
                        const std::vector<double>& velocity, const std::string& more) {
    const std::string name = fmt::format("b{}", bodies++);
    text += fmt::format("[[body]]\nname = \"{}\"\nmass = {}\nposition = {}\nvelocity = {}\n{}",
                        name, mass, vector(position), vector(velocity), more);
    return name;
}

void Draft::spring(const std::string& body, const std::vector<double>& anchor, double stiffness,
                   double damping, double rest_length) {
    text += fmt::format(
        "[[spring]]\nbody = \"{}\"\nanchor = {}\nstiffness = {}\ndamping = {}\nrest_length = {}\n",
        body, vector(anchor), stiffness, damping, rest_length);
}

void Draft::link(const std::string& body, const std::string& to, double stiffness, double damping,
                 double rest_length) {
    text += fmt::format(
        "[[spring]]\nbody = \"{}\"\nto = \"{}\"\nstiffness = {}\ndamping = {}\nrest_length = {}\n",
        body, to, stiffness, damping, rest_length);
}

void Draft::gravity(double g) {
    std::vector<double> acceleration(static_cast<std::size_t>(axes), 0.0);
    acceleration[axes == 1 ? 0 : 1] = -g;
    text += fmt::format("[gravity]\nacceleration = {}\n", vector(acceleration));
}

void Draft::attractor(const std::vector<double>& position, double gm) {
    text += fmt::format("[[attractor]]\nposition = {}\ngm = {}\n", vector(position), gm);
}

void Draft::wind(const std::string& body, const std::vector<double>& velocity, double drag) {
    text += fmt::format("[[wind]]\nbody = \"{}\"\nvelocity = {}\ndrag = {}\n", body,
                        vector(velocity), drag);
}

void Draft::drive(const std::string& body, const std::vector<double>& amplitude, double hertz,
                  double phase) {
    text += fmt::format("[[drive]]\nbody = \"{}\"\namplitude = {}\nfrequency = {}\nphase = {}\n",
                        body, vector(amplitude), hertz, phase);
}

void Draft::plane(const std::vector<double>& normal, double offset, double restitution,
                  double friction) {
    text += fmt::format("[[plane]]\nnormal = {}\noffset = {}\nrestitution = {}\nfriction = {}\n",
                        vector(normal), offset, restitution, friction);
}

void Draft::limit(double hertz, double periods) { longest = std::min(longest, periods / hertz); }

const Kind& kind_of(std::uint64_t seed) {
    constexpr std::size_t last = 6;  // with wind, a drive or a floor
    constexpr std::size_t others = std::size(all) - last;
    return seed % 4 == 3 ? all[others + seed / 4 % last] : all[seed % others];
}

Trap make_trap(std::uint64_t seed, const Kind& kind, bool plain) {
    Dice dice(seed);
    Draft draft;
    kind.make(dice, draft);
    // Longer runs than the truth can follow become as long as it can.
    double duration = dice.log_uniform(draft.shortest, 100);
    if (duration > draft.longest) duration = draft.longest * dice.uniform(0.3, 1);
    const bool keeps_rate = dice.chance(0.15);
    Trap trap{.kind = kind.name};
    // A motion that is not steady enough is cut short.
    do {
        trap.text = file_of(draft, std::stod(fmt::format("{:.3g}", duration)), keeps_rate);
        trap.scene = parse_scene(trap.text, "scene.toml");
        duration /= 4;
    } while (!find_truth(trap));
    trap.question = question_of(dice, trap.extent, plain);
    return trap;
}

}  // namespace oiler::trap
