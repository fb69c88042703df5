// SPDX-License-Identifier: MIT
#include <cmath>

#include "oiler/sim/steps/area_crossings.hpp"
#include "oiler/sim/steps/land_row.hpp"
#include "oiler/sim/steps/short_steps.hpp"
#include "oiler/sim/steps/step_rows.hpp"

namespace oiler {
namespace {

/// Steps blocks with contacts one step at a time: first without obstacles, then again the rows that
/// may have met one.
template <std::floating_point T, int Axes>
class BlockStepper {
public:
    BlockStepper(const StepCall<T, Axes>& call, std::size_t part)
        : call_(call),
          columns_(call.columns),
          steps_(call.steps),
          impacts_(columns_.contacts.impacts_of_parts[part]),
          nears_(columns_.contacts.nears_of_parts[part]),
          moving_(columns_.contacts.moving_of_parts[part]) {}

    [[nodiscard]] std::optional<Divergence> step(std::size_t begin, std::size_t end) {
        std::optional<Divergence> first;
        for (std::size_t row = begin; row < end;) {
            std::size_t stop = row;
            while (stop < end && !block_has_contacts(stop)) stop += row_padding;
            if (stop > row) {
                keep_earlier(first, step_rows(call_, row, std::min(stop, end)));
            } else {
                stop = row + row_padding;
                keep_earlier(first, step_block(row, std::min(stop, end)));
            }
            row = stop;
        }
        return first;
    }

private:
    /// A search for boxes covers the way of so many steps, and one step more.
    static constexpr int search_ahead = 16;

    [[nodiscard]] const Obstacles<T, Axes>& obstacles() const {
        return columns_.contacts.obstacles;
    }
    [[nodiscard]] const Obstacles<T, Axes>& areas() const { return columns_.contacts.areas; }
    [[nodiscard]] const Parameter<T>& radius() const { return columns_.contacts.radius; }
    [[nodiscard]] bool has_contact(std::size_t row) const {
        return radius()[row] != Contacts<T, Axes>::no_contact;
    }
    [[nodiscard]] bool block_has_contacts(std::size_t begin) const {
        if (radius().shared()) return has_contact(0);
        for (std::size_t row = begin; row < std::min(begin + row_padding, columns_.size); ++row)
            if (has_contact(row)) return true;
        return false;
    }

