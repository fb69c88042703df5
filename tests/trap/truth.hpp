// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "oiler/scene/scene.hpp"
#include "oiler/sim/bodies.hpp"
#include "trap/surfaces.hpp"

namespace oiler::trap {

/// Where the first sample inside a step lies, as a share of the distance between samples. It is
/// irrational, so that no oscillation meets all samples at the same phase.
inline constexpr Real first_sample = 0.618033988749894848204586834L;

/// Where sample `j` of a step with `inside` samples lies, as a share of the step; 0 is its start.
inline Real share_of(std::size_t j, std::size_t inside) {
    return j == 0 ? 0 : (static_cast<Real>(j - 1) + first_sample) / static_cast<Real>(inside);
}

/// The true motion of some bodies, computed without the engine.
class Motion {
public:
    Motion() = default;
    Motion(const Motion&) = delete;
    Motion& operator=(const Motion&) = delete;
    virtual ~Motion() = default;

    [[nodiscard]] virtual std::size_t size() const = 0;
    /// The shortest time in which the motion turns, s: a period, or that at the perihelion.
    [[nodiscard]] virtual Real shortest_period() const = 0;
    /// The cost of one sample of one body; 1 for a sum of three products.
    [[nodiscard]] virtual Real cost() const = 0;
    /// The largest error of a position, m, as far as it is measured.
    [[nodiscard]] virtual Real uncertainty() const { return 0; }
    /// Calls to `sample` take `inside` samples in steps of 1/rate s.
    virtual void prepare(std::int64_t rate, std::size_t inside) = 0;
    /// Writes the positions at (n + share_of(j, inside)) / rate, for j from 0 to `inside`: sample j
    /// of body i is out[i · (inside + 1) + j]. `n` must not decrease from call to call.
    virtual void sample(std::int64_t n, Point* out) = 0;
};

struct Wind {
    Point velocity{};  ///< m/s
    Real drag = 0;     ///< N·s²/m²
};

/// The force amplitude·sin(omega·t + phase).
struct Drive {
    Point amplitude{};  ///< N
    Real omega = 0;     ///< rad/s
    Real phase = 0;     ///< rad
};

struct CoupledBody {
    Real mass = 1;            ///< kg
    Real drag = 0;            ///< N·s/m
    Real quadratic_drag = 0;  ///< N·s²/m²
    Point x{};                ///< m, at the start
    Point v{};                ///< m/s, at the start
    std::vector<Wind> winds{};
    std::vector<Drive> drives{};
    std::optional<Real> contact{};  ///< m, the radius that meets surfaces
};

struct CoupledSpring {
    std::size_t body = 0;
    std::optional<std::size_t> to{};  ///< if absent, `anchor` holds
    Point anchor{};                   ///< m
    Real stiffness = 0;               ///< N/m
    Real damping = 0;                 ///< N·s/m
    Real rest_length = 0;             ///< m
};

struct Attractor {
    Point centre{};  ///< m
    Real gm = 0;     ///< m³/s²
};

/// Bodies with the forces on them and between them.
struct System {
    std::vector<CoupledBody> bodies{};
    std::vector<CoupledSpring> springs{};
    std::vector<Attractor> attractors{};
    Point gravity{};  ///< m/s²
    std::vector<Surface> surfaces{};

    [[nodiscard]] bool is_linear() const;
    /// Whether a body may meet a surface.
    [[nodiscard]] bool has_contacts() const;
    /// At most the shortest period of the springs without damping, s.
    [[nodiscard]] Real shortest_spring_period() const;
};

/// A body on an ellipse around one attractor, in closed form.
class Orbit : public Motion {
public:
    /// Throws std::domain_error if the orbit is not an ellipse.
    Orbit(const Point& centre, Real gm, const Point& x, const Point& v);

    [[nodiscard]] std::size_t size() const override { return 1; }
    [[nodiscard]] Real shortest_period() const override;
    [[nodiscard]] Real cost() const override { return 20; }
    void prepare(std::int64_t rate, std::size_t inside) override;
    void sample(std::int64_t n, Point* out) override;

    [[nodiscard]] Point at(Real t) const;
    [[nodiscard]] Real period() const { return period_; }

private:
    [[nodiscard]] Real turned(Real mean) const;

