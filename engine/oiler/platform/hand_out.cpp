// SPDX-License-Identifier: MIT
#include "oiler/platform/hand_out.hpp"

#include <algorithm>
#include <iterator>

namespace oiler {
namespace {

/// Whether a key acts as a key while text is entered.
bool edits_text(Button key) {
    constexpr Button keys[]{Key::enter, Key::escape, Key::backspace, Key::tab,
                            Key::left,  Key::right,  Key::up,        Key::down};
    return std::ranges::find(keys, key) != std::end(keys);
}

Point canvas_point(int x, int y, Size part) {
    const auto width = static_cast<float>(part.width);
    const auto height = static_cast<float>(part.height);
    const float scale = std::min(width / canvas_width, height / canvas_height);
    return {canvas_width / 2 + (static_cast<float>(x) + 0.5F - width / 2) / scale,
            canvas_height / 2 - (static_cast<float>(y) + 0.5F - height / 2) / scale};
}

}  // namespace

void Receivers::set_key(Button key, bool down, bool enters_text) const {
    loop.set(key, down);
    if (is_of_loop(key)) return;
    if (enters_text && down && !edits_text(key)) return;
    if (!of_game.escape && down && key == Button(Key::escape)) return;
    game.set(key, down);
}

void Receivers::move_mouse(int x, int y, Size part, std::optional<Button> button, bool down) const {
    const Point at = canvas_point(x, y, part);
    const bool is_of_game = of_game.mouse && x < part.width;
    if (is_of_game) game.point_at(at);
    loop.point_at(at);
    if (!button) return;
    if (is_of_game || !down) game.set(*button, down);
    loop.set(*button, down);
}

void Receivers::turn_wheel(int notches) const {
    if (of_game.mouse) game.turn_wheel(notches);
    loop.turn_wheel(notches);
}

void Receivers::leave() const {
    game.point_at(std::nullopt);
    loop.point_at(std::nullopt);
}

void Receivers::release_all() const {
    game.release_all();
    loop.release_all();
}

}  // namespace oiler
