// SPDX-License-Identifier: MIT
#include "oiler/input/input.hpp"

#include <algorithm>
#include <cmath>

namespace oiler {
namespace {

bool any_of(const Buttons& buttons, const HeldButtons& held) {
    return std::any_of(buttons.begin(), buttons.end(),
                       [&](const Button& button) { return held[button.id()]; });
}

}  // namespace

const Control* Input::chosen(std::string_view name) const {
    if (!controls_) return nullptr;
    const auto found = std::ranges::find(*controls_, name, &Control::name);
    return found == controls_->end() ? nullptr : &*found;
}

bool Input::held(const Action& action) const {
    const Control* const control = chosen(action.name);
    return any_of(control ? control->positive : action.buttons, held_);
}

int Input::presses(const Action& action) const {
    const Control* const control = chosen(action.name);
    return count(control ? control->positive : action.buttons, true);
}

int Input::releases(const Action& action) const {
    const Control* const control = chosen(action.name);
    return count(control ? control->positive : action.buttons, false);
}

int Input::count(const Buttons& buttons, bool down) const {
    int changes = 0;
    HeldButtons held = before_;
    for (const Edge& edge : edges_) {
        const bool before = any_of(buttons, held);
        held[edge.button.id()] = edge.down;
        if (any_of(buttons, held) != before && before != down) ++changes;
    }
    return changes;
}

float Input::axis(const Axis& axis) const {
    const Control* const control = chosen(axis.name);
    const Control numbers = control ? *control : Control(axis);
    float sum = numbers.stick ? stick(*numbers.stick) : 0;
    if (any_of(numbers.positive, held_)) sum += 1;
    if (any_of(numbers.negative, held_)) sum -= 1;
    return std::clamp(sum, -1.0F, 1.0F);
}

Point Input::direction(const Axis& x, const Axis& y) const {
    const Point given{axis(x), axis(y)};
    const float length = std::sqrt(given.x * given.x + given.y * given.y);
    return length > 1 ? Point{given.x / length, given.y / length} : given;
}

std::optional<Point> Input::pointer() const {
    if (!pointer_) return std::nullopt;
    return pointer_->camera.to_world(pointer_->canvas);
}

std::optional<Point> Input::pointer_canvas() const {
    if (!pointer_) return std::nullopt;
    return pointer_->canvas;
}

}  // namespace oiler
