// SPDX-License-Identifier: MIT
#include <cmath>

#include "oiler/physics/contacts/landing.hpp"
#include "oiler/sim/landing/short_steps.hpp"
#include "oiler/sim/steps/row_parts.hpp"
#include "oiler/sim/steps/step_rows.hpp"

namespace oiler {
namespace {

/// Steps blocks with contacts one step at a time: first as if there were no planes, then the rows
/// that may have met one again.
template <std::floating_point T, int Axes>
class BlockStepper {
public:
    BlockStepper(const StepCall<T, Axes>& call, std::vector<RowImpact<T, Axes>>& impacts)
        : call_(call), columns_(call.columns), steps_(call.steps), impacts_(impacts) {}

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
    using Surface = PlaneOf<T, Axes>;

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
        const StepCall<T, Axes> step{columns_, call_.views,   call_.method, call_.plan,
                                     one,      call_.kernels, call_.team};
        for (; one.first < steps_.first + steps_.count; ++one.first) {
            if (settled(begin, end)) return std::nullopt;
            save(begin, end);
            auto diverged = step_rows(step, begin, end);
            find_meetings(begin, end);
            for (std::size_t row = begin; row < end; ++row)
                if (meets_[row - begin]) keep_earlier(diverged, land(row, row - begin, one));
            if (diverged) return diverged;
        }
        return std::nullopt;
    }
    [[nodiscard]] bool settled(std::size_t begin, std::size_t end) const {
        const auto& settled = columns_.contacts.settled;
        return std::all_of(settled.data() + begin, settled.data() + end,
                           [](std::uint8_t one) { return one != 0; });
    }
    void save(std::size_t begin, std::size_t end) {
        for (std::size_t axis = 0; axis < Axes; ++axis) {
            const T* const x = columns_.motion.x[axis].data();
            const T* const v = columns_.motion.v[axis].data();
            std::copy(x + begin, x + end, x_[axis].data());
            std::copy(v + begin, v + end, v_[axis].data());
        }
    }

    /// Marks the rows that the last step brought below a plane or turned near it, and those that it
    /// started on or below a plane and not away from it.
    void find_meetings(std::size_t begin, std::size_t end) {
        meets_ = {};
        const auto x = generate<Axes>([&](auto i) { return columns_.motion.x[i].data() + begin; });
        const auto v = generate<Axes>([&](auto i) { return columns_.motion.v[i].data() + begin; });
        const NumberView<T> radii(radius());
        const T dt = steps_.rate.template dt<T>();
        for (const Surface& plane : columns_.contacts.planes)
            for (std::size_t i = 0; i < end - begin; ++i)
                meets_[i] |= may_meet(plane, radii.template at<T>(begin + i), state(x_, v_, i),
                                      state(x, v, i), dt);
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
            ShortSteps<T, Axes> body(columns_, call_.views, row, call_.method, damping(),
                                     step.rate.time(step.first));
            std::size_t index = 0;
            const auto report = [&](const ImpactOf<T, Axes>& impact) {
                impacts_.push_back({step.first, row, index++, impact});
            };
            Landing landing(std::span<const Surface>(columns_.contacts.planes), radius()[row], body,
                            report);
            const Landed landed = landing.step(state, step.rate.template dt<T>());
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
    [[nodiscard]] Damping damping() const { return steps_.damping.value_or(call_.method.damping); }
    void put_to_sleep(State<T, Axes>& state, std::size_t row, std::int64_t tick) {
        if (!is_sleep_tick(tick)) return;
        auto physics = physics_of<T>(call_.views, row, columns_.kinds[row], damping());
        physics.put_to_sleep(state, steps_.rate.time(tick));
    }

    const StepCall<T, Axes>& call_;
    Columns<T, Axes>& columns_;
    const Steps& steps_;
    std::vector<RowImpact<T, Axes>>& impacts_;
    std::array<std::array<T, row_padding>, Axes> x_;  ///< at the start of the step
    std::array<std::array<T, row_padding>, Axes> v_;
    std::array<std::uint8_t, row_padding> meets_;
};

}  // namespace

template <std::floating_point T, int Axes>
std::optional<Divergence> step_landing_rows(const StepCall<T, Axes>& call) {
    auto& contacts = call.columns.contacts;
    contacts.settled.resize(call.columns.size);
    contacts.impacts_of_parts.resize(call.team ? call.team->size() : 1);
    const auto diverged =
        in_parts(call.columns.size, call.steps, call.team,
                 [&](std::size_t begin, std::size_t end, std::size_t part) {
                     return BlockStepper(call, contacts.impacts_of_parts[part]).step(begin, end);
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
