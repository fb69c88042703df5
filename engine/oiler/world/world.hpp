// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "oiler/core/handle_slots.hpp"
#include "oiler/core/random.hpp"
#include "oiler/core/require.hpp"
#include "oiler/physics/stepping.hpp"
#include "oiler/physics/steps.hpp"
#include "oiler/sim/body.hpp"
#include "oiler/world/entity.hpp"
#include "oiler/world/pool.hpp"
#include "oiler/world/timers.hpp"

namespace oiler {

class Bodies;
class Error;
struct Risk;

/// The settings of a world.
struct Settings {
    Stepping stepping{};
    std::uint64_t seed = 0;  ///< seed of the game's random numbers
    int threads = 1;         ///< number of threads; results do not depend on it
};

/// Entities, their components and their moving bodies. It is a value: a copy is a snapshot, and the
/// copy and the original step to the same bits.
///
/// `alive` and `find` accept handles of destroyed entities. Any other use of such a handle throws
/// Mistake with call, entity and tick, and changes nothing. Handles belong to a value: after a
/// snapshot is taken back, those made since it may name other entities and links.
class World {
public:
    explicit World(int axes, const Settings& settings = {});
    World(int axes, const Stepping& stepping) : World(axes, Settings{.stepping = stepping}) {}
    World(const World& other);
    World& operator=(const World& other);
    World(World&&) noexcept;
    World& operator=(World&& other);
    ~World();

    [[nodiscard]] Entity create();
    /// Destroys the entity with its components and its body.
    void destroy(Entity entity);
    [[nodiscard]] bool alive(Entity entity) const;
    [[nodiscard]] std::size_t entity_count() const;

    /// Adds a component of a type that the entity does not have yet. The reference is valid until
    /// a component of this type is removed, outside `each`.
    template <class T>
    T& add(Entity entity, T component) {
        static_assert(std::movable<T>, "a component must be movable");
        require_of(entity, alive(entity), "add", gone);
        require_of(entity, !find<T>(entity), "add", "it has a component of this type already");
        return pool<T>().add(entity.index, std::move(component));
    }
    template <class T>
    void remove(Entity entity) {
        require_of(entity, find<T>(entity), "remove", no_component);
        erase(pool<T>(), entity.index);
    }
    /// Null if the entity has none, or is destroyed.
    template <class T>
    [[nodiscard]] T* find(Entity entity) {
        Pool<T>* const found = find_pool<T>();
        return found && alive(entity) ? found->find(entity.index) : nullptr;
    }
    template <class T>
    [[nodiscard]] const T* find(Entity entity) const {
        return const_cast<World*>(this)->find<T>(entity);
    }
    template <class T>
    [[nodiscard]] T& get(Entity entity) {
        T* const found = find<T>(entity);
        require_of(entity, found, "get", no_component);
        return *found;
    }
    template <class T>
    [[nodiscard]] const T& get(Entity entity) const {
        return const_cast<World*>(this)->get<T>(entity);
    }

    /// Calls f(entity, first, rest...) for each entity that has all of these components, in the
    /// order in which `First` was added, except that the last one moves to the place of a removed
    /// one. `f` may create and destroy any entities and components. Both take effect at once;
    /// neither new nor destroyed ones are visited. References stay valid until the outermost `each`
    /// ends. Until then, the world is neither stepped nor copied.
    template <class First, class... Rest, class F>
    void each(F&& f) {
        Pool<First>* const first = find_pool<First>();
        const std::tuple<Pool<Rest>*...> rest{find_pool<Rest>()...};
        if (!first || !(std::get<Pool<Rest>*>(rest) && ...)) return;
        const Visit visit(*this);
        const SlotSet& slots = first->slots();
        const std::size_t end = slots.size();
        constexpr std::size_t page = Pages<First>::page_size;
        for (std::size_t begin = 0; begin < end; begin += page) {
            First* const items = &(*first)[begin];
            const std::size_t count = std::min(page, end - begin);
            for (std::size_t i = 0; i < count; ++i) {
                const std::uint32_t slot = slots[begin + i];
                if (slot == SlotSet::absent) continue;
                const std::tuple<Rest*...> others{std::get<Pool<Rest>*>(rest)->find(slot)...};
                if ((std::get<Rest*>(others) && ...))
                    f(Entity{slot, slots_.generation(slot)}, items[i], *std::get<Rest*>(others)...);
            }
        }
    }
    template <class First, class... Rest, class F>
    void each(F&& f) const {
        const_cast<World*>(this)->each<First, Rest...>(
            [&](Entity entity, const First& first, const Rest&... rest) {
                f(entity, first, rest...);
            });
    }

