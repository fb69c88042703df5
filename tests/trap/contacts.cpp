// SPDX-License-Identifier: MIT
// What surfaces do to the bodies of an integration.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "trap/integration.hpp"

namespace oiler::trap {
namespace {

constexpr std::size_t parts = 32;  ///< of a segment, in each of which an event is looked for

Real dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real length(const Point& d) { return std::sqrt(dot(d, d)); }
Point sum(const Point& a, Real factor, const Point& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
Point point_at(const Real* numbers) { return {numbers[0], numbers[1], numbers[2]}; }
void put(const Point& point, Real* numbers) { std::ranges::copy(point, numbers); }

}  // namespace

/// A root inside a segment.
struct Integration::Event {
    enum class Of { impact, lift, stop, slip, edge };
    std::size_t body = 0;
    const Surface* surface = nullptr;
    Of of = Of::impact;
    Real after = 0;  ///< s, from the start of the segment
};

/// Positions and velocities of a segment as polynomials, and at the ends of its parts.
struct Integration::Course {
    Course(Real start, Real length, const Nodes& at)
        : now(start), h(length), width(at.width), series_x(count * width), series_v(series_x) {
        const Chebyshev& rule = Chebyshev::get();
        for (std::size_t c = 0; c < width; ++c)
            for (std::size_t n = 0; n < Chebyshev::nodes; ++n)
                for (std::size_t j = 0; j < Chebyshev::nodes; ++j) {
                    series_x[c * count + n] += rule.transform[n][j] * at.x[j * width + c];
                    series_v[c * count + n] += rule.transform[n][j] * at.v[j * width + c];
                }
        for (std::size_t part = 0; part <= parts; ++part) go_to(end(part), x[part], v[part]);
    }
    void go_to(Real after, Numbers& to_x, Numbers& to_v) const {
        to_x.resize(width);
        to_v.resize(width);
        for (std::size_t c = 0; c < width; ++c) {
            to_x[c] = Chebyshev::sum(&series_x[c * count], 2 * after / h - 1);
            to_v[c] = Chebyshev::sum(&series_v[c * count], 2 * after / h - 1);
        }
    }
    [[nodiscard]] Real end(std::size_t part) const { return h * static_cast<Real>(part) / parts; }