    std::optional<Divergence> step_block(std::size_t begin, std::size_t end) {
        Steps one = steps_;
        one.count = 1;
        const StepCall<T, Axes> step{columns_, call_.method, one, call_.team};
        for (; one.first < steps_.first + steps_.count; ++one.first) {
            obstacles().list_moving(one.first, one.rate.template dt<T>(), moving_);
            if (obstacles().any_moves()) wake(begin, end);
            const bool rests = settled(begin, end);
            if (rests && !obstacles().any_moves() && !areas().any_moves()) return std::nullopt;
            save(begin, end);
            const std::size_t known = impacts_.size();
            if (!rests)
                if (const auto diverged = step_and_land(step, begin, end)) return diverged;
            if (!areas().empty()) list_crossings(begin, end, one.first, known);
        }
        return std::nullopt;
    }
    [[nodiscard]] bool settled(std::size_t begin, std::size_t end) const {
        const auto& settled = columns_.contacts.settled;
        return std::all_of(settled.data() + begin, settled.data() + end,
                           [](std::uint8_t one) { return one != 0; });
    }
    std::optional<Divergence> step_and_land(const StepCall<T, Axes>& step, std::size_t begin,
                                            std::size_t end) {
        auto diverged = step_rows(step, begin, end);
        find_meetings(begin, end);
        for (std::size_t row = begin; row < end; ++row)
            if (meets_[row - begin]) keep_earlier(diverged, land(row, row - begin, step.steps));
        return diverged;
    }
    /// Lists where rows enter and leave areas. Their impacts in the step begin at `known`.
    void list_crossings(std::size_t begin, std::size_t end, std::int64_t tick, std::size_t known) {
        const T dt = steps_.rate.template dt<T>();
        const std::size_t end_of_known = impacts_.size();
        for (std::size_t row = begin; row < end; ++row) {
            std::size_t last = known;
            while (last < end_of_known && impacts_[last].row == row) ++last;
            const State<T, Axes> from = state(x_, v_, row - begin);
            const State<T, Axes> to = load<T>(columns_.motion, row);
            if (has_contact(row) && (last > known || !is_clear_of_areas(row, from, to, dt)))
                AreaCrossings(columns_.contacts, row, tick, dt)
                    .list(from, to, impacts_, known, last, nears_);
            known = last;
        }
    }
    [[nodiscard]] bool is_clear_of_areas(std::size_t row, const State<T, Axes>& from,
                                         const State<T, Axes>& to, T dt) {
        if (areas().any_moves() || !areas().standing().half_spaces().empty()) return false;
        const Reach reach = reach_of(row, from, to, dt);
        return areas().standing().is_clear(reach.middle, reach.most, reach.widest,
                                           columns_.contacts.meets(row),
                                           columns_.contacts.area_clearings[row]);
    }
    /// The ball that a body stays in during a step, and that of a search.
    struct Reach {
        Vec<T, Axes> middle;  ///< m
        T most;               ///< m
        T widest;             ///< m
    };
    [[nodiscard]] Reach reach_of(std::size_t row, const State<T, Axes>& from,
                                 const State<T, Axes>& to, T dt) const {
        const T way = largest_way(from, to, dt);
        const T most = way + radius()[row] + obstacles().hidden_way(from.x, radius()[row]);
        return {(from.x + to.x) * T(0.5), most, most + search_ahead * way};
    }
    /// Wakes the rows that a moving obstacle gets near in the step.
    void wake(std::size_t begin, std::size_t end) {
        const bool all = obstacles().any_half_space_moves();
        for (std::size_t row = begin; row < end; ++row) {
            auto& settled = columns_.contacts.settled[row];
            if (!settled) continue;
            const Vec<T, Axes> x = load<T>(columns_.motion, row).x;
            const T most = radius()[row] + obstacles().hidden_way(x, radius()[row]);
            settled = !all && !is_moving_near(x, most);
        }
    }
    [[nodiscard]] bool is_moving_near(const Vec<T, Axes>& x, T most) const {
        return std::ranges::any_of(moving_, [&](const auto& one) { return one.is_near(x, most); });
    }
    void save(std::size_t begin, std::size_t end) {
        for (std::size_t axis = 0; axis < Axes; ++axis) {
            const T* const x = columns_.motion.x[axis].data();
            const T* const v = columns_.motion.v[axis].data();
            std::copy(x + begin, x + end, x_[axis].data());
            std::copy(v + begin, v + end, v_[axis].data());
        }
    }

    /// Marks the rows that may have met an obstacle in the last step, see may_meet.
    void find_meetings(std::size_t begin, std::size_t end) {
        meets_ = {};
        const auto x = generate<Axes>([&](auto i) { return columns_.motion.x[i].data() + begin; });
        const auto v = generate<Axes>([&](auto i) { return columns_.motion.v[i].data() + begin; });
        const NumberView<T> radii(radius());
        const T dt = steps_.rate.template dt<T>();
        const bool meet_all = columns_.contacts.layers_met.empty();
        for (const std::size_t slot : obstacles().standing().half_spaces()) {
            const PlaneOf<T, Axes> plane = obstacles().standing()[slot].surface;
            const std::uint32_t layers = obstacles().standing()[slot].layers;
            for (std::size_t i = 0; i < end - begin; ++i)
                if (meet_all || (columns_.contacts.meets(begin + i) & layers) != 0)
                    meets_[i] |= may_meet(plane, radii.template at<T>(begin + i), state(x_, v_, i),
                                          state(x, v, i), dt);
        }
        if (obstacles().any_moves() || obstacles().any_bounded())
            for (std::size_t i = 0; i < end - begin; ++i)
                if (meets_[i] == 0 && has_contact(begin + i))
                    meets_[i] = columns_.contacts.settled[begin + i] != 0 ||
                                !is_clear(begin + i, state(x_, v_, i), state(x, v, i), dt);
    }
    /// Whether a row stays clear of boxes and of moving obstacles in a step.
    [[nodiscard]] bool is_clear(std::size_t row, const State<T, Axes>& from,
                                const State<T, Axes>& to, T dt) {
        if (obstacles().any_half_space_moves()) return false;
        const Reach reach = reach_of(row, from, to, dt);
        return !is_moving_near(reach.middle, reach.most) &&
               obstacles().standing().is_clear(reach.middle, reach.most, reach.widest,
                                               columns_.contacts.meets(row),
                                               columns_.contacts.clearings[row]);
    }
    template <class From>
    [[nodiscard]] static State<T, Axes> state(const From& x, const From& v, std::size_t i) {
        return {{generate<Axes>([&](auto axis) { return T(x[axis][i]); })},
                {generate<Axes>([&](auto axis) { return T(v[axis][i]); })}};
    }

