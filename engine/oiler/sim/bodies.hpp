// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "oiler/core/state_hash.hpp"
#include "oiler/sim/body.hpp"
#include "oiler/physics/methods/methods.hpp"
#include "oiler/sim/steps.hpp"

namespace oiler {

class Team;
struct AnyColumns;

struct Energy {
    double kinetic = 0;    ///< J
    double potential = 0;  ///< J
    [[nodiscard]] double total() const { return kinetic + potential; }
};

/// How the numbers of one thing are stored for all rows.
struct Stored {
    std::string_view of;         ///< "position", "velocity", "mass" or the force's name
    std::size_t nth = 0;         ///< of several forces of a kind
    std::vector<bool> shared{};  ///< each number, in order: stored once, or in a column of its own
    std::size_t bytes = 0;       ///< of a row, in the columns of its own
    std::size_t rows = 0;        ///< that have any number other than 0
};

/// How far the same rows are from each other in two worlds, m, at most.
struct Apart {
    double distance = 0;
    Vec3 along{};  ///< each axis
};

/// All moving bodies of a world and the forces on them, in columns of the precision and the number
/// of axes chosen at run time. A value: a copy is a snapshot.
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

    /// A new last row, with at most one force of each kind. Bodies that agree on a force's numbers
    /// share them in memory when the force is given here. Throws Error{usage} for a mass that is
    /// not positive, a number that is not finite in the columns' precision, or one for an axis that
    /// the world lacks; then nothing has changed.
    template <BodyForce... Force>
    std::size_t add(const Body& body, const Force&... force) {
        return add(body, given(force...));
    }
    std::size_t add(const Body& body, const GivenForces& forces);
    /// Gives row `row` a force, or other numbers for the one that it has.
    template <BodyForce... Force>
    void attach(std::size_t row, const Force&... force) {
        attach_given(row, 0, given(force...));
    }
    /// The same for the nth of several forces of a kind, counted from 0.
    template <BodyForce... Force>
    void attach_nth(std::size_t nth, std::size_t row, const Force&... force) {
        attach_given(row, nth, given(force...));
    }
    /// Room for that many rows in all, so that adding them copies none.
    void reserve(std::size_t rows);
    /// The last row takes the place of `row`, in its links too; those of `row` go with it.
    void remove(std::size_t row);

    /// A spring between two rows. Throws Error{usage} for a number that is not finite in the
    /// columns' precision.
    void link(std::size_t a, std::size_t b, const Link& link);
    [[nodiscard]] std::size_t link_count() const;
    [[nodiscard]] Link link_at(std::size_t i) const;
    [[nodiscard]] std::array<std::size_t, 2> linked_rows(std::size_t i) const;

    /// For all bodies, m/s²; without this call no gravity is evaluated.
    void set_gravity(const Vec3& acceleration);

    [[nodiscard]] double mass(std::size_t row) const;
    [[nodiscard]] Vec3 position(std::size_t row) const;
    [[nodiscard]] Vec3 velocity(std::size_t row) const;
    /// With all digits of every precision; axes that the world does not have are 0.
    [[nodiscard]] State<long double, 3> state(std::size_t row) const;
    void set_state(std::size_t row, const State<long double, 3>& state);
    void set_position(std::size_t row, const Vec3& position);
    void set_velocity(std::size_t row, const Vec3& velocity);

    /// How many threads step unlinked bodies where that pays, 1 if not called. The bits are the
    /// same with any number; copies share the threads.
    void set_threads(int threads);

    /// Throws Error{usage} where the method cannot step these forces: see require_applicable; and
    /// Error{diverged} naming step, row and field when a number stops being finite (fail_diverged
    /// in stability adds the likely cause); the bodies are then of no further use.
    void step(const Method& method, const Steps& steps);
    /// The same for who names bodies in another way: returns where instead.
    [[nodiscard]] std::optional<Divergence> try_step(const Method& method, const Steps& steps);

    /// Throws Error{usage} where no such step can be taken: the exact method of forces that are not
    /// linear or of linked bodies, and damping that a negative drift runs backwards until it
    /// overflows.
    void require_applicable(const Method& method, const Steps& steps) const;

    /// How often the forces on the first body were evaluated so far.
    [[nodiscard]] std::int64_t evaluations() const;

    /// The forces on row `row` per unit mass, as the step evaluates them: the nth of each kind.
    [[nodiscard]] GivenForces forces_per_mass(std::size_t row, std::size_t nth = 0) const;
    /// How many forces of one kind there are at most; a body that has fewer has zeros.
    [[nodiscard]] std::size_t most_of_a_kind() const;

    /// What there is a column for, or a number that all rows share: motion, mass, then each force.
    /// Without the links, and without what steps keep for themselves.
    [[nodiscard]] std::vector<Stored> stored() const;
    [[nodiscard]] std::size_t bytes_per_link() const;
    /// From bodies that were made like these; exactly 0 only where all positions agree.
    [[nodiscard]] Apart apart_from(const Bodies& other) const;

    /// Summed in double in eight fixed lanes, so that it does not depend on the machine.
    [[nodiscard]] Energy energy() const;

    /// Appends count, axes, bytes per number, then the columns: positions axis by axis, velocities
    /// axis by axis, rows in order.
    void hash_into(StateHash& hash) const;

private:
    /// How many of `All` are a `Force`.
    template <class Force, class... All>
    static constexpr int count = (int{std::same_as<Force, All>} + ... + 0);

    template <class... Force>
    static GivenForces given(const Force&... force) {
        static_assert(((count<Force, Force...> == 1) && ...),
                      "a body has at most one force of each kind");
        GivenForces all;
        ((std::get<std::optional<Force>>(all) = force), ...);
        return all;
    }
    void require_row(std::size_t row) const;
    void require_forces_for(const Method& method) const;
    [[nodiscard]] double link_potential(std::size_t i) const;
    void attach_given(std::size_t row, std::size_t nth, const GivenForces& forces);

    std::unique_ptr<AnyColumns> columns_;
    std::shared_ptr<Team> team_;
};

}  // namespace oiler
