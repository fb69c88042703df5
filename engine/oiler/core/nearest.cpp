// SPDX-License-Identifier: MIT
#include "oiler/core/nearest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace oiler {
namespace {

/// Number of letters to insert, delete or replace to turn `a` into `b`: Levenshtein, 1966.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, changed}));
        }
    }
    return row.back();
}

}  // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string_view> words) {
    // Longer words are no misspellings, and a file of long names would take minutes.
    constexpr std::size_t longest = 64;
    std::string_view best;
    std::size_t least = 2 + word.size() / 4;
    for (const std::string_view candidate : words) {
        if (std::max(word.size(), candidate.size()) > longest) continue;
        const std::size_t letters = distance(word, candidate);
        if (letters >= least) continue;
        least = letters;
        best = candidate;
    }
    return best.empty() ? "" : fmt::format("; did you mean `{}`?", best);
}

}  // namespace oiler
