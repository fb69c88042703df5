// SPDX-License-Identifier: MIT
#include "oiler/world/world.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "oiler/core/error.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/sim/limits.hpp"
#include "oiler/stability/preflight.hpp"
#include "oiler/world/name.hpp"
#include "oiler/world/search_ball.hpp"

namespace oiler {
namespace {

/// The number of teleports of a body; only teleported bodies have this component.
struct Jumps {
    std::uint32_t count = 0;
};

}  // namespace

World::World(int axes, const Settings& settings)
    : settings_(settings),
      bodies_(std::make_unique<Bodies>(axes, settings.stepping.precision)),
      random_(settings.seed) {
    const Rate rate = settings.stepping.rate;
    if (rate.steps < 1 || rate.seconds < 1)
        fail(Exit::usage, "a rate of {} steps in {} s: give at least 1 step and 1 s", rate.steps,
             rate.seconds);
    bodies_->set_threads(settings.threads);
}

World::World(const World& other)
    : settings_(other.settings_),
      tick_(other.tick_),
      slots_(other.slots_),
      numbers_(other.numbers_),
      next_number_(other.next_number_),
      bodies_(std::make_unique<Bodies>(*other.bodies_)),
      rows_(other.rows_),
      impacts_(other.impacts_),
      random_(other.random_),
      make_start_(other.make_start_) {
    require(other.visits_ == 0, "a world is not copied inside its own each");
    for (const TaggedPool& entry : other.pools_) pools_.push_back({entry.tag, entry.pool->clone()});
    for (const TaggedTimers& entry : other.timers_)
        timers_.push_back({entry.tag, entry.timers->clone()});
}

World::World(World&&) noexcept = default;

World::~World() = default;

World& World::operator=(const World& other) {
    if (this != &other) *this = World(other);
    return *this;
}

World& World::operator=(World&& other) {
    require(visits_ == 0 && other.visits_ == 0,
            "a world is not replaced inside its own each; restart after it, or with Loop::restart");
    settings_ = other.settings_;
    tick_ = other.tick_;
    age_ = other.age_;
    slots_ = std::move(other.slots_);
    numbers_ = std::move(other.numbers_);
    next_number_ = other.next_number_;
    pools_ = std::move(other.pools_);
    if (bodies_ && other.bodies_)
        *bodies_ = std::move(*other.bodies_);  // references to the bodies stay valid
    else
        bodies_ = std::move(other.bodies_);
    rows_ = std::move(other.rows_);
    impacts_ = std::move(other.impacts_);
    timers_ = std::move(other.timers_);
    random_ = other.random_;
    make_start_ = std::move(other.make_start_);
    return *this;
}

template <class F>
void World::placed(const char* call, F f) {
    try {
        f();
    } catch (const Error& error) {
        refuse(call, error);
    }
}

template <class F>
void World::change(const char* call, Entity entity, F f) {
    require_of(entity, has_body(entity), call, no_body);
    try {
        f(rows_.place(entity.index));
    } catch (const Error& error) {
        refuse(call, entity, error);
    }
}

Entity World::create() {
    const auto entity = slots_.take<Entity>();
    if (next_number_) {
        numbers_.resize(slots_.size());
        numbers_[entity.index] = (*next_number_)++;
    }
    return entity;
}

void World::number_entities() {
    if (next_number_) return;
    numbers_.resize(slots_.size());
    std::iota(numbers_.begin(), numbers_.end(), std::uint64_t{0});
    next_number_ = numbers_.size();
}

std::uint64_t World::number(Entity entity) const {
    return next_number_ ? numbers_[entity.index] : entity.id();
}

void World::destroy(Entity entity) {
    require_of(entity, alive(entity), "destroy", gone);
    for (const TaggedPool& entry : pools_) erase(*entry.pool, entity.index);
    if (rows_.place(entity.index) != SlotSet::absent) remove_row(entity.index);
    slots_.release(entity.index);
}

bool World::alive(Entity entity) const { return slots_.holds(entity.index, entity.generation); }

std::size_t World::entity_count() const { return slots_.used(); }

void World::add_body(Entity entity, const Body& body, const GivenForces& forces) {
    require_of(entity, alive(entity), "add_body", gone);
    require_of(entity, !has_body(entity), "add_body", "it has a body already");
    placed("add_body", [&] { bodies_->add(body, forces); });
    rows_.add(entity.index);
}

Entity World::spawn(const Body& body, const GivenForces& forces) {
    placed("spawn", [&] { bodies_->add(body, forces); });
    const Entity entity = create();
    rows_.add(entity.index);
    return entity;
}

void World::attach_given(const char* call, std::size_t index, Entity entity,
                         const GivenForces& forces) {
    change(call, entity, [&](std::size_t row) { bodies_->attach_at(index, row, forces); });
}

void World::detach_kind(Entity entity, std::size_t kind) {
    bodies_->detach_kind(row(entity), kind);
}

void World::reserve(std::size_t bodies) {
    bodies_->reserve(bodies);
    rows_.reserve(bodies);
    slots_.reserve(bodies);
}

void World::remove_body(Entity entity) {
    require_of(entity, has_body(entity), "the body", no_body);
    remove_row(entity.index);
}

void World::remove_row(std::uint32_t slot) {
    const std::uint32_t place = rows_.hide(slot);
    if (visits_ > 0) return removed_rows_.push_back(place);
    bodies_->remove(place);
    rows_.fill(place);
}

void World::fill_holes() {
    for (const TaggedPool& entry : pools_) entry.pool->fill_holes();
    for (const std::uint32_t hole : last_first(removed_rows_)) {
        bodies_->remove(hole);
        rows_.fill(hole);
    }
}

bool World::has_body(Entity entity) const {
    return alive(entity) && rows_.place(entity.index) != SlotSet::absent;
}

std::size_t World::row(Entity entity) const {
    require_of(entity, has_body(entity), "the body", no_body);
    return rows_.place(entity.index);
}

Entity World::entity_of_row(std::size_t row) const {
    require(row < rows_.size() && rows_[row] != SlotSet::absent,
            "there is no body in this row, or it was removed in this each");
    return {rows_[row], slots_.generation(rows_[row])};
}

void World::throw_mistake(const char* call, Entity entity, const char* what) const {
    throw Mistake(
        fmt::format("{} of entity {} at tick {}: {}", call, label_in(*this, entity), tick_, what));
}

void World::refuse(const char* call, const Error& error) const {
    // Before the first step, a number was written, not computed.
    const bool computed = tick_ > 0 && dynamic_cast<const NotFinite*>(&error);
    fail(computed ? Exit::diverged : error.exit(), "{} at tick {}: {}", call, tick_, error.what());
}

void World::refuse(const char* call, Entity entity, const Error& error) const {
    const bool computed = dynamic_cast<const NotFinite*>(&error);
    fail(computed ? Exit::diverged : error.exit(), "{} of entity {} at tick {}: {}", call,
         label_in(*this, entity), tick_, error.what());
}

Vec3 World::position(Entity entity) const { return bodies_->position(row(entity)); }
Vec3 World::position_of_row(std::size_t row) const { return bodies_->position(row); }
Vec3 World::velocity(Entity entity) const { return bodies_->velocity(row(entity)); }
double World::mass(Entity entity) const { return bodies_->mass(row(entity)); }

void World::set_velocity(Entity entity, const Vec3& velocity) {
    change("set_velocity", entity, [&](std::size_t row) { bodies_->set_velocity(row, velocity); });
}

void World::set_position(Entity entity, const Vec3& position) {
    change("set_position", entity, [&](std::size_t row) { bodies_->set_position(row, position); });
}

void World::apply_force(Entity entity, const Vec3& force) {
    change("apply_force", entity, [&](std::size_t row) { bodies_->apply_force(row, force); });
}

void World::forget_forces() { bodies_->forget_forces(); }

void World::apply_impulse(Entity entity, const Vec3& impulse) {
    change("apply_impulse", entity, [&](std::size_t row) { bodies_->apply_impulse(row, impulse); });
}

void World::set_contact(Entity entity, const std::optional<Contact>& contact) {
    change("set_contact", entity, [&](std::size_t row) { bodies_->set_contact(row, contact); });
}

ObstacleHandle World::add_obstacle(const Obstacle& obstacle) {
    ObstacleHandle handle;
    placed("add_obstacle", [&] { handle = bodies_->add_obstacle(obstacle); });
    return handle;
}

ObstacleHandle World::add_plane(const Plane& plane) {
    ObstacleHandle handle;
    placed("add_plane", [&] { handle = bodies_->add_plane(plane); });
    return handle;
}

std::vector<ObstacleHandle> World::add_chain(std::span<const Vec3> points, bool closed,
                                             const Obstacle& like) {
    const std::size_t least = closed ? 3 : 2;
    placed("add_chain", [&] {
        if (points.size() < least)
            fail(Exit::usage, "{} points: give at least {}", points.size(), least);
    });
    std::vector<ObstacleHandle> handles;
    try {
        for (std::size_t i = 0; i < points.size() - (closed ? 0 : 1); ++i) {
            Obstacle segment = like;
            segment.shape = SegmentShape{points[i], points[(i + 1) % points.size()]};
            handles.push_back(add_obstacle(segment));
        }
    } catch (...) {
        for (const ObstacleHandle handle : handles) remove_obstacle(handle);
        throw;
    }
    return handles;
}

template <class F>
void World::change(const char* call, ObstacleHandle obstacle, F f) {
    if (!alive(obstacle))
        throw Mistake(
            fmt::format("{} of obstacle {} at tick {}: it is gone", call, obstacle.slot, tick_));
    placed(call, f);
}

void World::remove_obstacle(ObstacleHandle obstacle) {
    change("remove_obstacle", obstacle, [&] { bodies_->remove_obstacle(obstacle); });
}

void World::clear_planes() { bodies_->clear_planes(); }

bool World::alive(ObstacleHandle obstacle) const { return bodies_->alive(obstacle); }

Obstacle World::obstacle(ObstacleHandle obstacle) const { return bodies_->obstacle(obstacle); }

Vec3 World::position(ObstacleHandle obstacle) const {
    return centre_of(bodies_->obstacle(obstacle).shape);
}

void World::set_obstacle_velocity(ObstacleHandle obstacle, const Vec3& velocity) {
    change("set_obstacle_velocity", obstacle,
           [&] { bodies_->set_obstacle_velocity(obstacle, velocity); });
}

void World::move_obstacle(ObstacleHandle obstacle, const Vec3& to,
                          const std::optional<Vec3>& velocity) {
    change("move_obstacle", obstacle, [&] { bodies_->move_obstacle(obstacle, to, velocity); });
}

void World::teleport_obstacle(ObstacleHandle obstacle, const Vec3& to) {
    change("teleport_obstacle", obstacle, [&] { bodies_->teleport_obstacle(obstacle, to); });
}

std::vector<Touch> World::touches(Entity entity) const {
    require_of(entity, has_body(entity), "touches", no_body);
    return bodies_->touches(rows_.place(entity.index));
}

std::optional<Touch> World::ground(Entity entity) const {
    require_of(entity, has_body(entity), "ground", no_body);
    return bodies_->ground(rows_.place(entity.index));
}

void World::drop_through(Entity entity) {
    change("drop_through", entity, [&](std::size_t row) { bodies_->drop_through(row); });
}

std::optional<Hit> World::raycast(const Vec3& from, const Vec3& to, const Contact& ball) const {
    return bodies_->raycast(from, to, ball);
}

std::vector<ObstacleHandle> World::overlaps(const Vec3& centre, const Contact& ball) const {
    return bodies_->overlaps(centre, ball);
}

void World::set_gravity(const Vec3& acceleration) {
    placed("set_gravity", [&] { bodies_->set_gravity(acceleration); });
}

void World::teleport(Entity entity, const Vec3& position) {
    change("teleport", entity, [&](std::size_t row) { bodies_->set_position(row, position); });
    if (!find<Jumps>(entity)) add(entity, Jumps{});
    ++get<Jumps>(entity).count;
}

std::uint32_t World::jumps(Entity entity) const {
    const Jumps* const jumps = find<Jumps>(entity);
    return jumps ? jumps->count : 0;
}

std::vector<Entity> World::within(const Vec3& point, double radius) const {
    const SearchBall ball(point, radius, bodies_->axes());
    std::vector<Entity> entities;
    for (std::size_t row = 0; row < bodies_->size(); ++row)
        if (rows_[row] != SlotSet::absent && ball.contains(bodies_->position(row)))
            entities.push_back(entity_of_row(row));
    return entities;
}

std::size_t World::body_count() const { return bodies_->size(); }
int World::axes() const { return bodies_->axes(); }
Energy World::energy() const { return bodies_->energy(); }

void World::step(std::int64_t count) {
    const Steps steps = next_steps(count);
    if (const auto at = try_step(count)) fail_at(*at, steps);
}

void World::fail_at(const Divergence& at, const Steps& steps) const {
    fail_diverged(*bodies_, at, *settings_.stepping.method, steps, name_of_row(),
                  start_bodies().get());
}

std::unique_ptr<const Bodies> World::start_bodies() const {
    return make_start_ ? std::move(make_start_(settings_).bodies_) : nullptr;
}

void World::require_finite(const Energy& energy) const {
    if (std::isfinite(energy.total())) return;
    oiler::require_finite(energy, *bodies_, *settings_.stepping.method, next_steps(1),
                          name_of_row(), start_bodies().get());
}

std::optional<Divergence> World::try_step(std::int64_t count) {
    require(count >= 0, "the number of steps is not negative");
    require(visits_ == 0, "a world is not stepped inside its own each");
    const auto divergence = bodies_->try_step(*settings_.stepping.method, next_steps(count));
    impacts_.clear();
    for (std::size_t i = 0; i < bodies_->impact_count(); ++i) {
        const BodyImpact one = bodies_->impact_at(i, settings_.stepping.rate);
        impacts_.push_back({one.kind, entity_of_row(one.row), one.obstacle, one.time, one.point,
                            one.normal, one.before, one.after});
    }
    const std::int64_t taken = divergence ? divergence->tick - 1 - tick_ : count;
    tick_ += taken;
    age_ += taken;
    return divergence;
}

void World::require_drawable() const {
    constexpr double most = std::numeric_limits<float>::max();
    for (std::size_t row = 0; row < body_count(); ++row)
        if (!(largest(position_of_row(row)) <= most))
            fail_at({tick_, row, 0, Divergence::Of::drawing}, next_steps(1));
}

void World::require_applicable() const {
    bodies_->require_applicable(*settings_.stepping.method, next_steps(1));
}

std::vector<Risk> World::risks(std::int64_t steps) const {
    return oiler::preflight(*bodies_, *settings_.stepping.method, next_steps(steps));
}

std::vector<std::string> World::describe(std::span<const Risk> risks, std::size_t most) const {
    std::vector<std::string> lines;
    for (const Risk& risk : risks.first(std::min(most, risks.size())))
        lines.push_back(
            oiler::describe(risk, *settings_.stepping.method, next_steps(1), name_of_row()));
    if (risks.size() > most) lines.push_back(fmt::format("and {} more", risks.size() - most));
    return lines;
}

std::vector<std::string> World::preflight(std::size_t most) const {
    std::vector<Risk> all = risks(1);
    add_distortions(*bodies_, *settings_.stepping.method, next_steps(1), all);
    return describe(all, most);
}

std::vector<std::string> World::instabilities(std::int64_t steps, std::size_t most) const {
    std::vector<Risk> unstable = risks(steps);
    std::erase_if(unstable, [](const Risk& risk) { return risk.of == Risk::Of::told; });
    return describe(unstable, most);
}

LinkHandle World::link(Entity a, Entity b, const Link& link) {
    LinkHandle handle;
    change("link", a, [&](std::size_t row_a) { handle = bodies_->link(row_a, row(b), link); });
    return handle;
}

LinkHandle World::link_to_point(Entity entity, const Vec3& point, const Link& link) {
    LinkHandle handle;
    change("link_to_point", entity,
           [&](std::size_t row) { handle = bodies_->link_to_point(row, point, link); });
    return handle;
}

bool World::alive(LinkHandle link) const { return bodies_->alive(link); }

Link World::link(LinkHandle link) const { return bodies_->link(link); }

void World::unlink(LinkHandle link) { bodies_->unlink(link); }

void World::move_point(LinkHandle link, const Vec3& point) {
    placed("move_point", [&] { bodies_->move_point(link, point); });
}

std::optional<std::int64_t> World::tick_at(const Rate& rate) const {
    // Ticks of the old and the new rate in the shortest time that has both.
    const Rate& now = settings_.stepping.rate;
    std::int64_t old_ticks = now.steps * rate.seconds;
    std::int64_t new_ticks = rate.steps * now.seconds;
    const std::int64_t common = std::gcd(old_ticks, new_ticks);
    old_ticks /= common;
    new_ticks /= common;
    if (tick_ % old_ticks != 0) return std::nullopt;
    return tick_ / old_ticks * new_ticks;
}

void World::set_threads(int threads) {
    placed("set_threads", [&] { bodies_->set_threads(threads); });
    settings_.threads = threads;
}

void World::set_stepping(const Stepping& stepping) {
    placed("set_stepping", [&] {
        const std::optional<std::int64_t> tick = tick_at(stepping.rate);
        if (!tick)
            fail(Exit::usage, "{:g} Hz has no tick at {} s; step to a time that both rates have",
                 1 / stepping.rate.dt(), time());
        if (stepping.precision != settings_.stepping.precision)
            fail(Exit::usage, "another precision needs a new world");
        bodies_->require_applicable(*stepping.method, {stepping.rate, *tick, 1, stepping.damping});
        settings_.stepping = stepping;
        tick_ = *tick;
    });
}

Steps World::next_steps(std::int64_t count) const {
    return {settings_.stepping.rate, tick_, count, settings_.stepping.damping};
}

NameOfRow World::name_of_row() const {
    return [this](std::size_t row) { return label_in(*this, entity_of_row(row)); };
}

double World::time_in(double seconds) const {
    if (!(seconds >= 0) || std::isinf(seconds))
        fail(std::isfinite(seconds) ? Exit::usage : Exit::diverged,
             "schedule of {} s at tick {}: give a finite time, 0 or more", seconds, tick_);
    return counted_from_.value_or(time()) + seconds;
}

std::uint64_t World::state_hash() const {
    require(visits_ == 0, "a world is not hashed inside its own each");
    StateHash hash;
    hash.add(static_cast<std::uint64_t>(tick_));
    bodies_->hash_into(hash);
    if (random_ != Random(settings_.seed)) hash.add(random_.state());
    for (const TaggedPool& entry : pools_)
        if (entry.pool->slots().size() > 0) entry.pool->hash_into(hash);
    for (const TaggedTimers& entry : timers_) entry.timers->hash_into(hash);
    return hash.value();
}

std::vector<std::string> World::unhashed() const {
    std::vector<std::string> types;
    StateHash unused;
    for (const TaggedPool& entry : pools_)
        if (!entry.pool->hash_into(unused)) types.emplace_back(entry.pool->type());
    for (const TaggedTimers& entry : timers_)
        if (!entry.timers->hash_into(unused)) types.emplace_back(entry.timers->type());
    return types;
}

Vec3 Moving::position() const { return world_.position(entity_); }
Vec3 Moving::velocity() const { return world_.velocity(entity_); }
double Moving::mass() const { return world_.mass(entity_); }
void Moving::set_position(const Vec3& position) const { world_.set_position(entity_, position); }
void Moving::set_velocity(const Vec3& velocity) const { world_.set_velocity(entity_, velocity); }
void Moving::apply_force(const Vec3& force) const { world_.apply_force(entity_, force); }
void Moving::apply_impulse(const Vec3& impulse) const { world_.apply_impulse(entity_, impulse); }

}  // namespace oiler
