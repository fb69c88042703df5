// SPDX-License-Identifier: MIT
#include "oiler/lab/rates_json.hpp"

#include "oiler/lab/sweep/json.hpp"

namespace oiler::lab {
namespace {

Json list_of(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double value : values) list.push_back(number_or_null(value));
    return list;
}

}  // namespace

Json json_of(const Rates& rates) {
    Json quantities = Json::array();
    for (const RatesQuantity& quantity : rates.quantities) {
        Json lines = Json::array();
        for (const RatesLine& line : quantity.lines)
            lines.push_back({{"method", line.method->name},
                             {"values", list_of(line.values)},
                             {"spread_percent", number_or_null(line.spread_percent)}});
        quantities.push_back({{"name", quantity.name},
                              {"unit", quantity.unit},
                              {"body", rates.body},
                              {"truth", number_or_null(quantity.truth)},
                              {"methods", std::move(lines)}});
    }
    return {{"rates", rates.rates}, {"quantities", std::move(quantities)}};
}

}  // namespace oiler::lab
