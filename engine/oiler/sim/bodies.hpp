// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "oiler/core/copy_on_write.hpp"
#include "oiler/core/handle_slots.hpp"
#include "oiler/core/state_hash.hpp"
#include "oiler/physics/methods/methods.hpp"
#include "oiler/physics/stepping.hpp"
#include "oiler/physics/steps.hpp"
#include "oiler/sim/body.hpp"

namespace oiler {

class Team;
struct AnyColumns;

/// The storage of one quantity for all rows.
struct Stored {
    std::string_view of;         ///< "position", "velocity", "mass", "contact" or the force's name
    std::size_t index = 0;       ///< among several forces of one kind
    std::vector<bool> shared{};  ///< each number, in order: true if stored once for all rows
    std::size_t bytes = 0;       ///< per row, in columns
    std::size_t rows = 0;        ///< rows with any number other than 0
};

/// The largest difference between the positions of the same rows in two worlds, m.
struct Deviation {
    double distance = 0;
    Vec3 along{};  ///< along each axis
};

/// All moving bodies of a world and the forces on them, in columns. Precision and number of axes
/// are chosen at run time. It is a value: a copy is a snapshot.
class Bodies {
public:
    /// `axes` from 1 to 3.
    Bodies(int axes, Precision precision);
    Bodies(const Bodies&);
    Bodies(Bodies&&) noexcept;
    Bodies& operator=(const Bodies&);
    Bodies& operator=(Bodies&&) noexcept;
    ~Bodies();

    [[nodiscard]] int axes() const;
    [[nodiscard]] Precision precision() const;
    [[nodiscard]] std::size_t size() const;

    /// Adds a last row with at most one force of each kind and returns its index. Bodies with equal
    /// numbers of a force share them in memory if the force is given here. Throws Error{usage} for
    /// a mass that is not positive, for a number that is not finite in the columns' precision, and
    /// for a number on an axis that the world lacks; the bodies are then unchanged.
    template <BodyForce... Force>
    std::size_t add(const Body& body, const Force&... force) {
        return add(body, given(force...));
    }
    std::size_t add(const Body& body, const GivenForces& forces);
    /// Adds a force to row `row`, or replaces the numbers of the one that it has.
    template <BodyForce... Force>
    void attach(std::size_t row, const Force&... force) {
        attach_at(0, row, given(force...));
    }
    /// Adds or replaces the force of that index among several of one kind, counted from 0.
    template <BodyForce... Force>
    void attach_at(std::size_t index, std::size_t row, const Force&... force) {
        attach_at(index, row, given(force...));
    }
    void attach_at(std::size_t index, std::size_t row, const GivenForces& forces);
    /// Removes all forces of a kind from row `row`. A kind that no row has any more is not stored.
    template <BodyForce Force>
    void detach(std::size_t row) {
        detach_kind(row, kind_of<Force>);
    }
    void detach_kind(std::size_t row, std::size_t kind);
    /// Reserves memory for `rows` rows in total, so that adding them copies none.
    void reserve(std::size_t rows);
    /// Removes `row` and its links. The last row, with its links, moves to its place.
    void remove(std::size_t row);

    /// Adds a spring between two rows. Throws Error{usage} for a number that is not finite in the
    /// columns' precision.
    LinkHandle link(std::size_t a, std::size_t b, const Link& link);
    /// Adds a spring between a row and a fixed point. It costs other rows nothing, while a Spring
    /// or CoilSpring takes columns with a number per row. The row is then stepped as a linked one.
    LinkHandle link_to_point(std::size_t row, const Vec3& point, const Link& link);
    /// Moves the point of a link to a point, m. Dampers regard the point as at rest.
    void move_point(LinkHandle link, const Vec3& point);
    [[nodiscard]] bool alive(LinkHandle link) const;
    /// Removes the spring, which must be alive.
    void unlink(LinkHandle link);
    /// The numbers of a spring, which must be alive.
    [[nodiscard]] Link link(LinkHandle link) const;
    /// The number of links: first those between rows, then those to points.
    [[nodiscard]] std::size_t link_count() const;
    [[nodiscard]] Link link_at(std::size_t i) const;
    [[nodiscard]] LinkEnds link_ends(std::size_t i) const;
    /// Per row, whether it has a link.
    [[nodiscard]] std::vector<bool> linked_rows() const;
    /// The links in the order of their dampers in the first half of a step with damping in the
    /// drift; the second half has the reverse order.
    [[nodiscard]] std::vector<std::size_t> damping_order() const;

