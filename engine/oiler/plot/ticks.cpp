// SPDX-License-Identifier: MIT
#include "oiler/plot/ticks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace oiler {
namespace {

bool is_logarithmic(Range range) {
    return range.low > 0 && range.high > range.low && std::isfinite(range.high);
}

/// The factors times powers of ten, within the range.
std::vector<double> multiples(Range range, std::initializer_list<int> factors) {
    std::vector<double> at;
    const double last = std::ceil(std::log10(range.high));
    for (double power = std::floor(std::log10(range.low)); power <= last; ++power)
        for (const int factor : factors) {
            const double tick = factor * std::pow(10.0, power);
            if (tick / range.low >= 1 - 1e-9 && tick / range.high <= 1 + 1e-9) at.push_back(tick);
        }
    return at;
}

}  // namespace

std::vector<double> ticks(Range range, int count) {
    const double rough = (range.high - range.low) / count;
    if (!(rough > 0) || !std::isfinite(rough)) return {};
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double factor : {5.0, 2.0, 1.0})
        if (factor * power >= rough * 0.999) step = factor * power;
    std::vector<double> at;
    const double first = std::ceil(range.low / step - 1e-9);
    for (int i = 0; i <= 2 * count; ++i) {
        const double tick = (first + i) * step;
        if (tick > range.high + step * 1e-9) break;
        at.push_back(tick == 0 ? 0.0 : tick);
    }
    return at;
}

std::vector<double> logarithmic_ticks(Range range, int count) {
    constexpr std::size_t fewest = 3;
    if (!is_logarithmic(range) || count < 1) return {};
    std::vector<double> powers = multiples(range, {1});
    if (powers.size() >= fewest) {
        const long stride = std::max(1L, std::lround(static_cast<double>(powers.size()) / count));
        std::erase_if(powers, [&](double at) { return std::lround(std::log10(at)) % stride != 0; });
        return powers;
    }
    const std::vector<double> more = multiples(range, {1, 2, 5});
    return more.size() >= fewest ? more : ticks(range, count);
}

std::vector<double> ticks(Range range, Scale scale, int count) {
    return scale == Scale::linear ? ticks(range, count) : logarithmic_ticks(range, count);
}

std::vector<double> minor_ticks(Range range, Scale scale) {
    constexpr double most_decades = 4;
    if (scale == Scale::linear || !is_logarithmic(range)) return {};
    if (std::log10(range.high) - std::log10(range.low) > most_decades + 1e-9) return {};
    return multiples(range, {2, 3, 4, 5, 6, 7, 8, 9});
}

std::string tick_label(double at, Scale scale) {
    if (scale == Scale::linear || (at > 0.000999 && at < 9999.5)) return fmt::format("{:g}", at);
    const double power = std::floor(std::log10(at) + 1e-9);
    return fmt::format("{:g}e{:g}", at / std::pow(10.0, power), power);
}

}  // namespace oiler
