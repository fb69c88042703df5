// SPDX-License-Identifier: MIT
#include <functional>
#include <string_view>

#include "oiler/core/error.hpp"
#include "oiler/core/require.hpp"
#include "oiler/sim/any_columns.hpp"
#include "oiler/sim/kernels/kernels.hpp"
#include "oiler/sim/rows/renew_views.hpp"
#include "oiler/sim/steps/step_rows.hpp"

namespace oiler {
namespace {

bool is_listed(const Method& method) {
    return std::greater_equal<>{}(&method, methods().data()) &&
           std::less<>{}(&method, methods().data() + methods().size());
}

/// Renews the plan and the views of the columns if method, rate, damping or forces differ from
/// those of the step before.
template <class T, int Axes>
void prepare(Columns<T, Axes>& columns, const Method& method, const Steps& steps) {
    const Damping damping = steps.damping.value_or(method.damping);
    PlanCache<T, Axes>& cache = columns.plan_cache;
    if (cache.method != &method || cache.rate != steps.rate || cache.damping != damping) {
        const Plan<T> plan = make_plan<T>(method, steps.rate.dt<T>(), damping);
        const auto* const all = kernels<T, Axes>();
        cache = {is_listed(method) ? &method : nullptr, steps.rate, damping, plan,
                 all ? all->of(plan) : RowKernels<T, Axes>{}};
        columns.views.valid = false;
    }
    if (!columns.views.valid) renew_views(columns, cache.plan);
}

template <class T, int Axes>
std::optional<Divergence> step_columns(Columns<T, Axes>& columns, const Method& method,
                                       const Steps& steps, Team* team) {
    if (columns.size == 0 || steps.count == 0) return std::nullopt;
    prepare(columns, method, steps);
    const StepCall<T, Axes> call{columns, method, steps, team};
    if (columns.has_links()) return step_linked_rows(call);
    if (columns.contacts.possible()) return step_landing_rows(call);
    return in_parts(columns.size, steps.count, team,
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
                      [](std::size_t row) { return std::to_string(row); }));
}

std::optional<Divergence> Bodies::try_step(const Method& method, const Steps& steps) {
    if (std::holds_alternative<ExactFlow>(method.rule)) require_exact_flow(method);
    return columns_->visit(
        [&]<class T, int Axes>(Columns<T, Axes>& columns) -> std::optional<Divergence> {
            columns.contacts.impacts.clear();
            for (const bool solid : {true, false})
                columns.contacts.all(solid).begin(steps.rate, steps.first);
            const auto whole = [&](const std::optional<Divergence>& diverged) {
                for (const bool solid : {true, false})
                    columns.contacts.all(solid).end(steps.first + steps.count);
                return diverged;
            };
            if (columns.applied.empty() || steps.count == 0)
                return whole(step_columns(columns, method, steps, team_.get()));
            const Steps first{steps.rate, steps.first, 1, steps.damping};
            const auto diverged = step_columns(columns, method, first, team_.get());
            forget_forces();
            if (diverged) return diverged;
            const Steps rest{steps.rate, steps.first + 1, steps.count - 1, steps.damping};
            return whole(step_columns(columns, method, rest, team_.get()));
        });
}

void Bodies::require_applicable(const Method& method, const Steps& steps) const {
    if (std::holds_alternative<ExactFlow>(method.rule)) require_exact_flow(method);
    const Damping damping = steps.damping.value_or(method.damping);
    columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        require_flows(columns, make_plan<T>(method, steps.rate.dt<T>(), damping));
    });
}

void Bodies::require_exact_flow(const Method& method) const {
    constexpr std::string_view remedy = "choose another method, such as rk4 or velocity_verlet";
    if (link_count() > 0)
        fail(Exit::usage, "method {}: it cannot step linked bodies; {}", method.name, remedy);
    columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        for_each_index<force_count>([&](auto i) {
            using Force = std::tuple_element_t<i, ForceList<T, Axes>>;
            if (!Linear<Force> && !columns.forces[i].empty())
                fail(Exit::usage, "method {}: {} has no exact flow; {}", method.name, Force::name,
                     remedy);
        });
    });
}

}  // namespace oiler