    Point centre_;
    Point d_;  ///< from the centre to the start
    Point v_;
    Real a_ = 0;       ///< semi-major axis, m
    Real e_ = 0;       ///< eccentricity
    Real e_cos_ = 0;   ///< e·cos E of the start
    Real e_sin_ = 0;   ///< e·sin E of the start
    Real period_ = 0;  ///< s
    std::int64_t rate_ = 1;
    std::size_t inside_ = 0;
};

/// The solution of u'' = f − c·u' − k·u: u(t) = xx·u(0) + xv·u'(0) + xf·f, and
/// u'(t) = vx·u(0) + vv·u'(0) + xv·f.
struct Flow {
    Real xx = 1;
    Real xv = 0;
    Real xf = 0;
    Real vx = 0;
    Real vv = 1;
};

/// k ≥ 0 in 1/s², c ≥ 0 in 1/s, t ≥ 0 in s: free, drag, under-, over- and critically damped.
[[nodiscard]] Flow flow(Real k, Real c, Real t);

/// A body on springs without rest length, with linear drag and gravity.
struct OscillatorBody {
    Real k = 0;      ///< 1/s², of all springs
    Real c = 0;      ///< 1/s, of dampers and drag
    Point centre{};  ///< m, where the springs balance
    Point f{};       ///< m/s²
    Point x{};       ///< m, at the start
    Point v{};       ///< m/s, at the start
};

/// Bodies that do not act on one another, each in closed form.
class Oscillators : public Motion {
public:
    void add(const OscillatorBody& body);

    [[nodiscard]] std::size_t size() const override { return bodies_.size(); }
    [[nodiscard]] Real shortest_period() const override;
    [[nodiscard]] Real cost() const override { return 1; }
    void prepare(std::int64_t rate, std::size_t inside) override;
    void sample(std::int64_t n, Point* out) override;

private:
    /// Bodies with equal k and c share their flows.
    struct Kind {
        Real k = 0;
        Real c = 0;
        Flow start{};                ///< from the start to the tick
        std::vector<Flow> inside{};  ///< from the tick to each sample
    };
    void sample_body(std::size_t i, Point* out) const;

    std::vector<OscillatorBody> bodies_;
    std::vector<std::size_t> kind_of_;
    std::vector<Kind> kinds_;
    std::map<std::pair<Real, Real>, std::size_t> known_;
    std::int64_t rate_ = 1;
};

using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// exp(a), by scaling, a Taylor series and squaring.
[[nodiscard]] Matrix exponential(const Matrix& a);

/// Bodies that springs without rest length couple, through the exponential of their matrix.
class LinearSystem : public Motion {
public:
    explicit LinearSystem(const System& system);

    [[nodiscard]] std::size_t size() const override { return bodies_; }
    [[nodiscard]] Real shortest_period() const override { return shortest_period_; }
    [[nodiscard]] Real cost() const override;
    void prepare(std::int64_t rate, std::size_t inside) override;
    void sample(std::int64_t n, Point* out) override;

private:
    void add_springs(const System& system);
    void jump_to(std::int64_t n);
    void write(const Matrix& state, Point* out, std::size_t stride) const;

    std::size_t bodies_;
    Real scale_;            ///< 1/s: positions are stored times it, beside velocities
    Real shortest_period_;  ///< s
    Matrix a_;              ///< of y' = a·y, y = (scale·x, v, 1) with a column per axis
    Matrix start_;
    Matrix state_;  ///< at tick_
    std::int64_t tick_ = 0;
    std::int64_t rate_ = 1;
    std::size_t inside_ = 0;
    std::map<int, Matrix> jumps_;  ///< by 2^key ticks
    Matrix to_first_;              ///< from a tick to its first sample
    Matrix between_;               ///< between samples
};

/// Integrates a system by collocation at Chebyshev's nodes, in segments whose length follows the
/// last coefficients of the accelerations. The positions are polynomials in each segment. Impacts,
/// lift-offs, stops and slips are roots of these polynomials, at which a segment ends.
class Integration : public Motion {
public:
    /// `tolerance` is relative to the distance travelled in a segment. Throws std::domain_error if
    /// the motion needs more than `most_segments`.
    Integration(const System& system, Real duration, Real tolerance, std::size_t most_segments);

    [[nodiscard]] std::size_t size() const override { return system_.bodies.size(); }
    [[nodiscard]] Real shortest_period() const override { return shortest_; }
    [[nodiscard]] Real cost() const override { return 12; }
    [[nodiscard]] Real uncertainty() const override { return uncertainty_; }
    void prepare(std::int64_t rate, std::size_t inside) override;
    void sample(std::int64_t n, Point* out) override;

    /// `t` must be within the duration.
    void positions(Real t, Point* out, std::size_t stride = 1) const;
    /// Compares with another integration of the system at many times.
    void compare_with(const Integration& other);

private:
    using Numbers = std::vector<Real>;
    struct Segment {
        Real start = 0;       ///< s
        Real length = 0;      ///< s
        Numbers positions{};  ///< Chebyshev coefficients, coordinate by coordinate
    };
    struct Nodes;

