// SPDX-License-Identifier: MIT
#include "oiler/app/trace_writer.hpp"

#include <fmt/core.h>

#include <iterator>
#include <string_view>

#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

std::string trace_header(int axes) {
    std::string header = "tick,time,body";
    for (const std::string_view prefix : {",", ",v"})
        for (int i = 0; i < axes; ++i)
            header.append(prefix).push_back(axis_names[static_cast<std::size_t>(i)]);
    return header + "\n";
}

void append_number(std::string& row, double value, Precision precision) {
    if (precision == Precision::single)
        fmt::format_to(std::back_inserter(row), ",{}", static_cast<float>(value));
    else
        fmt::format_to(std::back_inserter(row), ",{}", value);
}

}  // namespace

TraceWriter::TraceWriter(const std::filesystem::path& trace, const std::filesystem::path& energy,
                         const World& world) {
    if (!trace.empty()) trace_.emplace(trace, kinds::trace).write(trace_header(world.axes()));
    if (!energy.empty())
        energy_.emplace(energy, kinds::energy).write("tick,time,kinetic,potential,total\n");
    write(0, world);
}

void TraceWriter::write(std::int64_t step, const World& world) {
    if (trace_) write_bodies(step, world);
    if (energy_) write_energy(step, world);
}

void TraceWriter::write_bodies(std::int64_t step, const World& world) {
    const double time = world.settings().stepping.rate.time(step);
    const Bodies& bodies = world.bodies();
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        row_.clear();
        fmt::format_to(std::back_inserter(row_), "{},{},{}", step, time,
                       world.entity_of_row(row).index);
        for (const Vec3& vector : {bodies.position(row), bodies.velocity(row)})
            for (int i = 0; i < bodies.axes(); ++i)
                append_number(row_, vector[i], bodies.precision());
        row_.push_back('\n');
        trace_->write(row_);
    }
}

void TraceWriter::write_energy(std::int64_t step, const World& world) {
    const Energy energy = world.energy();
    world.require_finite(energy);
    energy_->write(fmt::format("{},{},{},{},{}\n", step, world.settings().stepping.rate.time(step),
                               energy.kinetic, energy.potential, energy.total()));
}

void TraceWriter::commit() {
    if (trace_) trace_->commit();
    if (energy_) energy_->commit();
}

}  // namespace oiler
