// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace oiler::trap {

/// Random numbers of a seed, the same with every standard library.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}

    /// In [low, high).
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    double log_uniform(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    /// From low to high.
    int whole(int low, int high) {
        return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
    }
    bool chance(double share) { return uniform(0, 1) < share; }
    double sign() { return chance(0.5) ? 1 : -1; }

private:
    std::mt19937_64 engine_;
};

/// A scene file in the making.
struct Draft {
    int axes = 1;
    /// The largest useful duration, s: the run then has enough periods.
    double longest = 100;
    std::string text{};  ///< the tables after [scene]
    int bodies = 0;

    /// "[1.5, 0]" from as many numbers as axes.
    [[nodiscard]] std::string vector(const std::vector<double>& numbers) const;
    /// Adds a body b0, b1, … and returns its name.
    std::string body(double mass, const std::vector<double>& position,
                     const std::vector<double>& velocity, const std::string& more = "");
    void spring(const std::string& body, const std::vector<double>& anchor, double stiffness,
                double damping, double rest_length = 0);
    void link(const std::string& body, const std::string& to, double stiffness, double damping,
              double rest_length = 0);
    void gravity(double g);
    void attractor(const std::vector<double>& position, double gm);
    /// Limits the duration to so many periods of the frequency.
    void limit(double hertz, double periods = 2e4);
};

/// A kind of scene that advice may get wrong.
struct Kind {
    const char* name;
    void (*make)(Dice&, Draft&);
};

[[nodiscard]] std::span<const Kind> kinds();

}  // namespace oiler::trap