    /// Adds an obstacle that bodies with a contact meet. Throws Error{usage} for a normal of 0,
    /// sizes that are not positive, a restitution outside 0 to 1, a negative friction, numbers
    /// that are not finite, and for what needs more axes than the world has.
    ObstacleHandle add_obstacle(const Obstacle& obstacle);
    ObstacleHandle add_plane(const Plane& plane);
    /// Removes the obstacle, which must be alive.
    void remove_obstacle(ObstacleHandle handle);
    void clear_planes();
    [[nodiscard]] bool alive(ObstacleHandle handle) const;
    [[nodiscard]] bool has_obstacles() const;
    /// The obstacles, in the order of their slots.
    [[nodiscard]] std::vector<ObstacleHandle> obstacles() const;
    /// The obstacle where it is after the last step.
    [[nodiscard]] Obstacle obstacle(ObstacleHandle handle) const;
    /// Changes the velocity, m/s, from the next step on.
    void set_obstacle_velocity(ObstacleHandle handle, const Vec3& velocity);
    /// Lets the centre of the obstacle arrive at a place, m, at the end of the next step, where it
    /// stands if it is not moved again. On its way it pushes and carries bodies. It arrives with a
    /// velocity, m/s, or else goes straight. The last call before a step counts.
    void move_obstacle(ObstacleHandle handle, const Vec3& to,
                       const std::optional<Vec3>& velocity = {});
    /// Moves the centre of the obstacle to a place, m, at once. Bodies inside are lifted.
    void teleport_obstacle(ObstacleHandle handle, const Vec3& to);
    /// The obstacles that the body touches after the last step, with forces of now.
    [[nodiscard]] std::vector<Touch> touches(std::size_t row) const;
    /// Of those that bear the body, the one whose normal is most against the forces on it.
    [[nodiscard]] std::optional<Touch> ground(std::size_t row) const;
    /// Lets the body pass the one-way obstacles that it touches.
    void drop_through(std::size_t row);
    /// The first obstacle that a ball meets on a way, m; no area; one-way ones from their own side
    /// only. A ball of radius 0 meets segments, too. At equal distances the lower slot is first.
    [[nodiscard]] std::optional<Hit> raycast(const Vec3& from, const Vec3& to,
                                             const Contact& ball = {}) const;
    /// The obstacles and areas that a ball overlaps, in the order of their slots.
    [[nodiscard]] std::vector<ObstacleHandle> overlaps(const Vec3& centre,
                                                       const Contact& ball) const;
    /// The half-spaces among the obstacles of these layers, as they were added, without areas.
    [[nodiscard]] std::vector<Plane> planes(std::uint32_t layers = ~0U) const;
    /// Lets the body meet obstacles, or pass through them. Throws Error{usage} for a negative
    /// radius.
    void set_contact(std::size_t row, const std::optional<Contact>& contact);
    [[nodiscard]] std::optional<Contact> contact(std::size_t row) const;
    /// The meetings with obstacles in the last call of step, in the order of time, then row. Valid
    /// until bodies or obstacles change.
    [[nodiscard]] std::size_t impact_count() const;
    [[nodiscard]] BodyImpact impact_at(std::size_t i, const Rate& rate) const;

    /// Gravity of all bodies, m/s²; without this call no gravity is evaluated.
    void set_gravity(const Vec3& acceleration);

