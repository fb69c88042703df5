// SPDX-License-Identifier: MIT
#include "oiler/core/state_hash.hpp"

#include <fmt/core.h>

#define XXH_STATIC_LINKING_ONLY  // for the size of XXH3_state_t
#include <xxhash.h>

#include <bit>
#include <new>

namespace oiler {
namespace {

static_assert(std::endian::native == std::endian::little,
              "state hashes are defined over little-endian bytes: swap them here first");
static_assert(sizeof(XXH3_state_t) <= sizeof(StateHash) && alignof(XXH3_state_t) <= 64);

XXH3_state_t* state_in(std::array<std::byte, 576>& storage) {
    return std::launder(reinterpret_cast<XXH3_state_t*>(storage.data()));
}

const XXH3_state_t* state_in(const std::array<std::byte, 576>& storage) {
    return std::launder(reinterpret_cast<const XXH3_state_t*>(storage.data()));
}

}  // namespace

StateHash::StateHash() : state_{} { XXH3_64bits_reset(new (state_.data()) XXH3_state_t); }

void StateHash::add(std::span<const std::byte> bytes) {
    XXH3_64bits_update(state_in(state_), bytes.data(), bytes.size());
}

std::uint64_t StateHash::value() const { return XXH3_64bits_digest(state_in(state_)); }

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace oiler
