// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include "oiler/physics/advance.hpp"
#include "oiler/physics/response.hpp"
#include "oiler/sim/kernels/kernels.hpp"
#include "oiler/sim/links/held_dampers.hpp"
#include "oiler/sim/links/link_rows.hpp"
#include "oiler/sim/links/link_solver.hpp"
#include "oiler/sim/links/point_links.hpp"
#include "oiler/sim/steps/land_linked_rows.hpp"
#include "oiler/sim/steps/step_rows.hpp"
#include "oiler/sim/store/columns.hpp"
#include "oiler/sim/store/links.hpp"

namespace oiler {
namespace {

/// The physics that a method steps: all rows and the links between them.
template <std::floating_point T, int Axes>
class LinkedRows {
public:
    using Vectors = VecColumns<T, Axes>;

    explicit LinkedRows(const StepCall<T, Axes>& call)
        : kernels_(kernels<T, Axes>() ? kernels<T, Axes>()->linked : one_by_one),
          columns_(call.columns),
          views_(columns_.views),
          cache_(columns_.link_cache),
          team_(call.team),
          damping_(damping_of(call.plan())) {
        const auto* const splitting = std::get_if<SplittingPlan<T>>(&call.plan());
        if (damping_ == Damping::in_kick) cache_.field_valid = false;
        prepare(splitting ? splitting->half_step : T(0),
                std::holds_alternative<ImplicitPlan<T>>(call.plan()) && has_ropes());
        // Dampers are stepped one after the other, and threads that read each other's rows are
        // slower than one.
        if ((damping_ == Damping::in_drift && cache_.links.any_damped) ||
            4 * cache_.links.scattered.a.size() > columns_.links.size())
            team_ = nullptr;
    }

    const Vectors& accelerate(const MotionColumns<T, Axes>& motion, double t) {
        ++columns_.evaluations;
        evaluate(motion, Evaluate::all, t, cache_.acceleration);
        return cache_.acceleration;
    }

    /// The acceleration of a kick. If it depends on position alone, it is valid until the next
    /// drift, also in a later step.
    const Vectors& kick(const MotionColumns<T, Axes>& motion, double t) {
        if (damping_ == Damping::in_kick) return accelerate(motion, t);
        if (!cache_.field_valid) evaluate_field(motion, t);
        return cache_.field;
    }

    void drift(MotionColumns<T, Axes>& motion, std::size_t flow, T tau) {
        cache_.field_valid = false;
        if (damping_ == Damping::in_kick || columns_.flows.of.empty())
            add_scaled(motion.x, motion.v, tau);
        else
            in_ranges([&](const RowRange& rows) { kernels_.drift(views_, flow, rows, motion); });
    }
    void add_scaled(Vectors& to, const Vectors& what, T s) {
        in_ranges([&](const RowRange& rows) { kernels_.add_scaled(to, what, s, rows); });
    }
    Stages<MotionColumns<T, Axes>>& stages() { return cache_.stages; }

    /// To be called before an implicit step.
    void hold_ropes() {
        if (cache_.holds_ropes) cache_.held = held_dampers(columns_);
    }

    void damp_before(MotionColumns<T, Axes>& motion) {
        if (any_force([]<class Force>() { return DependsOnTime<Force>; }))
            cache_.field_valid = false;
        if (damping_ == Damping::in_kick) return;
        if (any_damper_of_rows())
            change_each_row(motion, [](auto& physics, std::size_t, State<T, Axes>& state) {
                physics.damp_before(state);
            });
        kernels_.damp_links(cache_.links, motion, false);
        damp_point_links(cache_.point_links, motion, false);
    }
    void damp_after(MotionColumns<T, Axes>& motion) {
        if (damping_ == Damping::in_kick) return;
        damp_point_links(cache_.point_links, motion, true);
        kernels_.damp_links(cache_.links, motion, true);
        if (any_damper_of_rows())
            change_each_row(motion, [](auto& physics, std::size_t, State<T, Axes>& state) {
                physics.damp_after(state);
            });
    }