    /// The number of entities that have all of these components.
    template <class First, class... Rest>
    [[nodiscard]] std::size_t count() const {
        std::size_t entities = 0;
        each<First, Rest...>([&](const Entity&, const auto&...) { ++entities; });
        return entities;
    }

    /// Calls f(entity, moving, component...) for each entity that has a body and these components:
    /// see `each`.
    template <class First, class... Rest, class F>
    void each_body(F&& f) {
        each<First, Rest...>([&](Entity entity, First& first, Rest&... rest) {
            if (has_body(entity)) f(entity, Moving(*this, entity), first, rest...);
        });
    }

    /// Gives the entity a moving body with at most one force of each kind.
    template <class... Force>
    void add_body(Entity entity, const Body& body, const Force&... force) {
        add_body(entity, body, given(force...));
    }
    void add_body(Entity entity, const Body& body, const GivenForces& forces);
    /// Creates an entity with a moving body. The line of an error names call and tick.
    template <class... Force>
    Entity spawn(const Body& body, const Force&... force) {
        return spawn(body, given(force...));
    }
    Entity spawn(const Body& body, const GivenForces& forces);
    /// Adds a force to the body, or replaces the numbers of the one that it has.
    template <class... Force>
    void attach(Entity entity, const Force&... force) {
        attach_given("attach", 0, entity, given(force...));
    }
    /// Adds or replaces the force of that index among several of one kind, counted from 0.
    template <class... Force>
    void attach_at(std::size_t index, Entity entity, const Force&... force) {
        attach_given("attach_at", index, entity, given(force...));
    }
    /// Removes all forces of a kind from the body.
    template <BodyForce Force>
    void detach(Entity entity) {
        detach_kind(entity, kind_of<Force>);
    }
    /// Reserves memory for `bodies` bodies in total, so that spawning them copies none.
    void reserve(std::size_t bodies);
    /// Adds a spring between the bodies of two entities; it is removed with either body.
    LinkHandle link(Entity a, Entity b, const Link& link);
    /// Adds a spring between the body of an entity and a fixed point, m, such as a pin of a net. It
    /// is removed with the body. See also Bodies::link_to_point.
    LinkHandle link_to_point(Entity entity, const Vec3& point, const Link& link);
    /// Moves the fixed point of such a spring at once, m, as when a hand drags a pin.
    void move_point(LinkHandle link, const Vec3& point);
    [[nodiscard]] bool alive(LinkHandle link) const;
    /// The numbers of a spring that is alive.
    [[nodiscard]] Link link(LinkHandle link) const;
    /// Removes a spring that is alive.
    void unlink(LinkHandle link);
    void remove_body(Entity entity);
    [[nodiscard]] bool has_body(Entity entity) const;
    /// The row of the entity's body. Rows are in the order of adding; the last row moves to the
    /// place of a removed one.
    [[nodiscard]] std::size_t row(Entity entity) const;
    [[nodiscard]] Entity entity_of_row(std::size_t row) const;

    [[nodiscard]] Vec3 position(Entity entity) const;
    [[nodiscard]] Vec3 velocity(Entity entity) const;
    [[nodiscard]] Vec3 position_of_row(std::size_t row) const;
    [[nodiscard]] double mass(Entity entity) const;  ///< kg

    // Each of these throws Error{diverged} for a number that is not finite in the world's
    // precision, and Error{usage} for other wrong numbers; the line names call, tick, entity and
    // value, and the body is unchanged.