    [[nodiscard]] double mass(std::size_t row) const;
    [[nodiscard]] Vec3 position(std::size_t row) const;
    [[nodiscard]] Vec3 velocity(std::size_t row) const;
    /// The state in all digits of every precision; axes that the world lacks are 0.
    [[nodiscard]] State<long double, 3> state(std::size_t row) const;
    void set_state(std::size_t row, const State<long double, 3>& state);
    void set_position(std::size_t row, const Vec3& position);
    void set_velocity(std::size_t row, const Vec3& velocity);

    /// Applies a force, N, at every stage of the next step only, which is the first step of the
    /// next call. Throws Error{usage} if the acceleration is not finite.
    void apply_force(std::size_t row, const Vec3& force);
    /// Drops the forces that were applied since the last step.
    void forget_forces();
    /// Changes the velocity by impulse/mass, impulse in N·s. Throws Error{usage} if the velocity is
    /// then not finite.
    void apply_impulse(std::size_t row, const Vec3& impulse);

    /// The number of threads that step unlinked bodies if that is faster; the default is 1. Results
    /// do not depend on it. Copies share the threads.
    void set_threads(int threads);

    /// Takes the steps. Throws Error{usage} if the method cannot step these forces, see
    /// require_applicable. Throws Error{diverged} with step, row and field if a number is no longer
    /// finite; the bodies are then unusable. fail_diverged in stability adds the likely cause.
    void step(const Method& method, const Steps& steps);
    /// Like step, but returns the divergence, for callers that do not name bodies by rows.
    [[nodiscard]] std::optional<Divergence> try_step(const Method& method, const Steps& steps);

    /// Throws Error{usage} if the method cannot take these steps. The exact method steps neither
    /// forces that are not linear nor linked bodies. A negative drift runs damping backwards, which
    /// may overflow.
    void require_applicable(const Method& method, const Steps& steps) const;

    /// The number of evaluations of the forces on the first body so far.
    [[nodiscard]] std::int64_t evaluations() const;

    /// The forces with `index` of each kind on row `row`, per unit mass as in the step.
    [[nodiscard]] GivenForces forces_per_mass(std::size_t row, std::size_t index = 0) const;
    /// The largest number of forces of one kind on a body. Bodies with fewer store zeros.
    [[nodiscard]] std::size_t most_forces_of_a_kind() const;

    /// The storage of motion, mass, contact, then each force, without links and caches.
    [[nodiscard]] std::vector<Stored> stored() const;
    [[nodiscard]] std::size_t bytes_of_links() const;
    /// Compares with bodies of the same precision, axes and number; 0 only if all positions agree.
    [[nodiscard]] Deviation deviation_from(const Bodies& other) const;

    /// The energy, summed in double in eight fixed lanes: it does not depend on the machine.
    [[nodiscard]] Energy energy() const;

    /// Adds count, axes, bytes per number, then the columns: positions axis by axis, velocities
    /// axis by axis, rows in order. Forces that apply_force added for the next step come last.
    void hash_into(StateHash& hash) const;

private:
    [[nodiscard]] ObstacleHandle handle_of(std::size_t slot) const;
    [[nodiscard]] bool is_solid(ObstacleHandle handle) const;
    template <class F>
    void change_motion(ObstacleHandle handle, F f);
    void require_row(std::size_t row) const;
    void require_linkable(std::size_t row, const Link& link) const;
    void require_exact_flow(const Method& method) const;
    [[nodiscard]] double link_potential(std::size_t i) const;

    std::unique_ptr<AnyColumns> columns_;
    std::shared_ptr<Team> team_;
    HandleSlots link_slots_;
    CopyOnWrite<std::vector<std::optional<Obstacle>>> obstacles_;  ///< by slot, as they were added
    HandleSlots obstacle_slots_;
};

/// Calls f(force) for each force on the body in a row, per unit mass, also for those that are zero.
template <class F>
void for_each_force_on(const Bodies& bodies, std::size_t row, F f) {
    for (std::size_t index = 0; index < bodies.most_forces_of_a_kind(); ++index)
        for_each_given(bodies.forces_per_mass(row, index), f);
}

}  // namespace oiler