    [[nodiscard]] std::optional<Divergence> land(std::int64_t tick, T dt) {
        bool changed = false;
        const auto lost = land_linked_rows<T, Axes>(columns_, cache_.before, {tick, dt}, changed);
        if (changed) cache_.field_valid = false;
        return lost;
    }

    /// Puts rows to sleep by the rule of rows without links.
    void put_to_sleep(MotionColumns<T, Axes>& motion, double t) {
        if (!any_slow(motion.v)) return;
        evaluate(motion, Evaluate::all, t, cache_.acceleration);
        change_each_row(motion, [&](auto& physics, std::size_t row, State<T, Axes>& state) {
            const auto& forces = physics.forces();
            const LinksOfRow<T>& links = cache_.links.of_rows[row];
            const T rate = forces.parts.damping ? forces.linear.damping : T(0);
            const Vec<T, Axes> before = state.v;
            put_row_to_sleep(forces, rate + links.damping,
                             forces.squares_speeds() + links.stiffness + links.damping,
                             load<T>(cache_.acceleration, row), state);
            settle_on_points(cache_.point_links, row, before, state);
        });
        cache_.field_valid = false;
    }

    [[nodiscard]] std::optional<Divergence> find_divergence(std::int64_t tick) {
        const MotionColumns<T, Axes>& motion = columns_.motion;
        std::atomic<bool> possible = false;
        in_ranges([&](const RowRange& rows) {
            if (kernels_.may_be_infinite(motion, rows)) possible = true;
        });
        if (!possible) return std::nullopt;
        for (std::size_t row = 0; row < columns_.size; ++row)
            if (const auto found = oiler::find_divergence(load<T>(motion, row), row, tick, 0))
                return found;
        return std::nullopt;
    }

    /// Newton's changes of w for the residual of w − v − τ·a(x + τ·w, w). The matrix is kept while
    /// all forces are linear.
    [[nodiscard]] Vectors solve(const MotionColumns<T, Axes>& at, T tau, const Vectors& residual) {
        if (!cache_.solve || cache_.solver_tau != tau || !linear()) {
            cache_.solve = factorised(columns_.size * Axes, velocity_entries(at, tau));
            cache_.solver_tau = tau;
        }
        std::vector<T> right(columns_.size * Axes);
        for (std::size_t i = 0; i < right.size(); ++i) right[i] = residual[i % Axes][i / Axes];
        const std::vector<T> solution = cache_.solve(right);
        Vectors change = residual;
        for (std::size_t i = 0; i < right.size(); ++i) change[i % Axes][i / Axes] = solution[i];
        return change;
    }

private:
    /// Fills the cache for the current bodies, forces and links.
    void prepare(T half_step, bool holds_ropes) {
        if (cache_.valid && cache_.links.half_step == half_step &&
            cache_.holds_ropes == holds_ropes)
            return;
        cache_ = {};
        cache_.holds_ropes = holds_ropes;
        auto links = columns_.links;
        auto point_links = columns_.point_links;
        if (holds_ropes) {
            for (auto& link : links) undamp_rope(link);
            for (auto& link : point_links) undamp_rope(link);
        }
        cache_.links = prepare_links(std::move(links), columns_.mass, columns_.size, half_step);
        cache_.point_links = prepare_point_links(std::move(point_links), half_step, cache_.links);
        cache_.acceleration = cache_.field = columns_.motion.v;
        cache_.valid = true;
    }

    [[nodiscard]] bool has_ropes() const {
        const auto pulls_only = [](const auto& link) { return link.pulls_only; };
        return std::ranges::any_of(columns_.links, pulls_only) ||
               std::ranges::any_of(columns_.point_links, pulls_only);
    }
    template <class AnyLink>
    static void undamp_rope(AnyLink& link) {
        if (link.pulls_only) link.damping = 0;
    }
    /// The matrix of a link in an implicit step.
    template <class AnyLink>
    static Matrix<T, Axes> link_matrix(AnyLink link, const State<T, Axes>& between, T tau) {
        undamp_rope(link);
        return velocity_matrix(LinkForce<T, Axes>(link).jacobian(between), T(0), tau);
    }