    std::optional<Divergence> land(std::size_t row, std::size_t saved, const Steps& step) {
        State<T, Axes> state = this->state(x_, v_, saved);
        auto& settled = columns_.contacts.settled[row];
        if (!settled) {
            ShortSteps<T, Axes> body(call_, shorter_, row, step.rate.time(step.first));
            const Landed landed = land(state, row, step, body);
            settled = landed == Landed::settled && columns_.applied.empty();
            if (row == 0) columns_.evaluations += body.evaluations();
            if (!body.solved()) return Divergence{step.first + 1, row, 0, Divergence::Of::solution};
            if (landed == Landed::unresolved)
                return Divergence{step.first + 1, row, 0, Divergence::Of::impacts};
            put_to_sleep(state, row, step.first + 1);
        }
        store(state, columns_.motion, row);
        return std::nullopt;
    }
    /// The first search goes twice as far as the free step.
    Landed land(State<T, Axes>& state, std::size_t row, const Steps& step,
                ShortSteps<T, Axes>& body) {
        const T dt = step.rate.template dt<T>();
        const State<T, Axes> end = load<T>(columns_.motion, row);
        const T way = obstacles().any_bounded()
                          ? (length(state.v) + length(end.v - state.v)) * 2 * dt
                          : std::numeric_limits<T>::infinity();
        return land_row<T, Axes>(columns_.contacts, state, row, {step.first, dt}, way, body,
                                 impacts_, nears_);
    }
    [[nodiscard]] Damping damping() const { return steps_.damping.value_or(call_.method.damping); }
    void put_to_sleep(State<T, Axes>& state, std::size_t row, std::int64_t tick) {
        if (!is_sleep_tick(tick)) return;
        auto physics = physics_of<T>(columns_.views, row, columns_.kinds[row], damping());
        physics.put_to_sleep(state, steps_.rate.time(tick));
    }

    const StepCall<T, Axes>& call_;
    Columns<T, Axes>& columns_;
    const Steps& steps_;
    std::vector<RowImpact<T, Axes>>& impacts_;
    std::vector<Near<T, Axes>>& nears_;
    std::vector<typename Obstacles<T, Axes>::Ball>& moving_;  ///< in the current step
    ShorterPlan<T> shorter_;
    std::array<std::array<T, row_padding>, Axes> x_;  ///< at the start of the step
    std::array<std::array<T, row_padding>, Axes> v_;
    std::array<std::uint8_t, row_padding> meets_;
};

}  // namespace

template <std::floating_point T, int Axes>
std::optional<Divergence> step_landing_rows(const StepCall<T, Axes>& call) {
    auto& contacts = call.columns.contacts;
    contacts.settled.resize(call.columns.size);
    contacts.crushed.resize(call.columns.size);
    contacts.impacts_of_parts.resize(call.team ? call.team->size() : 1);
    contacts.nears_of_parts.resize(contacts.impacts_of_parts.size());
    contacts.moving_of_parts.resize(contacts.impacts_of_parts.size());
    if (!contacts.areas.empty()) contacts.area_clearings.resize(call.columns.size);
    if (contacts.obstacles.any_bounded()) contacts.clearings.resize(call.columns.size);
    const auto diverged = in_parts(call.columns.size, call.steps.count, call.team,
                                   [&](std::size_t begin, std::size_t end, std::size_t part) {
                                       return BlockStepper(call, part).step(begin, end);
                                   });
    contacts.gather_impacts();
    return diverged;
}

template std::optional<Divergence> step_landing_rows(const StepCall<float, 1>&);
template std::optional<Divergence> step_landing_rows(const StepCall<float, 2>&);
template std::optional<Divergence> step_landing_rows(const StepCall<float, 3>&);
template std::optional<Divergence> step_landing_rows(const StepCall<double, 1>&);
template std::optional<Divergence> step_landing_rows(const StepCall<double, 2>&);
template std::optional<Divergence> step_landing_rows(const StepCall<double, 3>&);
template std::optional<Divergence> step_landing_rows(const StepCall<long double, 1>&);
template std::optional<Divergence> step_landing_rows(const StepCall<long double, 2>&);
template std::optional<Divergence> step_landing_rows(const StepCall<long double, 3>&);

}  // namespace oiler
