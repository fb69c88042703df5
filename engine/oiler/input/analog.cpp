// SPDX-License-Identifier: MIT
#include "oiler/input/analog.hpp"

#include <algorithm>
#include <cmath>

namespace oiler {
namespace {

constexpr double full = 32767;
constexpr double inner = 0.24;
constexpr double outer = 0.95;

Deflection rounded(double part) { return static_cast<Deflection>(std::lround(part * 127)); }

}  // namespace

StickPosition without_dead_zone(int x, int y) {
    const double length = std::hypot(x, y) / full;
    if (!(length > inner)) return {};
    const double scale = std::min((length - inner) / (outer - inner), 1.0) / (length * full);
    return {rounded(x * scale), rounded(y * scale)};
}

Deflection trigger_position(int raw) { return rounded(std::clamp(raw / full, 0.0, 1.0)); }

bool trigger_is_pressed(bool was, int raw) { return raw / full >= (was ? 0.4 : 0.6); }

}  // namespace oiler