    template <class F>
    void for_each_row(F f) {
        Kinds kinds = 0;
        for (std::size_t row = 0; row < columns_.size; ++row) {
            if (row % row_padding == 0) kinds = kinds_of_block(columns_, row);
            auto physics = physics_of<T>(views_, row, kinds, damping_);
            f(physics, row);
        }
    }
    template <class F>
    void change_each_row(MotionColumns<T, Axes>& motion, F f) {
        for_each_row([&](auto& physics, std::size_t row) {
            State<T, Axes> state = load<T>(motion, row);
            f(physics, row, state);
            store(state, motion, row);
        });
    }

    static Vec<T, Axes> between(const Vectors& columns, const LinkRow<T>& link) {
        return load<T>(columns, link.a) - load<T>(columns, link.b);
    }
    static State<T, Axes> between(const MotionColumns<T, Axes>& motion, const LinkRow<T>& link) {
        return {between(motion.x, link), between(motion.v, link)};
    }

    template <class F>
    void in_ranges(F f) {
        in_parts(columns_.size, 1, team_, [&](std::size_t begin, std::size_t end, std::size_t) {
            f({begin, end});
            return std::optional<Divergence>();
        });
    }
    void evaluate(const MotionColumns<T, Axes>& motion, Evaluate what, double t, Vectors& out) {
        // Each row has its sum from one thread, in the order of the links.
        in_ranges([&](const RowRange& rows) {
            kernels_.accelerate(columns_, views_, motion, what, t, rows, out);
            kernels_.push_links(cache_.links, motion, what, rows, out);
            push_point_links<T, Axes>(cache_.point_links, motion, what, cache_.links.inverse_mass,
                                      rows, out);
            if (what == Evaluate::all)
                push_held<T, Axes>(cache_.held, motion, cache_.links.inverse_mass, rows, out);
        });
    }
    void evaluate_field(const MotionColumns<T, Axes>& motion, double t) {
        ++columns_.evaluations;
        evaluate(motion, Evaluate::field, t, cache_.field);
        cache_.field_valid = true;
    }

    [[nodiscard]] bool any_slow(const Vectors& velocity) const {
        for (const auto& speeds : velocity)
            for (std::size_t row = 0; row < columns_.size; ++row)
                if (any_nonzero_below(speeds[row], sleep_limit<T>(true))) return true;
        return false;
    }

    /// Whether rows have a kind of force for which `holds` is true.
    template <class Holds>
    [[nodiscard]] bool any_force(Holds holds) const {
        bool any = false;
        for_each_index<force_count>([&](auto i) {
            using Force = std::tuple_element_t<i, ForceList<T, Axes>>;
            if (holds.template operator()<Force>()) any = any || !columns_.forces[i].empty();
        });
        return any;
    }
    [[nodiscard]] bool any_damper_of_rows() const {
        return any_force([]<class Force>() { return Damps<Force, State<T, Axes>, T>; });
    }

    [[nodiscard]] bool linear() const {
        bool all = !any_force([]<class Force>() { return !Linear<Force>; });
        for (const LinkRow<T>& link : columns_.links) all = all && link.rest_length == 0;
        for (const auto& link : columns_.point_links) all = all && link.rest_length == 0;
        return all;
    }

