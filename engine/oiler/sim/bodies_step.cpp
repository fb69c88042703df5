// SPDX-License-Identifier: MIT
#include <string_view>

#include "oiler/core/error.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/sim/flows.hpp"
#include "oiler/sim/preflight.hpp"
#include "oiler/sim/step_rows.hpp"

namespace oiler {
namespace {

template <class T>
Plan<T> plan_for(const Method& method, const Steps& steps) {
    return make_plan<T>(method, steps.rate.dt<T>(), steps.damping.value_or(method.damping));
}

}  // namespace

void Bodies::step(const Method& method, const Steps& steps) {
    if (const auto at = try_step(method, steps))
        fail_diverged(*this, *at, method, steps, [](std::size_t row) { return row; });
}

std::optional<Divergence> Bodies::try_step(const Method& method, const Steps& steps) {
    require_forces_for(method);
    return std::visit(
        [&]<class T, int Axes>(Columns<T, Axes>& columns) {
            const Plan<T> plan = plan_for<T>(method, steps);
            prepare_flows(columns, plan);
            return columns.links.empty() ? step_rows(columns, plan, steps)
                                         : step_linked_rows(columns, plan, steps);
        },
        columns_);
}

void Bodies::require_applicable(const Method& method, const Steps& steps) const {
    require_forces_for(method);
    std::visit([&]<class T, int Axes>(
                   Columns<T, Axes> copy) { prepare_flows(copy, plan_for<T>(method, steps)); },
               columns_);
}

void Bodies::require_forces_for(const Method& method) const {
    if (!std::holds_alternative<ExactFlow>(method.rule)) return;
    constexpr std::string_view remedy = "choose another method, such as rk4 or velocity_verlet";
    if (link_count() > 0)
        fail(Exit::usage, "method {}: it steps bodies one by one, and these are linked; {}",
             method.name, remedy);
    std::visit(
        [&]<class T, int Axes>(const Columns<T, Axes>& columns) {
            for_each_index<force_count>([&](auto i) {
                using Force = std::tuple_element_t<i, ForceList<T, Axes>>;
                if (!Force::linear && std::get<i>(columns.forces).present)
                    fail(Exit::usage, "method {}: {} is not linear in position and velocity; {}",
                         method.name, Force::name, remedy);
            });
        },
        columns_);
}

}  // namespace oiler
