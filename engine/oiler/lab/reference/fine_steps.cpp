// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "oiler/lab/reference/parts.hpp"

namespace oiler::lab {
namespace {

using Real = long double;

constexpr std::size_t fewest_runs = 3;
/// Of extrapolations from a run: each takes another power of dt out of its error.
constexpr std::size_t most_columns = 4;
/// Halvings in a row that gained nothing, after which round-off or chaos is what is left.
constexpr int most_vain_runs = 2;
constexpr double least_wanted = 1e-12;  ///< of the extent

bool is_damped_along_lines(const Scene& scene) {
    const auto drags = [](const SceneMatter& matter) { return matter.quadratic_drag > 0; };
    for (const SceneBody& body : scene.bodies)
        if (drags(body.matter)) return true;
    for (const SceneScatter& scatter : scene.scatters)
        if (drags(scatter.matter)) return true;
    for (const SceneGrid& grid : scene.grids)
        if (drags(grid.matter) || grid.damping > 0) return true;
    for (const SceneSpring& spring : scene.springs)
        if (spring.damping > 0 && (spring.to || spring.rest_length > 0)) return true;
    return false;
}

/// Of the highest order that a method keeps on the scene, with a small error of that order.
const Method& finest_method(const Scene& scene) {
    return find_method(is_damped_along_lines(scene) ? "rk4" : "kahan_li8_kdk");
}

/// fine + (fine − coarse)/divisor
Track extrapolated(const Track& fine, const Track& coarse, Real divisor) {
    Track better = fine;
    for (std::size_t i = 0; i < better.states.size(); ++i) {
        const State<Real, 3>& a = fine.states[i];
        const State<Real, 3>& b = coarse.states[i];
        better.states[i] = {a.x + (a.x - b.x) * (1 / divisor), a.v + (a.v - b.v) * (1 / divisor)};
    }
    for (std::size_t i = 0; i < better.energies.size(); ++i)
        better.energies[i] +=
            (fine.energies[i] - coarse.energies[i]) / static_cast<double>(divisor);
    return better;
}

/// How far two tracks are apart up to each look; energies in J.
std::vector<Doubt> differences(const Track& a, const Track& b) {
    std::vector<Doubt> doubts;
    Doubt most;
    for (std::size_t look = 0; look < a.energies.size(); ++look) {
        for (std::size_t i = look * a.bodies; i < (look + 1) * a.bodies; ++i) {
            most.position = larger(most.position, distance(a.states[i].x, b.states[i].x));
            most.velocity = larger(most.velocity, distance(a.states[i].v, b.states[i].v));
        }
        most.energy = larger(most.energy, std::abs(a.energies[look] - b.energies[look]));
        doubts.push_back(most);
    }
    return doubts;
}

/// What rounding to long double leaves, below which no difference is believed: of where bodies are,
/// and of the time that passed, since dt and the method's coefficients are rounded alike in all
/// runs.
void add_rounding(std::vector<Doubt>& doubts, const Track& track, const Looks& looks) {
    constexpr auto epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
    double x = 0;
    double v = 0;
    for (const State<Real, 3>& state : track.states) {
        x = std::max(x, static_cast<double>(largest(state.x)));
        v = std::max(v, static_cast<double>(largest(state.v)));
    }
    for (std::size_t look = 0; look < doubts.size(); ++look) {
        const double way = v * looks.time(static_cast<std::int64_t>(look));
        doubts[look].position += 4 * epsilon * (2 * x + way);
        doubts[look].velocity += 4 * epsilon * v * (2 + (x > 0 ? way / x : 0));
    }
}

/// Romberg's table of runs, each of half the step of the one before.
class Table {
public:
    Table(const Scene& scene, const Looks& looks, const ReferenceEffort& effort)
        : scene_(scene), looks_(looks), effort_(effort), method_(finest_method(scene)) {}

