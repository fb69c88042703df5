// SPDX-License-Identifier: MIT
#include "oiler/overlay/follower.hpp"

#include <cmath>

#include "oiler/game/look.hpp"

namespace oiler {
namespace {

constexpr double longest_double_click = 0.4;  // s
constexpr float widest_double_click = 6;      // canvas units

/// The body that is drawn nearest to a point.
std::optional<Entity> drawn_body_at(Point at, float height, const Picture& picture,
                                    const World& world) {
    const DrawnBodies drawn(picture);
    return body_at(at, height, world, [&](std::size_t row) -> std::optional<Vec3> {
        const DrawnBodies::Body* const body = drawn.find(world.entity_of_row(row));
        if (!body) return std::nullopt;
        return to_vec(body->centre);
    });
}

}  // namespace

bool Follower::is_double(const Click& click) const {
    return last_click_ && click.time - last_click_->time <= longest_double_click &&
           std::hypot(click.canvas.x - last_click_->canvas.x,
                      click.canvas.y - last_click_->canvas.y) <= widest_double_click;
}

void Follower::look(const Input& mouse, const Camera& shown, const Picture& picture,
                    const World& world, double time) {
    if (followed_ && !world.has_body(*followed_)) end();
    const std::optional<Point> at = mouse.pointer_canvas();
    if (!at || !mouse.held(Mouse::right)) held_.reset();
    if (!at) return;
    if (held_) {
        const float metres = shown.height / canvas_height;
        aside_ = {aside_.x - (at->x - held_->x) * metres, aside_.y - (at->y - held_->y) * metres};
    }
    if (mouse.held(Mouse::right)) held_ = at;
    if (!mouse.pressed(Mouse::left)) return;
    const Click click{*at, time, drawn_body_at(shown.to_world(*at), shown.height, picture, world)};
    if (!is_double(click)) {
        last_click_ = click;
        return;
    }
    const std::optional<Entity> body = last_click_->body ? last_click_->body : click.body;
    last_click_.reset();
    followed_ = body == followed_ ? std::nullopt : body;
    aside_ = {};
}

void Follower::move(Picture& picture) const {
    if (!followed_) return;
    const DrawnBodies drawn(picture);
    if (const DrawnBodies::Body* const body = drawn.find(*followed_))
        picture.camera.centre = {body->centre.x + aside_.x, body->centre.y + aside_.y};
}

}  // namespace oiler
