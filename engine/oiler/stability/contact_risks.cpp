// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "oiler/core/error.hpp"
#include "oiler/math/matrix.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// The largest radius for which planes have room, and the planes that limit it.
struct Room {
    double radius = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> planes{};
};

/// Searches the sets of up to axes + 1 planes whose normals have a sum Σwn = 0 with weights w > 0
/// and Σw = 1: they leave room for a radius of −Σw·offset (Farkas' lemma and Carathéodory's
/// theorem).
class RoomSearch {
public:
    /// Of many planes only the first ones are searched: the number of sets grows with its power of
    /// axes + 1.
    static constexpr std::size_t most_planes = 32;

    RoomSearch(const std::vector<Plane>& planes, int axes)
        : planes_(planes), most_(static_cast<std::size_t>(axes) + 1) {
        add_from(0);
    }
    [[nodiscard]] const Room& room() const { return room_; }

private:
    void add_from(std::size_t first) {
        for (std::size_t i = first; i < std::min(planes_.size(), most_planes); ++i) {
            chosen_.push_back(i);
            measure();
            if (chosen_.size() < most_) add_from(i + 1);
            chosen_.pop_back();
        }
    }
    /// The weights solve (n_i·n_j + 1)·w = 1; their sum is 1 only if Σwn = 0.
    void measure() {
        Matrix<double, 4> gram = Matrix<double, 4>::scalar(1);
        Vec<double, 4> ones{};
        for (std::size_t i = 0; i < chosen_.size(); ++i) {
            ones.axis[i] = 1;
            for (std::size_t j = 0; j < chosen_.size(); ++j)
                gram.row[i].axis[j] = 1 + dot(normal(i), normal(j));
        }
        const Vec<double, 4> weights = solve(gram, ones);
        double sum = 0;
        double radius = 0;
        for (std::size_t i = 0; i < chosen_.size(); ++i) {
            if (!(weights.axis[i] > 0)) return;
            sum += weights.axis[i];
            radius -= weights.axis[i] * planes_[chosen_[i]].offset / scale(i);
        }
        if (std::abs(sum - 1) < 1e-12 && radius < room_.radius) room_ = {radius, chosen_};
    }
    [[nodiscard]] double scale(std::size_t i) const { return length(planes_[chosen_[i]].normal); }
    [[nodiscard]] Vec3 normal(std::size_t i) const { return planes_[chosen_[i]].normal / scale(i); }

    const std::vector<Plane>& planes_;
    std::size_t most_;
    std::vector<std::size_t> chosen_{};
    Room room_{};
};

std::string list(const std::vector<std::size_t>& planes) {
    std::string text = fmt::format("planes {}", planes.front());
    for (std::size_t i = 1; i < planes.size(); ++i)
        text += fmt::format("{}{}", i + 1 < planes.size() ? ", " : " and ", planes[i]);
    return text;
}

std::string describe(const Room& room, double radius) {
    const std::string planes = list(room.planes);
    if (room.radius < 0)
        return fmt::format(
            "body {{}}: {} contradict each other: every point is {:.4g} m or more below one of "
            "them: reverse a normal, or move a plane",
            planes, -room.radius);
    return fmt::format(
        "body {{}}: {} leave room for a radius of {:.4g} m, and its contact of {:.4g} m does not "
        "fit: move them apart, or give it a smaller contact",
        planes, room.radius, radius);
}

/// The first plane in which a ball starts deeper than rounding explains; empty if it is in none.
std::string start_below(const std::vector<Plane>& planes, const Vec3& x, double radius,
                        double hidden) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const double depth =
            radius - (dot(planes[i].normal, x) - planes[i].offset) / length(planes[i].normal);
        if (depth > hidden * (largest(x) + radius))
            return fmt::format(
                "body {{}} starts {:.3g} m inside plane {}, and is lifted out of it at once: move "
                "it",
                depth, i);
    }
    return {};
}

/// Whether a body meets all planes. Of one that does not, nothing is told.
bool meets_all(const Bodies& bodies, const std::vector<Plane>& planes, const Contact& contact) {
    return contact.meets == ~0U || bodies.planes(contact.meets).size() == planes.size();
}

void add_room_risks(const Bodies& bodies, std::vector<Risk>& risks) {
    const std::vector<Plane> planes = bodies.planes();
    const Room room = RoomSearch(planes, bodies.axes()).room();
    const double hidden = bodies.precision() == Precision::single ? 1e-6 : 1e-9;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const auto contact = bodies.contact(row);
        if (!contact || !meets_all(bodies, planes, *contact)) continue;
        const bool fits = contact->radius <= room.radius + 1e-9 * std::abs(room.radius);
        std::string message =
            fits ? start_below(planes, bodies.position(row), contact->radius, hidden)
                 : describe(room, contact->radius);
        if (!message.empty())
            risks.push_back({.row = row, .of = Risk::Of::told, .message = std::move(message)});
    }
}

