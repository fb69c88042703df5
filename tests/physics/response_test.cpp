// SPDX-License-Identifier: MIT
#include "oiler/physics/response.hpp"

#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

template <class T>
class OscillatorResponse : public testing::Test {};
using Precisions = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(OscillatorResponse, Precisions);

/// The distance between neighbouring numbers of T at |x|.
template <class T>
T unit_at(T x) {
    using Limits = std::numeric_limits<T>;
    const int exponent = x == 0 ? Limits::min_exponent : std::ilogb(x);
    return std::ldexp(T(1), std::max(exponent, Limits::min_exponent - 1) - Limits::digits + 1);
}

/// The error of a cancelled sum of size 1: nearly twice the digits of double, also for float.
constexpr long double remnant = 0x1p-100L;

/// The entries whose k, c and t are numbers of T.
template <class T>
std::vector<nlohmann::json> entries_for() {
    std::vector<nlohmann::json> entries;
    for (const auto& entry : reference("oscillator_response"))
        if (entry.value("digits", 24) <= std::numeric_limits<T>::digits) entries.push_back(entry);
    return entries;
}

template <class T>
Response<T> response_of(const nlohmann::json& entry) {
    return oscillator_response(number<T>(entry.at("k")), number<T>(entry.at("c")),
                               number<T>(entry.at("t")));
}

// The error is at most one unit of T; the reference is rounded to T. If decay or the remaining
// acceleration, 1 − k·sway, is a small difference of larger numbers, the error is relative to
// those.
TYPED_TEST(OscillatorResponse, IsRightToTheLastDigit) {
    const auto entries = entries_for<TypeParam>();
    ASSERT_GE(entries.size(), 49U);
    for (const auto& entry : entries) {
        SCOPED_TRACE(entry.at("name"));
        const Response<TypeParam> response = response_of<TypeParam>(entry);
        const auto expect = [&](TypeParam value, const char* name, long double size) {
            const auto expected = number<TypeParam>(entry.at(name));
            const long double slack = entry.contains("cancels") ? remnant * size : 0;
            EXPECT_LE(std::abs(value - expected), unit_at(expected) + slack) << name;
        };
        const auto t = number<long double>(entry.at("t"));
        expect(response.reach, "reach", std::abs(t));
        expect(response.sway, "sway", t * t);
        expect(response.decay, "decay", 1);
    }
}

TYPED_TEST(OscillatorResponse, OfNoTimeIsNoMove) {
    for (const TypeParam k : {-1.0F, 0.0F, 15.0F, 1e12F})
        for (const TypeParam c : {-1.0F, 0.0F, 0.1F, 1e12F}) {
            const auto response = oscillator_response<TypeParam>(k, c, 0);
            EXPECT_EQ(response.reach, 0);
            EXPECT_EQ(response.sway, 0);
            EXPECT_EQ(response.decay, 1);
        }
}

TYPED_TEST(OscillatorResponse, WithoutForcesIsTimeToTheLastBit) {
    for (const TypeParam t : {TypeParam(1) / 60, TypeParam(-0.3), TypeParam(1e9)}) {
        const auto response = oscillator_response<TypeParam>(0, 0, t);
        EXPECT_EQ(response.reach, t);
        EXPECT_EQ(response.sway, t * t / 2);
        EXPECT_EQ(response.decay, 1);
    }
}

// A unit of time twice as long changes exponents only.
TYPED_TEST(OscillatorResponse, DependsOnNoUnitOfTime) {
    for (const auto& entry : entries_for<TypeParam>()) {
        const auto k = number<TypeParam>(entry.at("k"));
        const auto c = number<TypeParam>(entry.at("c"));
        const auto t = number<TypeParam>(entry.at("t"));
        const auto one = oscillator_response(k, c, t);
        const auto other = oscillator_response(4 * k, 2 * c, t / 2);
        EXPECT_EQ(other.reach, one.reach / 2) << entry.at("name");
        EXPECT_EQ(other.sway, one.sway / 4) << entry.at("name");
        EXPECT_EQ(other.decay, one.decay) << entry.at("name");
    }
}

/// A sum and its tolerance: each term has a few factors with an error of one round-off.
template <class T>
struct Sum {
    T value = 0;
    T slack = 0;

    Sum(std::initializer_list<T> terms) {
        for (const T term : terms) {
            value += term;
            slack += 8 * std::numeric_limits<T>::epsilon() * std::abs(term);
        }
    }
};

/// Compares the response over t1, continued over t2, with that over t1 + t2. After t1, u is r1 (s1
/// for a), u' is d1 (r1), and the acceleration is −k·r1 (1 − k·s1).
template <class T>
void expect_semigroup(T k, T c, T t1, T t2) {
    const auto [r1, s1, d1] = oscillator_response(k, c, t1);
    const auto [r2, s2, d2] = oscillator_response(k, c, t2);
    const auto both = oscillator_response(k, c, t1 + t2);
    const auto expect = [](T value, const Sum<T>& sum) {
        EXPECT_LE(std::abs(value - sum.value), sum.slack + unit_at(value) + remnant);
    };
    expect(both.reach, {r1, d1 * r2, -k * r1 * s2});
    expect(both.reach, {r1 * d2, r2, -k * s1 * r2});
    expect(both.sway, {s1, r1 * r2, s2, -k * s1 * s2});
    expect(both.decay, {d1 * d2, -k * r1 * r2});
}

// All times are binary fractions, so that their sums are exact. Backwards in time, only dampings
// that grow to at most e^25 are tested.
TYPED_TEST(OscillatorResponse, IsASemigroup) {
    for (const float k : {0.0F, 1e-6F, 0.3F, 15.0F, 4e4F, 1e8F})
        for (const float c : {0.0F, 1e-6F, 0.1F, 2 * std::sqrt(15.0F), 50.0F, 400.0F, 1e8F})
            for (const float t1 : {1 / 1024.0F, 0.4375F, 3.0F})
                for (const float t2 : {1 / 1024.0F, 0.625F, -1 / 64.0F, -0.4375F}) {
                    if (t2 < 0 && c * -t2 > 25) continue;
                    SCOPED_TRACE(testing::Message() << k << " " << c << " " << t1 << " " << t2);
                    expect_semigroup<TypeParam>(k, c, t1, t2);
                }
}

// The integral of the equation from u' = 1 is decay − 1 = −c·reach − k·sway.
TYPED_TEST(OscillatorResponse, SolvesItsEquation) {
    for (const auto& entry : entries_for<TypeParam>()) {
        const auto [reach, sway, decay] = response_of<TypeParam>(entry);
        const auto k = number<TypeParam>(entry.at("k"));
        const auto c = number<TypeParam>(entry.at("c"));
        const Sum<TypeParam> left{decay, c * reach, k * sway};
        EXPECT_LE(std::abs(left.value - 1), left.slack) << entry.at("name");
    }
}

// e^1000 is finite in long double only, e^20000 in no type.
TEST(OscillatorResponse, IsNotFiniteWhereTheResultOverflows) {
    EXPECT_FALSE(std::isfinite(oscillator_response<float>(0, -1000, 1).decay));
    EXPECT_FALSE(std::isfinite(oscillator_response<double>(0, 1000, -1).decay));
    const long double decay = oscillator_response<long double>(0, -1000, 1).decay;
    EXPECT_NEAR(static_cast<double>(std::log(decay)), 1000, 1e-12);
    EXPECT_FALSE(std::isfinite(oscillator_response<long double>(0, -20000, 1).decay));
}

}  // namespace
}  // namespace oiler::test
