// SPDX-License-Identifier: MIT
#include "oiler/app/report.hpp"

#include <cmath>

#include "oiler/core/json.hpp"
#include "oiler/core/state_hash.hpp"

namespace oiler {
namespace {

Json to_json(const Energy& energy) {
    return {
        {"kinetic", energy.kinetic}, {"potential", energy.potential}, {"total", energy.total()}};
}

double seconds(std::chrono::nanoseconds time) {
    return std::chrono::duration<double>(time).count();
}

}  // namespace

void write_report(File& file, const RunReport& report, const World& world) {
    const Settings& settings = world.settings();
    Json stepping = to_json(settings.stepping);
    Json json{{"scene", report.scene},
              {"method", stepping["method"]},
              {"damping", stepping["damping"]},
              {"rate", stepping["rate"]},
              {"precision", stepping["precision"]},
              {"threads", settings.threads},
              {"seed", settings.seed},
              {"steps", report.steps},
              {"time", settings.stepping.rate.time(report.steps)},
              {"bodies", world.body_count()},
              {"diverged", report.divergence.empty() ? Json() : Json(report.divergence)},
              {"state_hash", report.last ? Json(hash_text(report.state_hash)) : Json()},
              {"energy",
               {{"first", to_json(report.first)},
                {"last", report.last ? to_json(*report.last) : Json()}}},
              {"dropped_time", seconds(report.dropped)},
              {"wall_seconds", seconds(report.wall)}};
    for (const Reading& reading : report.readings) json["readings"][reading.name] = reading.value;
    for (const BudgetEntry& entry : report.budget) {
        json["budget"][entry.name] = {
            {"budget", entry.most},
            {"measured", std::isfinite(entry.measured) ? Json(entry.measured) : Json("infinite")},
            {"kept", entry.kept}};
        if (entry.is_limit()) json["budget"][entry.name]["is_limit"] = true;
    }
    file.write(json.dump(2) + "\n");
    file.commit();
}

}  // namespace oiler