    /// False where the run diverged or was stopped: then the table is as empty as at the start.
    bool add_run(std::int64_t rate) {
        std::optional<Track> run = this->run(rate);
        if (!run) {
            row_.clear();
            return false;
        }
        std::vector<Track> row{std::move(*run)};
        for (std::size_t k = 0; k < std::min(row_.size(), most_columns - 1); ++k)
            row.push_back(extrapolated(row[k], row_[k], std::exp2(Real(power(k))) - 1));
        before_ = row_.empty() ? std::nullopt : std::optional(std::move(row_.back()));
        row_ = std::move(row);
        ++runs_;
        return true;
    }
    [[nodiscard]] bool has_doubts() const { return row_.size() >= 2 && runs_ >= fewest_runs; }
    [[nodiscard]] const Track& best() const { return row_.back(); }
    [[nodiscard]] const Track& finest_run() const { return row_.front(); }
    [[nodiscard]] std::vector<Doubt> doubts() const {
        std::vector<Doubt> doubts = differences(best(), *before_);
        add_rounding(doubts, best(), looks_);
        return doubts;
    }
    [[nodiscard]] const Method& method() const { return method_; }

private:
    /// Of dt, in the error of the kth column.
    [[nodiscard]] int power(std::size_t k) const {
        return method_.order + static_cast<int>(k) * (method_.symmetric ? 2 : 1);
    }
    [[nodiscard]] std::optional<Track> run(std::int64_t rate) const {
        Follower follower(scene_, Settings{{&method_, {rate}, Precision::extended}},
                          looks_.per_second);
        Track track{.bodies = follower.bodies().size()};
        for (std::int64_t look = 0; look < looks_.count; ++look) {
            if (effort_.stopped() || !follower.go_to(look)) return std::nullopt;
            for (std::size_t row = 0; row < track.bodies; ++row)
                track.states.push_back(follower.state(row));
            track.energies.push_back(follower.energy());
            if (!std::isfinite(track.energies.back())) return std::nullopt;
        }
        return track;
    }

    const Scene& scene_;
    const Looks& looks_;
    const ReferenceEffort& effort_;
    const Method& method_;
    std::vector<Track> row_;
    std::optional<Track> before_{};  ///< the best of twice the step
    std::size_t runs_ = 0;
};

std::int64_t count_within(const std::vector<Doubt>& doubts, double most) {
    return std::count_if(doubts.begin(), doubts.end(),
                         [&](const Doubt& doubt) { return doubt.position <= most; });
}

}  // namespace

FineSteps fine_steps(const Scene& scene, const Looks& looks, const ReferenceEffort& effort) {
    Table table(scene, looks, effort);
    const double work_per_step = Work(scene).per_step(table.method());
    FineSteps finest;
    bool affordable = false;
    std::int64_t most_good = -1;
    int vain = 0;
    for (std::int64_t rate = looks.per_second; vain < most_vain_runs; rate *= 2) {
        const double work = work_per_step * static_cast<double>(rate) * looks.time(looks.count - 1);
        if (work > effort.most_work || effort.stopped()) break;
        affordable = true;
        if (!table.add_run(rate) || !table.has_doubts()) continue;
        effort.progress(work / effort.most_work);
        std::vector<Doubt> doubts = table.doubts();
        const double doubt = doubts.back().position;
        const double extent = extent_of(table.best());
        const std::int64_t good = count_within(doubts, resolution * extent / margin);
        const bool better = finest.doubts.empty() || good > most_good ||
                            (good == most_good && doubt < finest.doubts.back().position / 2);
        vain = better ? 0 : vain + 1;
        if (!better) continue;
        most_good = good;
        finest = {
            .track = table.best(),
            .doubts = std::move(doubts),
            .words = fmt::format(
                "the scene in long double by {} at {} Hz, extrapolated from runs at that "
                "rate, its half and so on; where halving still moves it by {:.2g} m at the end",
                table.method().name, rate, doubt),
            .finest_run = table.finest_run(),
            .method = &table.method(),
            .rate = rate};
        // A loose wish is no reason to take a scene for chaotic.
        const double wanted = effort.wanted > 0
                                  ? std::min(effort.wanted, resolution * extent / margin)
                                  : least_wanted * extent;
        if (doubt <= wanted) break;
    }
    finest.affordable = affordable;
    return finest;
}

}  // namespace oiler::lab
