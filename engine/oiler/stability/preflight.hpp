// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "oiler/physics/steps.hpp"
#include "oiler/sim/body.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler {

class Bodies;
struct Component;

/// A body and an attractor that nothing else disturbs.
struct Orbit {
    Vec3 centre;  ///< m
    Vec3 r;       ///< m, from the attractor
    Vec3 v;       ///< m/s
    double gm;    ///< m³/s²

    /// Per unit mass, J/kg; negative if the body returns.
    [[nodiscard]] double energy() const;
    /// The least distance from now on: the periapsis h²/(gm·(1 + e)), unless the body leaves for
    /// ever, m.
    [[nodiscard]] double closest() const;
    [[nodiscard]] double farthest() const;  ///< m, of an orbit that returns
    [[nodiscard]] double period() const;    ///< s, of an orbit that returns
};

/// A reason why a run with a method at a rate may not be usable.
struct Risk {
    enum class Of {
        springs,           ///< springs, dampers and linear drag
        linear_drag,       ///< linear drag that throws a body back
        overdamped,        ///< an overdamped motion that steps turn back; no run diverges by it
        quadratic_drag,    ///< drag at the present speed
        terminal_speed,    ///< drag at the speed at which it balances gravity
        attractor,         ///< attraction at the start
        periapsis,         ///< attraction at the closest point of the orbit
        on_attractor,      ///< the attraction has no direction
        rounded_position,  ///< positions are too coarse for the motion of a step
        rounded_velocity,  ///< velocities are too coarse for the forces of a step
        explosion,         ///< a trial of the scene gains energy or diverges
        told               ///< `message` says it all; it makes no run diverge
    };

    std::size_t row;
    std::optional<std::size_t> linked{};  ///< the other row of a link
    bool is_rope = false;                 ///< which is assumed to be taut
    double omega_dt = 0;    ///< ω·dt; for linked bodies an upper bound, by at most 1 %
    double damping_dt = 0;  ///< c·dt, c = 2ζω
    Of of = Of::springs;
    double at = 0;      ///< speed, m/s; distance from an attractor, m; unit of the last place, m
    int axis = 0;       ///< of a rounded number
    double effect = 0;  ///< relative error of a change that is rounded, −1 if nothing is left of it
    std::int64_t tick = 0;  ///< of an explosion, since the start of the trial
    /// All fast or weakly damped oscillations of linked bodies.
    std::vector<ScaledOscillation> oscillations{};
    /// Few bodies with uneven damping: their step matrix decides.
    std::shared_ptr<const Component> component{};
    std::shared_ptr<const Bodies> tried{};  ///< a body without its links, or all bodies
    std::shared_ptr<const Bodies> scene{};  ///< all bodies, on which a rate is tried
    std::optional<Orbit> orbit{};           ///< an orbit that was tried
    double revolution = 0;                  ///< of the orbit, in which it is lost
    /// The line of the risk, with {} in place of the body's name and of the linked body's.
    std::string message{};
    /// The implicit method that steps the scene without a risk; null if neither does.
    const Method* remedy = nullptr;
};

/// Finds the risks of the method at the rate, the worst first: springs, dampers and drag outside
/// its region of stability, at the step or at one of four shorter steps; orbits, drives and bounces
/// that it does not follow; planes and springs that leave a body no place or no force; and bodies
/// in float whose changes in a step are so small that rounding adds up. It linearises at the
/// present positions, see Component, and tries scenes that are not linear, no longer than
/// `steps` if they are more than one. It changes no state.
[[nodiscard]] std::vector<Risk> preflight(const Bodies& bodies, const Method& method,
                                          const Steps& steps);

/// Adds what a run without other risks than told ones shows otherwise than the true motion, of five
/// bodies at most: oscillations whose energy the method halves within 20 s, and by more than
/// damping takes; orbits whose farthest point is wrong by a fifth; and motions in float that depart
/// by a tenth from those in double. Worlds of more than 2000 bodies are left out.
void add_distortions(const Bodies& bodies, const Method& method, const Steps& steps,
                     std::vector<Risk>& risks);

/// Describes a risk: "spring of body 3: ω·dt = 2.4, semi_implicit_euler needs < 2: rate ≥ 74 Hz, or
/// implicit_euler". Finding the limit takes some tens of milliseconds, a rate of a net up to 2 s.
[[nodiscard]] std::string describe(const Risk& risk, const Method& method, const Steps& steps,
                                   const NameOfRow& name);

/// Throws Error{diverged} with step, body, field and the likely cause: a risk of the bodies at the
/// `start` of the run, which may be null, else one of the bodies that have diverged.
[[noreturn]] void fail_diverged(const Bodies& bodies, const Divergence& at, const Method& method,
                                const Steps& steps, const NameOfRow& name,
                                const Bodies* start = nullptr);

/// Throws Error{diverged} if the energy of the bodies before the steps is not finite, with the
/// tick, the body and the likely cause. Squares overflow before the state does.
void require_finite(const Energy& energy, const Bodies& bodies, const Method& method,
                    const Steps& steps, const NameOfRow& name, const Bodies* start = nullptr);

}  // namespace oiler
