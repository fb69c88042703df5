// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "oiler/capture/file.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Throws Error{diverged}: states may still be finite when their squares no longer are.
void require_finite(const Energy& energy);

/// Writes a row per body and a row of energies after each step, where asked to. Numbers read back
/// to the same bits.
class Recorder {
public:
    /// Empty paths record nothing. Writes the state at tick 0. Throws Error{io}.
    Recorder(const std::filesystem::path& trace, const std::filesystem::path& energy,
             const World& world);

    /// Somebody has to see every step.
    [[nodiscard]] bool active() const { return trace_ || energy_; }
    void record(const World& world);
    /// Gives the files their names; without it none is left.
    void commit();

private:
    void record_bodies(const World& world);
    void record_energy(const World& world);

    std::optional<File> trace_;
    std::optional<File> energy_;
    std::string row_;
};

}  // namespace oiler
