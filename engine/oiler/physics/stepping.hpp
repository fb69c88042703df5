// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "oiler/physics/methods/methods.hpp"
#include "oiler/physics/rate.hpp"

namespace oiler {

class Json;

enum class Precision {
    single,
    double_,
    extended,  ///< long double: for references, not for games
};

/// "float" or "double", as in options and files, or "long double".
[[nodiscard]] std::string_view name_of(Precision precision);
/// The precision of that name, for games; empty if there is none.
[[nodiscard]] std::optional<Precision> find_precision(std::string_view name);

/// The setting of a run (method, rate, precision, damping), in games, scenes, options, manifests
/// and advice.
struct Stepping {
    const Method* method = &find_method("semi_implicit_euler");
    Rate rate{100};
    Precision precision = Precision::double_;
    std::optional<Damping> damping{};  ///< the method's default if absent

    friend bool operator==(const Stepping&, const Stepping&) = default;
};

/// Where the steps of a splitting put damping.
[[nodiscard]] Damping damping_of(const Stepping& stepping);
/// "kick" or "drift"; empty for the method's default.
[[nodiscard]] std::string_view damping_name(const Stepping& stepping);

/// "rk4 at 60 Hz in double, damping in the kick"; without damping if it is the method's default.
[[nodiscard]] std::string describe(const Stepping& stepping);
/// "rk4 at 60 Hz, double", beside a picture.
[[nodiscard]] std::string caption(const Stepping& stepping);
/// "rk4, 60 Hz, double, kick", in a table; without damping if it is the method's default.
[[nodiscard]] std::string table_text(const Stepping& stepping);
/// "60 Hz rk4".
[[nodiscard]] std::string short_text(const Stepping& stepping);
/// Method, rate and precision in which a setting differs from another one: "rk4", "120 Hz, float".
[[nodiscard]] std::string difference_text(const Stepping& stepping, const Stepping& from);

/// {"method", "rate", "precision", "damping"}; the damping is null for methods without a choice.
[[nodiscard]] Json to_json(const Stepping& stepping);

}  // namespace oiler
