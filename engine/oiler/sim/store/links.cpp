// SPDX-License-Identifier: MIT
#include "oiler/sim/store/links.hpp"

#include <tuple>
#include <utility>

#include "oiler/physics/response.hpp"

namespace oiler {
namespace {

template <class T>
void sort(std::vector<LinkRow<T>>& links) {
    const auto key = [](const LinkRow<T>& link) {
        return std::tuple(link.pulls_only, std::int64_t{link.b} - std::int64_t{link.a},
                          link.rest_length, link.stiffness, link.damping, link.a);
    };
    std::stable_sort(
        links.begin(), links.end(),
        [&](const LinkRow<T>& one, const LinkRow<T>& other) { return key(one) < key(other); });
}

template <class T>
bool continues(const LinkGroup<T>& run, const LinkRow<T>& link) {
    return run.count < most_links_per_run && link.a == run.of.a + run.count &&
           link.b == run.of.b + run.count && link.stiffness == run.of.stiffness &&
           link.damping == run.of.damping && link.rest_length == run.of.rest_length &&
           link.pulls_only == run.of.pulls_only;
}

template <class T>
std::vector<LinkGroup<T>> find_runs(const std::vector<LinkRow<T>>& links) {
    std::vector<LinkGroup<T>> runs;
    for (std::size_t i = 0; i < links.size(); ++i) {
        if (runs.empty() || !continues(runs.back(), links[i])) runs.push_back({links[i], i, 0, {}});
        ++runs.back().count;
    }
    return runs;
}

/// Whether a link may join the last group of scattered links.
template <class T>
bool may_join(const std::vector<LinkGroup<T>>& groups, const LinkRow<T>& link) {
    if (groups.empty()) return false;
    const LinkGroup<T>& last = groups.back();
    return last.scattered && last.count < most_scattered_links &&
           last.of.pulls_only == link.pulls_only &&
           (last.of.rest_length == 0) == (link.rest_length == 0);
}

/// Groups the links; runs of one link are scattered links.
template <class T>
void group(PreparedLinks<T>& prepared, const std::vector<LinkRow<T>>& links) {
    ScatteredLinks<T>& scattered = prepared.scattered;
    std::vector<LinkGroup<T>>& groups = prepared.groups;
    for (const LinkGroup<T>& run : find_runs(links)) {
        if (run.count > 1) {
            groups.push_back(run);
            continue;
        }
        if (!may_join(groups, run.of)) groups.push_back({run.of, run.first, 0, scattered.a.size()});
        LinkGroup<T>& last = groups.back();
        ++last.count;
        last.of.damping = std::max(last.of.damping, run.of.damping);
        scattered.a.push_back(run.of.a);
        scattered.b.push_back(run.of.b);
        scattered.stiffness.push_back(run.of.stiffness);
        scattered.damping.push_back(run.of.damping);
        scattered.rest_length.push_back(run.of.rest_length);
    }
}

}  // namespace

template <std::floating_point T>
PreparedLinks<T> prepare_links(std::vector<LinkRow<T>> links, const Parameter<double>& mass,
                               std::size_t rows, T half_step) {
    PreparedLinks<T> prepared;
    prepared.half_step = half_step;
    for (std::size_t row = 0; row < rows; ++row)
        prepared.inverse_mass.push(static_cast<T>(1 / mass[row]));
    prepared.of_rows.resize(rows);
    sort(links);
    // Most links have the numbers of the link before them.
    T rate = 0;
    T reach = oscillator_response(T(0), rate, half_step).reach;
    for (const LinkRow<T>& link : links) {
        const T rate_before = std::exchange(
            rate, link.damping * (prepared.inverse_mass[link.a] + prepared.inverse_mass[link.b]));
        if (rate != rate_before) reach = oscillator_response(T(0), rate, half_step).reach;
        prepared.loss.push_back(rate * reach);
        prepared.any_damped = prepared.any_damped || link.damping > 0;
        for (const std::size_t row : {link.a, link.b}) {
            prepared.of_rows[row].stiffness += link.stiffness;
            prepared.of_rows[row].damping += link.damping;
        }
    }
    prepared.loss.push_back(0);
    group(prepared, links);
    return prepared;
}

template <std::floating_point T>
std::vector<std::size_t> damping_order(std::vector<LinkRow<T>> links) {
    for (std::size_t i = 0; i < links.size(); ++i) links[i].slot = static_cast<std::uint32_t>(i);
    sort(links);
    std::vector<std::size_t> order;
    for (const LinkGroup<T>& run : find_runs(links)) {
        const std::size_t step = run.shift() == 1 ? 2 : 1;
        for (std::size_t first = 0; first < step; ++first)
            for (std::size_t i = first; i < run.count; i += step)
                order.push_back(links[run.first + i].slot);
    }
    return order;
}

template std::vector<std::size_t> damping_order(std::vector<LinkRow<float>>);
template std::vector<std::size_t> damping_order(std::vector<LinkRow<double>>);
template std::vector<std::size_t> damping_order(std::vector<LinkRow<long double>>);

template PreparedLinks<float> prepare_links(std::vector<LinkRow<float>>, const Parameter<double>&,
                                            std::size_t, float);
template PreparedLinks<double> prepare_links(std::vector<LinkRow<double>>, const Parameter<double>&,
                                             std::size_t, double);
template PreparedLinks<long double> prepare_links(std::vector<LinkRow<long double>>,
                                                  const Parameter<double>&, std::size_t,
                                                  long double);

}  // namespace oiler
