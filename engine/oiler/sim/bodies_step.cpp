// SPDX-License-Identifier: MIT
#include <functional>
#include <string_view>

#include "oiler/core/error.hpp"
#include "oiler/core/require.hpp"
#include "oiler/sim/any_columns.hpp"
#include "oiler/sim/steps/row_parts.hpp"
#include "oiler/sim/steps/step_rows.hpp"

namespace oiler {
namespace {

bool is_listed(const Method& method) {
    return std::greater_equal<>{}(&method, methods().data()) &&
           std::less<>{}(&method, methods().data() + methods().size());
}

/// The cached plan, renewed if method, rate or damping differ from those of the step before.
template <class T>
const Plan<T>& plan_for(PlanCache<T>& cache, const Method& method, const Steps& steps) {
    const Damping damping = steps.damping.value_or(method.damping);
    if (cache.method != &method || cache.rate != steps.rate || cache.damping != damping)
        cache = {is_listed(method) ? &method : nullptr, steps.rate, damping,
                 make_plan<T>(method, steps.rate.dt<T>(), damping)};
    return cache.plan;
}

template <class T, int Axes>
std::optional<Divergence> step_columns(Columns<T, Axes>& columns, const Method& method,
                                       const Steps& steps, Team* team) {
    if (columns.size == 0 || steps.count == 0) return std::nullopt;
    const Plan<T>& plan = plan_for(columns.plan_cache, method, steps);
    const RowViews<T, Axes> views(columns, plan);
    const StepCall<T, Axes> call{columns, views, method, plan, steps, kernels<T, Axes>(), team};
    if (columns.has_links()) return step_linked_rows(call);
    if (columns.contacts.possible()) return step_landing_rows(call);
    return in_parts(columns.size, steps, team,
                    [&](std::size_t begin, std::size_t end, std::size_t) {
                        return step_rows(call, begin, end);
                    });
}

}  // namespace

void Bodies::set_threads(int threads) {
    require(threads >= 1, "stepping needs at least one thread");
    team_ = threads == 1 ? nullptr : std::make_shared<Team>(static_cast<std::size_t>(threads));
}

void Bodies::step(const Method& method, const Steps& steps) {
    if (const auto at = try_step(method, steps))
        fail(Exit::diverged, "{}",
             describe(*at, method, steps.rate, link_count() > 0,
                      [](std::size_t row) { return row; }));
}

std::optional<Divergence> Bodies::try_step(const Method& method, const Steps& steps) {
    require_forces_for(method);
    return std::visit(
        [&]<class T, int Axes>(Columns<T, Axes>& columns) -> std::optional<Divergence> {
            columns.contacts.impacts.clear();
            if (columns.applied.empty() || steps.count == 0)
                return step_columns(columns, method, steps, team_.get());
            const Steps first{steps.rate, steps.first, 1, steps.damping};
            const auto diverged = step_columns(columns, method, first, team_.get());
            columns.applied.clear();
            columns.state_changed();
            if (diverged) return diverged;
            const Steps rest{steps.rate, steps.first + 1, steps.count - 1, steps.damping};
            return step_columns(columns, method, rest, team_.get());
        },
        columns_->of);
}

void Bodies::require_applicable(const Method& method, const Steps& steps) const {
    require_forces_for(method);
    const Damping damping = steps.damping.value_or(method.damping);
    std::visit(
        [&]<class T, int Axes>(const Columns<T, Axes>& columns) {
            require_flows(columns, make_plan<T>(method, steps.rate.dt<T>(), damping));
        },
        columns_->of);
}

void Bodies::require_forces_for(const Method& method) const {
    if (!std::holds_alternative<ExactFlow>(method.rule)) return;
    constexpr std::string_view remedy = "choose another method, such as rk4 or velocity_verlet";
    if (link_count() > 0)
        fail(Exit::usage, "method {}: it cannot step linked bodies; {}", method.name, remedy);
    std::visit(
        [&]<class T, int Axes>(const Columns<T, Axes>& columns) {
            for_each_index<force_count>([&](auto i) {
                using Force = std::tuple_element_t<i, ForceList<T, Axes>>;
                if (!Linear<Force> && !std::get<i>(columns.forces).empty())
                    fail(Exit::usage, "method {}: {} has no exact flow; {}", method.name,
                         Force::name, remedy);
            });
        },
        columns_->of);
}

}  // namespace oiler
