// SPDX-License-Identifier: MIT
#include "oiler/input/input.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oiler {
namespace {

bool any_of(const Buttons& buttons, const HeldButtons& held) {
    return std::ranges::any_of(buttons, [&](Button button) { return held[button.id()]; });
}

float to_sixteenths(float canvas) { return std::round(canvas * 16) / 16; }

/// Moves the last release of each button that a step sees pressed, and that is up at its end, to
/// the next step.
std::vector<Edge> take_late_releases(std::vector<Edge>& edges) {
    std::vector<Edge> late;
    HeldButtons pressed;
    HeldButtons decided;
    for (const Edge& edge : edges)
        if (edge.down) pressed.set(edge.button.id());
    for (std::size_t i = edges.size(); i-- > 0;) {
        const std::size_t id = edges[i].button.id();
        if (decided[id]) continue;
        decided.set(id);
        if (edges[i].down || !pressed[id]) continue;
        late.insert(late.begin(), edges[i]);
        edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return late;
}

}  // namespace

const Control* Input::chosen(std::string_view name) const {
    if (!controls_) return nullptr;
    const auto found = std::ranges::find(*controls_, name, &Control::name);
    return found == controls_->end() ? nullptr : &*found;
}

const Buttons& Input::buttons_of(const Action& action) const {
    const Control* const control = chosen(action.name);
    return control ? control->positive : action.buttons;
}

bool Input::held(const Action& action) const { return any_of(buttons_of(action), held_); }

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

void InputQueue::set(Button button, bool down) {
    if (now_[button.id()] == down) return;
    now_[button.id()] = down;
    if (!paused_) next_.edges_.push_back({button, down});
}

void InputQueue::release_all() {
    for (std::uint16_t id = 0; id < Button::count; ++id)
        if (now_[id]) set(*Button::of_id(id), false);
    next_.sticks_ = {};
}

void InputQueue::point_at(std::optional<Point> canvas) {
    next_.pointer_.reset();
    if (canvas) next_.pointer_ = Pointer{{to_sixteenths(canvas->x), to_sixteenths(canvas->y)}, {}};
}

void InputQueue::set_paused(bool paused) {
    if (paused_ && !paused) drop_taps();
    if (!paused_ && paused) at_pause_ = now_;
    paused_ = paused;
}

void InputQueue::drop_taps() {
    for (std::uint16_t id = 0; id < Button::count; ++id)
        if (now_[id] != at_pause_[id]) next_.edges_.push_back({*Button::of_id(id), now_[id]});
    at_pause_ = now_;
}

void InputQueue::continue_after(const Input& last) {
    next_.held_ = at_pause_ = last.held_;
    next_.edges_.clear();
    next_.wheel_ = 0;
    next_.text_.clear();
    next_.restarts_ = false;
    pointed_ = last.pointer_canvas();
    if (!paused_) drop_taps();
}

Input InputQueue::take(const Camera& shown) {
    if (paused_) drop_taps();
    std::vector<Edge> late = take_late_releases(next_.edges_);
    Input input = next_;
    input.before_ = std::exchange(next_.held_, now_);
    for (const Edge& edge : late) next_.held_.set(edge.button.id());
    input.held_ = next_.held_;
    input.controls_ = controls_;
    if (input.pointer_) input.pointer_->camera = shown;
    const auto pointed = std::exchange(pointed_, input.pointer_canvas());
    input.pointer_moved_ = pointed_ && pointed_ != pointed;
    next_.edges_ = std::move(late);
    next_.wheel_ = 0;
    next_.text_.clear();
    next_.restarts_ = false;
    return input;
}

}  // namespace oiler
