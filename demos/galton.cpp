// SPDX-License-Identifier: MIT
// A Galton board: 200 balls fall through ten rows of pegs into bins. Lines show the binomial law,
// which holds for balls that pass each row left or right of one peg, with equal chances. The balls
// bounce off several, and do not meet each other: their bell is some 4 % wider. With a restitution
// of 0.6 instead of 0.7 it is a third wider, from 60 to 240 Hz. The more often a peg was hit, the
// bluer it is.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "oiler/oiler.hpp"

using namespace oiler;

namespace {

constexpr int rows = 10, balls = 200, bins = 13;
constexpr double across = 0.5, down = 0.45;             // m, from peg to peg
constexpr double peg = 0.13, radius = 0.1, top = 6.75;  // m
constexpr double wall = 2.3;                            // m, the height of the bins
constexpr double ball_height = 0.036;                   // m, of a ball in a bin
constexpr double law = across * 1.5811388300841897;     // m, the deviation: √10/2 bins

double middle(std::size_t bin) { return across * (double(bin) - bins / 2); }

/// The share of balls that the binomial law expects in a bin; the outer bins are beyond it.
double expected(std::size_t bin) {
    if (bin == 0 || bin == bins - 1) return 0;
    double share = std::pow(0.5, rows);
    for (std::size_t i = 1; i < bin; ++i) share *= double(rows + 1 - i) / double(i);
    return share;
}

struct Ball {
    void hash(StateHash&) const {}
};
struct Drop {
    int left;
    void hash(StateHash& hash) const { hash.add(left); }
};

}  // namespace

struct Galton {
    static constexpr About about{.name = "galton",
                                 .title = "A Galton board: do 200 balls follow the bell?",
                                 .rate = 120,
                                 .method = "velocity_verlet",
                                 .duration = 32};
    World world;
    std::array<int, bins> counts{};
    std::unordered_map<ObstacleHandle, int> hits;  // of each peg

    explicit Galton(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -9.81});
        for (int row = 0; row < rows; ++row)
            for (double x = row % 2 ? -2.75 : -3; x < 3.1; x += across)
                hits[world.add_obstacle(
                    {.shape = CircleShape{{x, top - down * row}, peg}, .restitution = 0.7})] = 0;
        for (double x = -2.75; x < 3; x += across)
            world.add_obstacle({.shape = SegmentShape{{x, 0}, {x, wall}}});
        for (const double x : {-3.25, 3.25})
            world.add_obstacle({.shape = SegmentShape{{x, 0}, {x, top + 1}}, .restitution = 0.7});
        world.add_plane({.normal = {0, 1}});
        world.schedule(0, Drop{balls});
    }
    void hash(StateHash& hash) const { hash.add(counts); }

    int count() const {
        int sum = 0;
        for (const int one : counts) sum += one;
        return sum;
    }
    /// The root of the mean square of the distance from the middle, m.
    double deviation() const {
        double sum = 0;
        for (std::size_t bin = 0; bin < bins; ++bin) sum += counts[bin] * middle(bin) * middle(bin);
        return std::sqrt(sum / std::max(count(), 1));
    }
    std::vector<Reading> readings() const {
        return {{"balls", double(count())}, {"deviation", deviation(), "m"}};
    }

    void update(const Input&) {
        for (const Impact& impact : world.impacts())
            if (const auto hit = hits.find(impact.obstacle); hit != hits.end()) ++hit->second;
        world.due<Drop>([&](Drop drop) {
            const Vec3 at{world.random().uniform(-0.01, 0.01), top + 0.7};
            const Entity ball = world.spawn(Body{.position = at, .contact = Contact{radius}});
            world.add(ball, Ball{});
            world.add(ball, Look{.size = float(radius), .colour = palette::orange});
            if (drop.left > 1) world.schedule(0.1, Drop{drop.left - 1});
        });
        world.each_body<Ball>([&](Entity ball, Moving moving, Ball&) {
            const Vec3 at = moving.position();
            const double bin = std::clamp(std::round(at[0] / across) + bins / 2, 0.0, bins - 1.0);
            int& in_bin = counts[std::size_t(bin)];
            if (at[1] > std::min(in_bin * ball_height, wall) + radius) return;
            ++in_bin;
            world.destroy(ball);
        });
    }

    Picture picture() const {
        ObstacleColours colours;
        for (const auto& [handle, count] : hits)
            colours[handle] = palette::mix(palette::pale, palette::sky_blue,
                                           std::min(1.0F, float(count) / float(3 * balls)));
        Picture picture = draw_looks(world, {.centre = {0, 3.8F}, .height = 8.6F}, colours);
        const auto text = [&](Point at, std::string words, float size, Space space) {
            picture.labels.push_back({.at = at,
                                      .text = std::move(words),
                                      .size = size,
                                      .colour = palette::ink,
                                      .align = space == Space::world ? Align::centre : Align::left,
                                      .space = space});
        };
        for (std::size_t bin = 0; bin < bins; ++bin) {
            const double x = middle(bin), half = across / 2;
            const double high = ball_height * counts[bin];
            const double law_high = ball_height * count() * expected(bin);
            if (counts[bin] > 0)
                picture.polygons.push_back(
                    {.points = rectangle(to_point({x, high / 2}), to_point({2 * half - 0.1, high})),
                     .colour = palette::orange});
            picture.polylines.push_back(
                {.points = {to_point({x - half, law_high}), to_point({x + half, law_high})},
                 .width = 2,
                 .colour = palette::blue});
            text(to_point({x, -0.3}), fmt::format("{}", counts[bin]), 9, Space::world);
        }
        text({14, 330}, fmt::format("{} balls of {}", count(), balls), 14, Space::upper_left);
        text({14, 308}, fmt::format("deviation {:.2f} m", deviation()), 11, Space::upper_left);
        text({14, 294}, fmt::format("binomial law {:.2f} m (blue)", law), 11, Space::upper_left);
        return picture;
    }
};

int main(int argc, char** argv) { return run<Galton>(argc, argv); }
