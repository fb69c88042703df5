// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "oiler/sim/bodies.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// A number in another precision.
template <std::floating_point To>
[[nodiscard]] To converted(std::floating_point auto from) {
    return static_cast<To>(from);
}
/// A force of the same kind in another precision and number of axes.
template <class To, class From>
[[nodiscard]] To converted_force(const From& from) {
    To to;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        constexpr auto target = To::fields();
        constexpr auto source = From::fields();
        const auto convert = [](auto& number, const auto& given) {
            number = converted<std::decay_t<decltype(number)>>(given);
        };
        (convert(to.*std::get<I>(target).member, from.*std::get<I>(source).member), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(To::fields())>>{});
    if constexpr (HasRests<To>) to.take_rests(from);
    return to;
}

/// The columns of all bodies, for each precision and number of axes. Only the files that define
/// Bodies include this, because it takes seconds to compile.
struct AnyColumns {
    std::variant<Columns<float, 1>, Columns<float, 2>, Columns<float, 3>, Columns<double, 1>,
                 Columns<double, 2>, Columns<double, 3>, Columns<long double, 1>,
                 Columns<long double, 2>, Columns<long double, 3>>
        of;

    /// Calls f(columns).
    template <class F>
    decltype(auto) visit(F f) {
        return std::visit(f, of);
    }
};

}  // namespace oiler
