// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "oiler/capture/file.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Throws Error{diverged} if the energy is not finite. Its squares overflow before the state does.
void require_finite(const Energy& energy, const World& world);

/// Writes CSV files after each step: a row per body (trace) and a row of energies. Numbers read
/// back to the same bits.
class Recorder {
public:
    /// Empty paths record nothing. Writes the state at tick 0. Throws Error{io}.
    Recorder(const std::filesystem::path& trace, const std::filesystem::path& energy,
             const World& world);

    /// Returns whether every step must be recorded.
    [[nodiscard]] bool active() const { return trace_ || energy_; }
    /// Records the state after `step` steps of the loop: a game may restart its world meanwhile.
    void record(std::int64_t step, const World& world);
    /// Renames the temporary files to their final names. Without this call they are deleted.
    void commit();

private:
    void record_bodies(std::int64_t step, const World& world);
    void record_energy(std::int64_t step, const World& world);

    std::optional<File> trace_;
    std::optional<File> energy_;
    std::string row_;
};

}  // namespace oiler
