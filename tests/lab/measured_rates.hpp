// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "lab/measured_scenes.hpp"
#include "oiler/lab/rates/rates.hpp"
#include "support/test.hpp"

namespace oiler::test {

using Rate = std::int64_t;

inline Rates rates_of(const std::string& text, const std::vector<Rate>& rates,
                      const std::vector<const char*>& names, std::size_t row = 0) {
    const MeasuredScene measured(text);
    return measure_rates(measured.scene, measured.reference, row, rates, methods_of(names),
                         [] { return false; });
}

inline const RatesQuantity* find(const Rates& rates, const std::string& part) {
    for (const RatesQuantity& quantity : rates.quantities)
        if (quantity.name.starts_with(part)) return &quantity;
    return nullptr;
}

inline const RatesQuantity& quantity_of(const Rates& rates, const std::string& part) {
    const RatesQuantity* const found = find(rates, part);
    if (!found) throw std::invalid_argument("no quantity " + part);
    return *found;
}

inline double value_of(const Rates& rates, const std::string& part, std::size_t method,
                       std::size_t rate) {
    return quantity_of(rates, part).lines.at(method).values.at(rate);
}

}  // namespace oiler::test
