// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "oiler/capture/file.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Writes CSV files after each step: a row per body (trace) and a row of energies. Numbers read
/// back to the same bits.
class TraceWriter {
public:
    /// Writes no file for an empty path. Writes the state at tick 0. Throws Error{io}.
    TraceWriter(const std::filesystem::path& trace, const std::filesystem::path& energy,
                const World& world);

    /// Whether every step is written.
    [[nodiscard]] bool active() const { return trace_ || energy_; }
    /// Writes the state after `step` steps of the loop; a restarted world counts its own anew.
    void write(std::int64_t step, const World& world);
    /// Renames the temporary files to their final names. Without this call they are deleted.
    void commit();

private:
    void write_bodies(std::int64_t step, const World& world);
    void write_energy(std::int64_t step, const World& world);

    std::optional<File> trace_;
    std::optional<File> energy_;
    std::string row_;
};

}  // namespace oiler
