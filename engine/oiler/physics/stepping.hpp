// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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
/// The precision of a game that has such a name; empty if there is none.
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

/// The steps of a call: `count` steps from tick `first` on.
struct Steps {
    Rate rate;
    std::int64_t first = 0;
    std::int64_t count = 1;
    /// The method's default if absent.
    std::optional<Damping> damping{};
};

/// The place where a run was no longer finite, or an implicit step found no solution.
struct Divergence {
    enum class Of {
        position,
        velocity,
        solution,  ///< of an implicit method
        impacts    ///< more in a step than can be followed
    };

    std::int64_t tick;  ///< the first tick whose state is not finite
    std::size_t row;
    int axis;
    Of of;
};

/// Keeps the divergence with the smaller tick, then row; of one row that of a position, then axis.
void keep_earlier(std::optional<Divergence>& first, const std::optional<Divergence>& other);

/// Returns the number by which messages name the body in a row.
using NameOfRow = std::function<std::size_t(std::size_t)>;

/// "diverged at step 41 (t = 0.41 s): velocity x of body 0 is no longer finite"
[[nodiscard]] std::string describe(const Divergence& at, const Method& method, const Rate& rate,
                                   bool linked, const NameOfRow& name);

}  // namespace oiler
