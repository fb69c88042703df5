// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "oiler/core/require.hpp"
#include "oiler/physics/stepping.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/preflight.hpp"
#include "oiler/world/entity.hpp"
#include "oiler/world/pool.hpp"

namespace oiler {

/// What a world is made with.
struct Settings {
    Stepping stepping{};
    std::uint64_t seed = 0;  ///< of the game's own random numbers
    int threads = 1;         ///< number of threads that step; no bit depends on it
};

/// Entities, their components and the moving bodies among them. A value: a copy is a snapshot, and
/// stepping the copy gives what stepping the original gives.
///
/// A handle whose entity is gone is known to be: `alive` and `find` say so, and everything else
/// ends the program with a line that says what it did.
class World {
public:
    explicit World(int axes, const Settings& settings = {});
    World(int axes, const Stepping& stepping) : World(axes, Settings{.stepping = stepping}) {}
    World(const World& other);
    World& operator=(const World& other);
    World(World&&) noexcept = default;
    World& operator=(World&&) noexcept = default;
    ~World() = default;

    [[nodiscard]] Entity create();
    /// With all its components and its body.
    void destroy(Entity entity);
    [[nodiscard]] bool alive(Entity entity) const;
    [[nodiscard]] std::size_t entity_count() const;

    /// Gives the entity a component of a type that it does not have yet. The reference holds until
    /// the next add or remove of this type.
    template <class T>
    T& add(Entity entity, T component) {
        static_assert(std::movable<T>, "a component can be moved");
        require(alive(entity), gone);
        require(!find<T>(entity), "the entity has a component of this type already");
        return pool<T>().add(entity.index, std::move(component));
    }
    template <class T>
    void remove(Entity entity) {
        require(find<T>(entity), "the entity has no component of this type");
        pool<T>().erase(entity.index);
    }
    /// Null where the entity has none, or is no more.
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
        require(found, "the entity has no component of this type, or is gone");
        return *found;
    }
    template <class T>
    [[nodiscard]] const T& get(Entity entity) const {
        return const_cast<World*>(this)->get<T>(entity);
    }

    /// Calls f(entity, first, rest...) for each entity that has all of these components, backwards
    /// in the order of `First`: that of adding, where the last takes the place of one that is
    /// removed. Backwards, so that `f` may destroy the entity that it is given and create others,
    /// which are not visited; it must not destroy others or use its references after adding.
    template <class First, class... Rest, class F>
    void each(F&& f) {
        Pool<First>* const first = find_pool<First>();
        const std::tuple<Pool<Rest>*...> rest{find_pool<Rest>()...};
        if (!first || !(std::get<Pool<Rest>*>(rest) && ...)) return;
        const SlotSet& slots = first->slots();
        for (std::size_t place = slots.size(); place-- > 0;) {
            const std::uint32_t slot = slots[place];
            const std::tuple<Rest*...> others{std::get<Pool<Rest>*>(rest)->find(slot)...};
            if ((std::get<Rest*>(others) && ...))
                f(Entity{slot, generations_[slot]}, (*first)[place], *std::get<Rest*>(others)...);
        }
    }
    template <class First, class... Rest, class F>
    void each(F&& f) const {
        const_cast<World*>(this)->each<First, Rest...>(
            [&](Entity entity, const First& first, const Rest&... rest) {
                f(entity, first, rest...);
            });
    }

    /// Makes the entity a moving body, with at most one force of each kind.
    template <BodyForce... Force>
    void add_body(Entity entity, const Body& body, const Force&... force) {
        require(alive(entity), gone);
        require(!has_body(entity), "the entity has a body already");
        bodies_.add(body, force...);
        rows_.add(entity.index);
    }
    /// A new entity that is a moving body.
    template <BodyForce... Force>
    Entity spawn(const Body& body, const Force&... force) {
        bodies_.add(body, force...);
        const Entity entity = create();
        rows_.add(entity.index);
        return entity;
    }
    Entity spawn(const Body& body, const GivenForces& forces);
    /// Gives the body a force, or other numbers for the one that it has.
    template <BodyForce... Force>
    void attach(Entity entity, const Force&... force) {
        bodies_.attach(row(entity), force...);
    }
    /// The same for the nth of several forces of a kind, counted from 0.
    template <BodyForce... Force>
    void attach_nth(std::size_t nth, Entity entity, const Force&... force) {
        bodies_.attach_nth(nth, row(entity), force...);
    }
    /// Room for that many bodies in all, so that spawning them copies none.
    void reserve(std::size_t bodies);
    /// A spring between the bodies of two entities; it goes with either body.
    void link(Entity a, Entity b, const Link& link);
    void remove_body(Entity entity);
    [[nodiscard]] bool has_body(Entity entity) const;
    /// The row of the entity's body; rows are in the order of adding, where the last
    /// takes the place of one that is removed.
    [[nodiscard]] std::size_t row(Entity entity) const;
    [[nodiscard]] Entity entity_of_row(std::size_t row) const;

    [[nodiscard]] Vec3 position(Entity entity) const { return bodies_.position(row(entity)); }
    [[nodiscard]] Vec3 velocity(Entity entity) const { return bodies_.velocity(row(entity)); }
    void set_velocity(Entity entity, const Vec3& velocity) {
        bodies_.set_velocity(row(entity), velocity);
    }
    /// Puts the body elsewhere, and tells pictures not to draw it in between.
    void teleport(Entity entity, const Vec3& position);
    /// How often the body was teleported: the `jump` of a picture's element.
    [[nodiscard]] std::uint32_t jumps(Entity entity) const;

    [[nodiscard]] const Bodies& bodies() const { return bodies_; }
    void set_gravity(const Vec3& acceleration) { bodies_.set_gravity(acceleration); }

    /// Throws Error{usage} where the method cannot step these bodies, before anything is stepped.
    void require_applicable() const;
    /// A line for each spring and damper that the method cannot follow at the rate, with what would
    /// cure it; the worst first, and after `most` only how many more.
    [[nodiscard]] std::vector<std::string> preflight(std::size_t most = 5) const;

    /// Steps all bodies `count` times. One call with `count` and as many calls with 1 give the same
    /// bits. Throws Error{diverged}.
    void step(std::int64_t count = 1);
    /// The same, which tells where the first body diverges instead of looking for the cause; of no
    /// use after that.
    [[nodiscard]] std::optional<Divergence> try_step(std::int64_t count = 1);
    [[nodiscard]] std::int64_t tick() const { return tick_; }
    /// In s, from the tick.
    [[nodiscard]] double time() const { return settings_.stepping.rate.time(tick_); }
    [[nodiscard]] const Settings& settings() const { return settings_; }

    /// Of the tick and of all bodies, see Bodies::hash_into.
    [[nodiscard]] std::uint64_t state_hash() const;

private:
    static constexpr const char* gone = "the entity is gone";

    /// Its address is a type's identity.
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
    template <class T>
    Pool<T>& pool() {
        if (Pool<T>* const found = find_pool<T>()) return *found;
        pools_.push_back({&tag<T>, std::make_unique<Pool<T>>()});
        return *find_pool<T>();
    }

    [[nodiscard]] Steps next_steps(std::int64_t count) const;
    [[nodiscard]] NameOfRow name_of_row() const;

    Settings settings_;
    std::int64_t tick_ = 0;
    /// Odd while an entity lives in the slot, even while it is free: no handle, not even one from
    /// another copy of the world, fits a free slot.
    std::vector<std::uint32_t> generations_;
    std::vector<std::uint32_t> free_;
    std::vector<TaggedPool> pools_;
    Bodies bodies_;
    SlotSet rows_;
};

}  // namespace oiler