    [[nodiscard]] std::vector<MatrixEntry<T>> velocity_entries(const MotionColumns<T, Axes>& at,
                                                               T tau) {
        std::vector<MatrixEntry<T>> entries;
        const auto add = [&](std::size_t row, std::size_t column, const Matrix<T, Axes>& block) {
            for (std::size_t i = 0; i < Axes; ++i)
                for (std::size_t j = 0; j < Axes; ++j)
                    entries.push_back({row * Axes + i, column * Axes + j, block.row[i].axis[j]});
        };
        for_each_row([&](auto& physics, std::size_t row) {
            add(row, row, velocity_matrix(physics.forces().jacobian(load<T>(at, row)), T(1), tau));
        });
        const auto& inverse_mass = cache_.links.inverse_mass;
        const auto add_pair = [&](std::size_t a, std::size_t b, const Matrix<T, Axes>& block) {
            add(a, a, block * inverse_mass[a]);
            add(a, b, block * -inverse_mass[a]);
            add(b, b, block * inverse_mass[b]);
            add(b, a, block * -inverse_mass[b]);
        };
        for (const LinkRow<T>& link : columns_.links)
            add_pair(link.a, link.b, link_matrix(link, between(at, link), tau));
        for (const PointLinkRow<T, Axes>& link : columns_.point_links)
            add(link.row, link.row,
                link_matrix(link, relative(at, link), tau) * inverse_mass[link.row]);
        for (const HeldDamper<T, Axes>& damper : cache_.held) {
            const Matrix<T, Axes> block =
                velocity_matrix(force_of(damper).jacobian(relative(at, damper)), T(0), tau);
            if (damper.other)
                add_pair(damper.row, *damper.other, block);
            else
                add(damper.row, damper.row, block * inverse_mass[damper.row]);
        }
        return entries;
    }

    static constexpr LinkedKernels<T, Axes> one_by_one = linked_kernels<T, T, Axes>();

    const LinkedKernels<T, Axes>& kernels_;
    Columns<T, Axes>& columns_;
    const RowViews<T, Axes>& views_;
    LinkCache<T, Axes>& cache_;
    Team* team_;
    Damping damping_;
};

}  // namespace

template <std::floating_point T, int Axes>
std::optional<Divergence> step_linked_rows(const StepCall<T, Axes>& call) {
    Columns<T, Axes>& columns = call.columns;
    const Steps& steps = call.steps;
    LinkedRows<T, Axes> physics(call);
    const bool lands = columns.contacts.possible();
    if (lands) columns.contacts.crushed.resize(columns.size);
    return std::visit(
        [&]<class Rule>(const Rule& rule) -> std::optional<Divergence> {
            for (std::int64_t j = 0; j < steps.count; ++j) {
                const std::int64_t tick = steps.first + j + 1;
                if (lands) columns.link_cache.before = columns.motion;
                physics.hold_ropes();
                if constexpr (!std::is_same_v<Rule, ExactPlan<T>>)
                    if (!advance(rule, columns.motion, physics, steps.rate.time(tick - 1)))
                        return Divergence{tick, 0, 0, Divergence::Of::solution};
                if (lands)
                    if (const auto lost = physics.land(tick - 1, steps.rate.template dt<T>()))
                        return lost;
                if (is_sleep_tick(tick))
                    physics.put_to_sleep(columns.motion, steps.rate.time(tick));
                if (const auto found = physics.find_divergence(tick)) return found;
            }
            return std::nullopt;
        },
        call.plan());
}

template std::optional<Divergence> step_linked_rows(const StepCall<float, 1>&);
template std::optional<Divergence> step_linked_rows(const StepCall<float, 2>&);
template std::optional<Divergence> step_linked_rows(const StepCall<float, 3>&);
template std::optional<Divergence> step_linked_rows(const StepCall<double, 1>&);
template std::optional<Divergence> step_linked_rows(const StepCall<double, 2>&);
template std::optional<Divergence> step_linked_rows(const StepCall<double, 3>&);
template std::optional<Divergence> step_linked_rows(const StepCall<long double, 1>&);
template std::optional<Divergence> step_linked_rows(const StepCall<long double, 2>&);
template std::optional<Divergence> step_linked_rows(const StepCall<long double, 3>&);

}  // namespace oiler
