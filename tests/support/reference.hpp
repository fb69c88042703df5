// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

/// The `values` of a reference file in tests/data.
inline nlohmann::json reference(const std::string& name) {
    std::ifstream file(std::string(OILER_TEST_DATA) + "/" + name + ".json");
    return nlohmann::json::parse(file).at("values");
}

/// A number of the reference files, which store text to keep all digits.
template <class T = double>
T number(const nlohmann::json& text) {
    return static_cast<T>(std::strtold(text.get_ref<const std::string&>().c_str(), nullptr));
}

/// The engine's name for a splitting of the reference files.
inline std::string method_named(const std::string& reference_name) {
    if (reference_name == "semi_implicit_euler_kd") return "semi_implicit_euler";
    if (reference_name == "semi_implicit_euler_dk") return "semi_implicit_euler_drift_kick";
    if (reference_name == "verlet_velocity_kdk") return "velocity_verlet";
    if (reference_name == "verlet_position_dkd") return "position_verlet";
    return reference_name;
}