    void set_velocity(Entity entity, const Vec3& velocity);
    /// Moves the body to a position, m; pictures show a motion. See also teleport.
    void set_position(Entity entity, const Vec3& position);
    /// Applies a force, N, over the whole next step only, which is the first step of the next call
    /// of `step`. Forces of several calls add up.
    void apply_force(Entity entity, const Vec3& force);
    /// Drops the forces that were applied since the last step.
    void forget_forces();
    /// Changes the velocity at once by impulse/mass, impulse in N·s.
    void apply_impulse(Entity entity, const Vec3& impulse);
    /// Lets the body meet obstacles, or pass through them.
    void set_contact(Entity entity, const std::optional<Contact>& contact);
    /// Moves the body to a position; pictures do not interpolate the jump.
    void teleport(Entity entity, const Vec3& position);
    /// The number of teleports of the body: the `jump` of a picture's element. 0 if the entity is
    /// gone.
    [[nodiscard]] std::uint32_t jumps(Entity entity) const;
    /// From now on, entities are numbered in the order in which they are created, which tells those
    /// of two runs that are the same: slots may be taken again in another order.
    void number_entities();
    /// The number of an entity, or Entity::id() if entities are not numbered.
    [[nodiscard]] std::uint64_t number(Entity entity) const;

    /// Adds an obstacle that bodies with a contact meet. See Bodies::add_obstacle.
    ObstacleHandle add_obstacle(const Obstacle& obstacle);
    /// Adds a half-space, such as a floor.
    ObstacleHandle add_plane(const Plane& plane);
    /// Adds a segment between each two neighbours of the points, and from the last to the first if
    /// `closed`. Bodies pass their joints smoothly. `like` has all but the shape.
    std::vector<ObstacleHandle> add_chain(std::span<const Vec3> points, bool closed,
                                          const Obstacle& like);
    void remove_obstacle(ObstacleHandle obstacle);
    void clear_planes();
    [[nodiscard]] bool alive(ObstacleHandle obstacle) const;
    /// The obstacle where it is after the last step.
    [[nodiscard]] Obstacle obstacle(ObstacleHandle obstacle) const;
    /// Its centre after the last step, m; see centre_of.
    [[nodiscard]] Vec3 position(ObstacleHandle obstacle) const;
    /// Changes its velocity, m/s, from the next step on.
    void set_obstacle_velocity(ObstacleHandle obstacle, const Vec3& velocity);
    /// Lets it arrive at a place, m, at the end of the next step. See Bodies::move_obstacle.
    void move_obstacle(ObstacleHandle obstacle, const Vec3& to,
                       const std::optional<Vec3>& velocity = {});
    void teleport_obstacle(ObstacleHandle obstacle, const Vec3& to);
    /// The obstacles that the body touches after the last step.
    [[nodiscard]] std::vector<Touch> touches(Entity entity) const;
    /// The obstacle on which the body stands or slides, if any.
    [[nodiscard]] std::optional<Touch> ground(Entity entity) const;
    /// Lets the body pass the one-way obstacles that it touches.
    void drop_through(Entity entity);
    /// The first obstacle that a ball meets on a straight way, no area; one-way obstacles from
    /// their own side only. See Bodies::raycast.
    [[nodiscard]] std::optional<Hit> raycast(const Vec3& from, const Vec3& to,
                                             const Contact& ball = {}) const;
    /// The obstacles and areas that a ball overlaps.
    [[nodiscard]] std::vector<ObstacleHandle> overlaps(const Vec3& centre,
                                                       const Contact& ball) const;
    /// The meetings of bodies with obstacles in the last call of step, in the order of time.
    [[nodiscard]] const std::vector<Impact>& impacts() const { return impacts_; }

    /// The entities whose bodies have their centres at most `radius` m from `point`, in the order
    /// of the rows. Coordinates of `point` on axes that the world lacks are ignored. Throws
    /// Error{usage} for a radius that is negative, and for numbers that are not finite. It tests
    /// all bodies; see Neighbours for many queries.
    [[nodiscard]] std::vector<Entity> within(const Vec3& point, double radius) const;

    /// The columns of all bodies; oiler/sim/bodies.hpp has their functions.
    [[nodiscard]] const Bodies& bodies() const { return *bodies_; }
    [[nodiscard]] std::size_t body_count() const;
    [[nodiscard]] int axes() const;
    /// See Bodies::energy.
    [[nodiscard]] Energy energy() const;
    void set_gravity(const Vec3& acceleration);