    static constexpr std::size_t count = Chebyshev::coefficients;
    Real now;
    Real h;
    std::size_t width;
    Numbers series_x, series_v;
    std::array<Numbers, parts + 1> x{}, v{};
};

/// A slide along a curve turns with it.
Point Integration::Bearing::direction_at(const Point& normal) const {
    if (surface->shape != Surface::Shape::disc || length(direction) == 0) return direction;
    const Point turned{normal[1], -normal[0], 0};
    return sum({}, direction[2], turned);
}

Integration::Touch Integration::touch_of(std::size_t body, const Surface& surface, const Real* x,
                                         const Real* v, const Real* a, Real t) const {
    Touch touch{.normal = surface.normal_at(x + 3 * body, t)};
    const Point u = sum(point_at(v + 3 * body), -1, surface.velocity_at(t));
    const Point pull = sum(point_at(a + 3 * body), -1, surface.acceleration_at(t));
    touch.speed = -dot(touch.normal, u);
    touch.along = sum(u, touch.speed, touch.normal);
    touch.press = -dot(touch.normal, pull) -
                  surface.curvature(*system_.bodies[body].contact) * dot(touch.along, touch.along);
    touch.pull = sum(pull, -dot(touch.normal, pull), touch.normal);
    return touch;
}

Integration::Touch Integration::touch_of(std::size_t body, const Surface& surface, const Numbers& x,
                                         const Numbers& v, Real t) const {
    Numbers a(x.size());
    accelerate(x.data(), v.data(), t, a.data());
    return touch_of(body, surface, x.data(), v.data(), a.data(), t);
}

/// The accelerations with what the surfaces do to bodies that they bear.
void Integration::accelerate_on_surfaces(const Real* x, const Real* v, Real t, Real* a) const {
    accelerate(x, v, t, a);
    for (std::size_t i = 0; i < bearings_.size(); ++i) {
        const Bearing& bearing = bearings_[i];
        if (!bearing.surface) continue;
        const Touch touch = touch_of(i, *bearing.surface, x, v, a, t);
        const Point pushed = sum(point_at(a + 3 * i), touch.press, touch.normal);
        put(bearing.rests ? bearing.surface->acceleration_at(t)
                          : sum(pushed, -bearing.surface->friction * touch.press,
                                bearing.direction_at(touch.normal)),
            a + 3 * i);
    }
}

/// A number that is negative after the event: the height over a surface, the force onto it, the
/// speed in the direction of a slide, the friction that is left, or the way to an edge.
Real Integration::before(const Event& event, const Numbers& x, const Numbers& v, Real t) const {
    // A body on a disc goes on to the face beside it, which it touches only there.
    constexpr Real lid = 1e-13L;
    const Surface& surface = *event.surface;
    const Bearing& bearing = bearings_[event.body];
    const Real* const at = &x[3 * event.body];
    if (event.of == Event::Of::impact) {
        const bool on_disc = bearing.surface && bearing.surface->shape == Surface::Shape::disc;
        return surface.gap(at, t, *system_.bodies[event.body].contact, on_disc ? lid : 0);
    }
    if (event.of == Event::Of::edge) return -surface.beyond(at, t);
    const Touch touch = touch_of(event.body, surface, x, v, t);
    if (event.of == Event::Of::stop) return dot(bearing.direction_at(touch.normal), touch.along);
    if (event.of == Event::Of::slip) return surface.friction * touch.press - length(touch.pull);
    return touch.press;
}

/// The events that may happen to a body in its present state.
std::vector<Integration::Event> Integration::possible_events(std::size_t body) const {
    std::vector<Event> events;
    if (!system_.bodies[body].contact) return events;
    const Bearing& bearing = bearings_[body];
    for (const Surface& surface : system_.surfaces)
        if (&surface != bearing.surface) events.push_back({body, &surface});
    if (!bearing.surface) return events;
    events.push_back({body, bearing.surface, Event::Of::lift});
    events.push_back({body, bearing.surface, Event::Of::edge});
    if (bearing.rests) events.push_back({body, bearing.surface, Event::Of::slip});
    if (!bearing.rests && length(bearing.direction) > 0)
        events.push_back({body, bearing.surface, Event::Of::stop});
    return events;
}

/// The instant of the deepest point about the end of a part at which a gap is smallest, if it is
/// deep enough for an impact.
std::optional<Real> Integration::dip(const Event& event, const Course& course,
                                     std::size_t part) const {
    constexpr Real deep = -1e-16L;  // m
    const Real golden = (std::sqrt(Real(5)) - 1) / 2;
    Real low = course.end(part - 1);
    Real high = course.end(part + 1);
    Numbers x;
    Numbers v;
    const auto gap = [&](Real after) {
        course.go_to(after, x, v);
        return before(event, x, v, course.now + after);
    };
    for (int i = 0; i < 50; ++i) {
        const Real a = high - golden * (high - low);
        const Real b = low + golden * (high - low);
        (gap(a) < gap(b) ? high : low) = gap(a) < gap(b) ? b : a;
        if (gap((low + high) / 2) < deep) return (low + high) / 2;
    }
    return {};
}

std::optional<Real> Integration::time_of(const Event& event, const Course& course) const {
    std::array<Real, parts + 1> value;
    for (std::size_t part = 0; part <= parts; ++part)
        value[part] = before(event, course.x[part], course.v[part], course.now + course.end(part));
    Real low = 0;
    std::optional<Real> high;
    for (std::size_t part = 1; part <= parts && !high; ++part) {
        low = course.end(part - 1);
        if (value[part] < 0) high = course.end(part);
        if (high || part == parts || event.of != Event::Of::impact) continue;
        const Real before_it = value[part - 1] - value[part];
        const Real after_it = value[part + 1] - value[part];
        if (before_it >= 0 && after_it > 0 && value[part] < std::max(before_it, after_it))
            high = dip(event, course, part);
    }
    if (!high) return {};
    Numbers x;
    Numbers v;
    for (int i = 0; i < 90; ++i) {
        const Real middle = (low + *high) / 2;
        course.go_to(middle, x, v);
        (before(event, x, v, course.now + middle) < 0 ? *high : low) = middle;
    }
    return event.of == Event::Of::slip ? *high : low;
}

std::optional<Integration::Event> Integration::first_event(const Course& course) const {
    std::optional<Event> first;
    for (std::size_t body = 0; body < bearings_.size(); ++body)
        for (Event event : possible_events(body)) {
            const std::optional<Real> after = time_of(event, course);
            if (!after || (first && *after >= first->after)) continue;
            event.after = *after;
            first = event;
        }
    return first;
}

/// Moves the start to the first event of a segment, if there is one.
bool Integration::meet_first(Real h, Nodes& at) {
    const Course course(now_, h, at);
    const std::optional<Event> event = first_event(course);
    if (event) meet(*event, course, at);
    return event.has_value();
}

/// Moves the start to the event and changes what it changes.
void Integration::meet(const Event& event, const Course& course, Nodes& at) {
    Numbers x;
    Numbers v;
    course.go_to(event.after, x, v);
    std::ranges::copy(x, at.x.begin());
    std::ranges::copy(v, at.v.begin());
    now_ += event.after;
    if (event.of == Event::Of::lift) bearings_[event.body] = {};
    if (event.of == Event::Of::impact) land(event.body, *event.surface, at);
    if (event.of == Event::Of::edge) cross_edge(event.body, at);
    if (event.of == Event::Of::stop || event.of == Event::Of::slip) {
        put(event.surface->velocity_at(now_), &at.v[3 * event.body]);
        slide(event.body, *event.surface, at, event.of == Event::Of::slip);
    }
}

/// An impact with Coulomb's friction. Bounces that are over within a picosecond leave the body on
/// the surface.
void Integration::land(std::size_t body, const Surface& surface, Nodes& at) {
    constexpr Real shortest = 1e-12L;  // s
    Real* const x = &at.x[3 * body];
    const Touch touch = touch_of(body, surface, at.x, at.v, now_);
    const Surface* const old = bearings_[body].surface;
    const bool goes_on = old && dot(old->normal_at(x, now_), touch.normal) > 1 - 1e-9L;
    const Real bounce = surface.restitution * touch.speed;
    const bool over = goes_on || (touch.press > 0 &&
                                  2 * bounce <= shortest * touch.press * (1 - surface.restitution));
    const Real kept = over ? 0 : bounce;
    const Real glide = length(touch.along);
    const Real lost = goes_on ? 0 : surface.friction * (touch.speed + kept);
    put(sum(point_at(x), -surface.height(x, now_, *system_.bodies[body].contact), touch.normal), x);
    const Point slid =
        sum(surface.velocity_at(now_), lost < glide ? 1 - lost / glide : 0, touch.along);
    put(sum(slid, kept, touch.normal), &at.v[3 * body]);
    if (old && !goes_on) {
        // The impact must take the body off what bore it.
        const Touch left = touch_of(body, *old, at.x, at.v, now_);
        if (left.speed >= 0) throw std::domain_error("two surfaces bear a body");
    }
    bearings_[body] = {};
    if (over) slide(body, surface, at);
}

/// A body at the end of a bar goes on to the next one or to the disc at its end.
void Integration::cross_edge(std::size_t body, Nodes& at) {
    constexpr Real close = 1e-12L;  // m
    constexpr Real ahead = 1e-9L;   // m
    const Surface& old = *bearings_[body].surface;
    const Touch touch = touch_of(body, old, at.x, at.v, now_);
    const Point next = sum(point_at(&at.x[3 * body]), ahead / length(touch.along), touch.along);
    const Surface* found = nullptr;
    for (const Surface& one : system_.surfaces) {
        const Real height = one.height(&at.x[3 * body], now_, *system_.bodies[body].contact);
        if (&one == &old || std::abs(height) > close || one.beyond(next.data(), now_) > 0) continue;
        if (!found || one.shape == Surface::Shape::bar) found = &one;
    }
    if (!found) throw std::domain_error("an edge has no corner");
    slide(body, *found, at);
}

/// Puts a body on a surface: it rests, slides in the direction of its velocity or of the pull, or
/// leaves a surface that turns away.
void Integration::slide(std::size_t body, const Surface& surface, Nodes& at, bool slips) {
    const Touch touch = touch_of(body, surface, at.x, at.v, now_);
    Bearing bearing{.surface = &surface};
    const Real speed = length(touch.along);
    const Real strength = length(touch.pull);
    bearing.rests = !slips && speed == 0 && strength <= surface.friction * touch.press;
    if (!bearing.rests && surface.friction > 0)
        bearing.direction =
            speed > 0 ? sum({}, 1 / speed, touch.along) : sum({}, 1 / strength, touch.pull);
    // On a disc, z tells the sense.
    if (surface.shape == Surface::Shape::disc && length(bearing.direction) > 0)
        bearing.direction = {
            0, 0,
            bearing.direction[0] * touch.normal[1] > bearing.direction[1] * touch.normal[0]
                ? Real(1)
                : Real(-1)};
    bearings_[body] = touch.press < 0 ? Bearing{} : bearing;
}

/// A body that starts on a surface and does not leave it slides or rests.
void Integration::start_on_surface(std::size_t body, Nodes& at) {
    if (!system_.bodies[body].contact) return;
    for (const Surface& surface : system_.surfaces) {
        const Real gap = surface.gap(&at.x[3 * body], now_, *system_.bodies[body].contact);
        const Touch touch = touch_of(body, surface, at.x, at.v, now_);
        if (std::abs(gap) < 1e-15L && touch.speed == 0 && touch.press > 0) slide(body, surface, at);
    }
}

}  // namespace oiler::trap