/// The speed that a bounce gains by the method's error, in units of the acceleration into the plane
/// times dt; negative if it loses speed.
double gain_of_bounce(const Method& method, const std::optional<Damping>& damping) {
    Bodies ball(1, Precision::double_);
    ball.set_gravity({-1});
    ball.add_plane({.normal = {1}, .restitution = 1});
    ball.add({.position = {480.3}, .contact = Contact{}});
    std::vector<double> speeds;
    for (std::int64_t tick = 0; tick < 1000 && speeds.size() < 6; ++tick) {
        if (ball.try_step(method, {{1}, tick, 1, damping})) return 0;
        for (std::size_t i = 0; i < ball.impact_count(); ++i)
            speeds.push_back(-ball.impact_at(i, {1}).before[0]);
    }
    if (speeds.size() < 2) return 0;
    return (speeds.back() - speeds.front()) / static_cast<double>(speeds.size() - 1);
}

/// The bounce of a body on a plane as far as it is known before the run.
struct Bounce {
    double pull = 0;   ///< m/s², the acceleration into the plane
    double speed = 0;  ///< m/s, into the plane, without drag
};

Bounce bounce_of(const Bodies& bodies, std::size_t row, const Plane& plane, double radius) {
    const double scale = length(plane.normal);
    const Vec3 normal = plane.normal / scale;
    const double gap = dot(normal, bodies.position(row)) - plane.offset / scale - radius;
    const State<double, 3> touching{bodies.position(row) - normal * std::max(gap, 0.0),
                                    bodies.velocity(row)};
    Vec3 acceleration{};
    for_each_force_on(bodies, row, [&](const auto& force) {
        acceleration = acceleration + accelerate(force, touching, 0);
    });
    const double pull = -dot(normal, acceleration);
    const double away = dot(normal, bodies.velocity(row));
    return {pull, std::sqrt(std::max(away * away + 2 * pull * std::max(gap, 0.0), 0.0))};
}

/// Whether the method's error c spoils bounces of eight steps and more, and changes the speed
/// within a hundred of them. With restitution e each bounce has the speed e·v + c, which tends to
/// c/(1 − e) = w: a gain never lets it fall below. After a loss, the speed u falls to v until
/// u − v − w·ln((u + w)/(v + w)) is u/2, the time in which restitution alone halves it; then v is
/// less than u/4 if w > 0.286u.
bool spoils(const Bounce& bounce, double restitution, double gain) {
    const double change = std::abs(gain);
    const double lost = (1 - restitution) * bounce.speed;
    const double speed = gain > 0 && change < lost ? change / (1 - restitution) : bounce.speed;
    return change > 0 && restitution * speed >= 4 * change && speed <= 100 * change &&
           (gain > 0 || change >= 0.286 * lost);
}

std::string describe(const Bounce& bounce, std::size_t plane, double gain, const Method& method) {
    const std::string effect =
        gain < 0 ? fmt::format(
                       "takes {:.3g} m/s from each bounce of up to {:.3g} m/s, which end "
                       "too early",
                       -gain, bounce.speed)
                 : fmt::format(
                       "adds {:.3g} m/s to each bounce of up to {:.3g} m/s, which do not "
                       "end",
                       gain, bounce.speed);
    return fmt::format("body {{}} on plane {}: {} {}: take velocity_verlet", plane, method.name,
                       effect);
}

void add_bounce_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                      std::vector<Risk>& risks) {
    const auto bounces = [](const Plane& plane) { return plane.restitution > 0; };
    const std::vector<Plane> planes = bodies.planes();
    if (!std::ranges::any_of(planes, bounces)) return;
    const double gain = gain_of_bounce(method, steps.damping) * steps.rate.dt();
    if (std::abs(gain) < 1e-9 * steps.rate.dt()) return;
    const std::vector<bool> linked = bodies.linked_rows();
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const auto contact = bodies.contact(row);
        if (!contact || linked[row] || !meets_all(bodies, planes, *contact)) continue;
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const Plane& plane = planes[i];
            const Bounce bounce = bounce_of(bodies, row, plane, contact->radius);
            if (!(bounce.pull > 0) || !spoils(bounce, plane.restitution, gain * bounce.pull))
                continue;
            risks.push_back({.row = row,
                             .of = Risk::Of::told,
                             .message = describe(bounce, i, gain * bounce.pull, method)});
            break;
        }
    }
}

}  // namespace

void add_contact_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                       std::vector<Risk>& risks) {
    if (bodies.planes().empty()) return;
    add_room_risks(bodies, risks);
    add_bounce_risks(bodies, method, steps, risks);
}

}  // namespace oiler
