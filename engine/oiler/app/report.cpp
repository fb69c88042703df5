// SPDX-License-Identifier: MIT
#include "oiler/app/report.hpp"

#include <cmath>
#include <span>

#include "oiler/app/recorder.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/core/json.hpp"
#include "oiler/core/state_hash.hpp"

namespace oiler {
namespace {

Json to_json(const Energy& energy) {
    require_finite(energy);
    return {
        {"kinetic", energy.kinetic}, {"potential", energy.potential}, {"total", energy.total()}};
}

double seconds(std::chrono::nanoseconds time) {
    return std::chrono::duration<double>(time).count();
}

}  // namespace

void write_report(const std::filesystem::path& path, const RunReport& report, const World& world) {
    const Settings& settings = world.settings();
    Json json{
        {"scene", report.scene},
        {"method", settings.stepping.method->name},
        {"damping", name_of(settings.stepping.damping.value_or(settings.stepping.method->damping))},
        {"rate", settings.stepping.rate.steps},
        {"precision", name_of(settings.stepping.precision)},
        {"threads", settings.threads},
        {"seed", settings.seed},
        {"steps", world.tick()},
        {"time", world.time()},
        {"bodies", world.bodies().size()},
        {"state_hash", hash_text(world.state_hash())},
        {"energy", {{"first", to_json(report.first)}, {"last", to_json(world.bodies().energy())}}},
        {"dropped_time", seconds(report.dropped)},
        {"wall_seconds", seconds(report.wall)}};
    for (const BudgetEntry& entry : report.budget)
        json["budget"][entry.name] = {
            {"budget", entry.most},
            {"measured", std::isfinite(entry.measured) ? Json(entry.measured) : Json("infinite")},
            {"kept", entry.kept}};
    const std::string text = json.dump(2) + "\n";
    write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace oiler
