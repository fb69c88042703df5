// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "trap/traps.hpp"

namespace oiler::trap {

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

void Draft::limit(double hertz, double periods) { longest = std::min(longest, periods / hertz); }

}  // namespace oiler::trap