    /// Hands a message to `due` of its type, `seconds` from now, rounded up to a tick. Inside `due`
    /// they count from the time of the message that is due, not from the tick that noticed it: what
    /// repeats comes as often at any rate.
    template <std::copyable T>
    void schedule(double seconds, T message) {
        const double time = time_in(seconds);
        timers<T>().add(time, std::move(message), time == counted_from_);
    }
    /// Calls f(message) for the messages of this type that are due, the earliest first, also for
    /// later ones that f schedules and that are due by now. Like `each`, it is a visit. If f
    /// throws, the others stay.
    template <class T, class F>
    void due(F&& f) {
        const Visit visit(*this);
        const double until = time() + round_off_in_steps * settings_.stepping.rate.dt();
        timers<T>().begin();
        while (auto due = timers<T>().take(until)) {
            counted_from_ = due->time;
            f(due->message);
        }
    }
    /// The random numbers of the world, from the seed of its settings.
    [[nodiscard]] Random& random() { return random_; }

    /// Throws Error{usage} if the method cannot step these bodies; it steps nothing.
    void require_applicable() const;
    /// Throws Error{diverged}, with the likely cause, if a body is farther away than the float
    /// numbers of a picture reach.
    void require_drawable() const;
    /// Describes what goes wrong with the method at the rate, with a remedy, one per line and the
    /// worst first: springs, drag, orbits, drives and bounces that it does not follow, and places
    /// where a force or a plane has no effect. After `most` lines, the last one counts the others.
    [[nodiscard]] std::vector<std::string> preflight(std::size_t most = 5) const;
    /// The lines of preflight() that tell of runs that diverge or drift away, within so many steps
    /// if they are more than one.
    [[nodiscard]] std::vector<std::string> instabilities(std::int64_t steps,
                                                         std::size_t most = 5) const;

    /// The tick of `rate` at the present time; empty if that rate has none then.
    [[nodiscard]] std::optional<std::int64_t> tick_at(const Rate& rate) const;
    /// Continues with another method, rate or damping. Scheduled messages keep their times, rounded
    /// up to a tick. Throws Error{usage}, and changes nothing, if the new rate has no tick now, for
    /// another precision, and if the method cannot step these bodies.
    void set_stepping(const Stepping& stepping);
    /// Steps with another number of threads from here on. Throws Error{usage} if the machine gives
    /// fewer.
    void set_threads(int threads);

    /// Makes this world as it was at its start, with other settings.
    using MakeStart = std::function<World(const Settings&)>;
    /// From here on, the start names the cause of a divergence, if it has one: positions and speeds
    /// of a run that has diverged are no longer those of the scene.
    void set_start(MakeStart start) { make_start_ = std::move(start); }
    /// Steps all bodies `count` times. Results do not depend on the number of steps per call.
    /// Throws Error{diverged}.
    void step(std::int64_t count = 1);
    /// Throws Error{diverged} with the likely cause if `energy`, that of this world, is not finite.
    void require_finite(const Energy& energy) const;
    /// Like step, but returns the first divergence without searching for its cause. The world is
    /// unusable after a divergence, but for its tick: that of the last step before it.
    [[nodiscard]] std::optional<Divergence> try_step(std::int64_t count = 1);
    [[nodiscard]] std::int64_t tick() const { return tick_; }
    /// The time in s, computed from the tick.
    [[nodiscard]] double time() const { return settings_.stepping.rate.time(tick_); }
    /// The timestep, s.
    [[nodiscard]] double dt() const { return settings_.stepping.rate.dt(); }
    [[nodiscard]] const Settings& settings() const { return settings_; }

    /// The number of steps since this value was made, or another one was assigned to it.
    [[nodiscard]] std::int64_t age() const { return age_; }

    /// The hash of the tick, of all bodies (see Bodies::hash_into), of the random numbers once one
    /// was drawn, and of the components and scheduled messages that are Hashed.
    [[nodiscard]] std::uint64_t state_hash() const;
    /// The types of components and messages that the hash leaves out.
    [[nodiscard]] std::vector<std::string> unhashed() const;

private:
    static constexpr const char* gone = "it is gone";
    static constexpr const char* no_body = "it has no body, or is gone";
    static constexpr const char* no_component = "it has no component of this type, or is gone";

    void require_of(Entity entity, bool holds, const char* call, const char* what) const {
        if (!holds) [[unlikely]]
            throw_mistake(call, entity, what);
    }
    [[noreturn]] void throw_mistake(const char* call, Entity entity, const char* what) const;