    /// What bears a body.
    struct Bearing {
        const Surface* surface = nullptr;
        Point direction{};  ///< of a slide with friction, at its start
        bool rests = false;

        [[nodiscard]] Point direction_at(const Point& normal) const;
    };
    /// A body on a surface.
    struct Touch {
        Point normal{};
        Point along{};   ///< m/s, the velocity relative to the surface, along it
        Real speed = 0;  ///< m/s, into the surface
        Real press = 0;  ///< m/s², what keeps the body on the surface
        Point pull{};    ///< m/s², along the surface
    };
    struct Event;
    struct Course;

    void accelerate(const Real* x, const Real* v, Real t, Real* a) const;
    void accelerate_on_surfaces(const Real* x, const Real* v, Real t, Real* a) const;
    void pull(const CoupledSpring& spring, const Real* x, const Real* v, Real* a) const;
    static void attract(const Attractor& one, const Real* x, Real* a);
    static void blow(const Wind& wind, Real mass, const Real* v, Real* a);
    void move(Real h, Nodes& at) const;
    [[nodiscard]] Real update(Real h, Nodes& at) const;
    [[nodiscard]] bool converge(Real h, Nodes& at) const;
    [[nodiscard]] Real error_of(Real h, const Nodes& at) const;
    void append(Real h, const Nodes& at);
    void go_on(Real h, Nodes& at);
    [[nodiscard]] Touch touch_of(std::size_t body, const Surface& surface, const Numbers& x,
                                 const Numbers& v, Real t) const;
    [[nodiscard]] Touch touch_of(std::size_t body, const Surface& surface, const Real* x,
                                 const Real* v, const Real* a, Real t) const;
    [[nodiscard]] Real before(const Event& event, const Numbers& x, const Numbers& v, Real t) const;
    [[nodiscard]] std::vector<Event> possible_events(std::size_t body) const;
    [[nodiscard]] std::optional<Real> time_of(const Event& event, const Course& course) const;
    [[nodiscard]] std::optional<Real> dip(const Event& event, const Course& course,
                                          std::size_t part) const;
    [[nodiscard]] std::optional<Event> first_event(const Course& course) const;
    [[nodiscard]] bool meet_first(Real h, Nodes& at);
    void meet(const Event& event, const Course& course, Nodes& at);
    void land(std::size_t body, const Surface& surface, Nodes& at);
    void cross_edge(std::size_t body, Nodes& at);
    void slide(std::size_t body, const Surface& surface, Nodes& at, bool slips = false);
    void start_on_surface(std::size_t body, Nodes& at);

    System system_;
    std::vector<Bearing> bearings_;
    Real now_ = 0;  ///< s, the start of the segment
    Real duration_;
    std::vector<Segment> segments_;
    Real shortest_ = 0;
    Real uncertainty_ = 0;
    std::int64_t rate_ = 1;
    std::size_t inside_ = 0;
};

/// The true motion of a scene: closed forms where they exist, otherwise an integration.
class Truth {
public:
    enum class From {
        best,         ///< closed forms where they exist
        matrix,       ///< the exponential of a matrix for all linear forces
        integration,  ///< an integration for all forces
    };
    /// Throws std::domain_error if the motion is too long or too unsteady to be computed.
    explicit Truth(const Scene& scene, From from = From::best, std::size_t most_segments = 20'000);

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] Real shortest_period() const;
    /// The cost of one sample of all bodies.
    [[nodiscard]] Real cost() const;
    /// The error of the integrations, m.
    [[nodiscard]] Real uncertainty() const;
    /// As for Motion; the samples are those of the rows of the world.
    void prepare(std::int64_t rate, std::size_t inside);
    [[nodiscard]] const std::vector<Point>& sample(std::int64_t n);
    /// The largest distance of a body from its start, m.
    [[nodiscard]] Real extent(Real duration);

private:
    struct Part {
        std::unique_ptr<Motion> motion;
        std::vector<std::size_t> rows;
    };
    void add(const System& system, const std::vector<std::size_t>& rows, Real duration, From from);
    void add_integration(const System& system, const std::vector<std::size_t>& rows, Real duration);

    std::size_t size_ = 0;
    std::size_t most_segments_;  ///< of an integration
    std::vector<Part> parts_;
    std::vector<Point> buffer_;
    std::vector<Point> samples_;
    std::size_t inside_ = 0;
};

/// Compares the true motions with one another on random scenes, and with reference numbers of
/// tests/data. Prints the largest differences; returns whether all are small.
[[nodiscard]] bool self_check(std::uint64_t seed);

}  // namespace oiler::trap