    /// The address identifies the type.
    template <class T>
    static constexpr char tag = 0;
    struct TaggedPool {
        const char* tag;
        std::unique_ptr<AnyPool> pool;
    };

    template <class T>
    [[nodiscard]] Pool<T>* find_pool() {
        for (const TaggedPool& entry : pools_)
            if (entry.tag == &tag<T>) return static_cast<Pool<T>*>(entry.pool.get());
        return nullptr;
    }
    struct TaggedTimers {
        const char* tag;
        std::unique_ptr<AnyTimers> timers;
    };
    template <class T>
    Timers<T>& timers() {
        for (const TaggedTimers& entry : timers_)
            if (entry.tag == &tag<T>) return static_cast<Timers<T>&>(*entry.timers);
        timers_.push_back({&tag<T>, std::make_unique<Timers<T>>()});
        return static_cast<Timers<T>&>(*timers_.back().timers);
    }
    /// Sums of times differ from ticks by round-off.
    static constexpr double round_off_in_steps = 1e-6;
    [[nodiscard]] double time_in(double seconds) const;

    /// While a Visit lives, erasing leaves holes. The last Visit fills them.
    class Visit {
    public:
        explicit Visit(World& world) : world_(world), counted_from_(world.counted_from_) {
            ++world_.visits_;
        }
        ~Visit() {
            world_.counted_from_ = counted_from_;
            if (--world_.visits_ == 0) world_.fill_holes();
        }
        Visit(const Visit&) = delete;
        Visit& operator=(const Visit&) = delete;

    private:
        World& world_;
        std::optional<double> counted_from_;
    };
    void erase(AnyPool& pool, std::uint32_t slot) {
        visits_ > 0 ? pool.hide(slot) : pool.erase(slot);
    }
    void fill_holes();

    template <class T>
    Pool<T>& pool() {
        if (Pool<T>* const found = find_pool<T>()) return *found;
        pools_.push_back({&tag<T>, std::make_unique<Pool<T>>()});
        return *find_pool<T>();
    }

    /// Calls f() and adds call and tick to its errors.
    template <class F>
    void placed(const char* call, F f);
    [[noreturn]] void refuse(const char* call, const Error& error) const;
    /// Calls f(row) and adds call, tick and entity to its errors.
    template <class F>
    void change(const char* call, Entity entity, F f);
    template <class F>
    void change(const char* call, ObstacleHandle obstacle, F f);
    [[noreturn]] void refuse(const char* call, Entity entity, const Error& error) const;

    void attach_given(const char* call, std::size_t index, Entity entity,
                      const GivenForces& forces);
    void detach_kind(Entity entity, std::size_t kind);
    /// Removes the body of the entity in a slot.
    void remove_row(std::uint32_t slot);
    [[nodiscard]] Steps next_steps(std::int64_t count) const;
    [[nodiscard]] NameOfRow name_of_row() const;
    /// Throws Error{diverged}.
    [[noreturn]] void fail_at(const Divergence& at, const Steps& steps) const;
    /// The bodies at the start of the run; null if nothing makes them.
    [[nodiscard]] std::unique_ptr<const Bodies> start_bodies() const;
    [[nodiscard]] std::vector<Risk> risks(std::int64_t steps) const;
    [[nodiscard]] std::vector<std::string> describe(std::span<const Risk> risks,
                                                    std::size_t most) const;

    Settings settings_;
    std::int64_t tick_ = 0;
    std::int64_t age_ = 0;
    HandleSlots slots_;
    std::vector<std::uint64_t> numbers_{};        ///< by slot; empty: entities are not numbered
    std::optional<std::uint64_t> next_number_{};  ///< likewise
    std::vector<TaggedPool> pools_;
    std::unique_ptr<Bodies> bodies_;
    SlotSet rows_;
    std::vector<std::uint32_t> removed_rows_;  ///< rows of bodies that were removed in a visit
    std::vector<Impact> impacts_;
    std::vector<TaggedTimers> timers_;
    Random random_;
    MakeStart make_start_{};
    int visits_ = 0;
    std::optional<double> counted_from_;  ///< by `schedule` inside `due`, s
};

}  // namespace oiler
