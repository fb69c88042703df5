// SPDX-License-Identifier: MIT
#include "oiler/certify/certify.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

using certify::Certificate;
using certify::certify;

constexpr std::int64_t steps = 50'000;

Certificate certificate_of(const Method& method) { return certify(method, method.damping, steps); }

class EachMethod : public testing::TestWithParam<Method> {};

TEST_P(EachMethod, IsWhatItsTableClaims) {
    const Certificate certificate = certificate_of(GetParam());
    for (const std::string& failure : certificate.failures) ADD_FAILURE() << failure;
    EXPECT_GE(certificate.orders.size(), 4U);
}

INSTANTIATE_TEST_SUITE_P(Certificate, EachMethod,
                         testing::ValuesIn(methods().begin(), methods().end()),
                         [](const auto& tested) { return std::string(tested.param.name); });

// With damping in the kicks, all splittings claim order 1 on the damped spring.
TEST(Certificate, HoldsForDampingInTheKicks) {
    for (const char* name : {"velocity_verlet", "forest_ruth4", "kahan_li8_kdk"}) {
        const Certificate certificate = certify(find_method(name), Damping::in_kick, steps);
        for (const std::string& failure : certificate.failures) ADD_FAILURE() << failure;
    }
}

/// Expects the certificate to have a failure that contains `reason`.
void expect_failure(const Method& method, const std::string& reason) {
    const Certificate certificate = certificate_of(method);
    const auto& failures = certificate.failures;
    EXPECT_TRUE(std::any_of(
        failures.begin(), failures.end(),
        [&](const std::string& failure) { return failure.find(reason) != std::string::npos; }))
        << method.name << testing::PrintToString(failures);
}

Method with_rule(const char* name, const decltype(Method::rule)& rule) {
    Method method = find_method(name);
    method.rule = rule;
    return method;
}

// PEFRL with the sign of one kick reversed.
TEST(BrokenTable, WithAWrongSignFails) {
    const auto k = [](long double c) { return Stage{Move::kick, c}; };
    const auto d = [](long double c) { return Stage{Move::drift, c}; };
    const Method broken =
        with_rule("pefrl", Splitting::palindrome({d(0.1786178958448091L), k(0.7123418310626054L),
                                                  d(-0.06626458266981849L), k(0.2123418310626054L),
                                                  d(0.77529337365001878L)}));
    expect_failure(broken, "spring in long double: positions fall as dt^0.0");
    expect_failure(broken, "orbit in double");
}

// Ruth's third order with its first two kicks swapped.
TEST(BrokenTable, WithASwappedPairFails) {
    const Method broken = with_rule("ruth3", Splitting{{Move::kick, 3 / 4.0L},
                                                       {Move::drift, 2 / 3.0L},
                                                       {Move::kick, 7 / 24.0L},
                                                       {Move::drift, -2 / 3.0L},
                                                       {Move::kick, -1 / 24.0L},
                                                       {Move::drift, 1}});
    expect_failure(broken, "spring in long double: positions fall as dt^1.0");
}

// Forest and Ruth's outer drifts cut to six digits.
TEST(BrokenTable, WithATruncatedCoefficientFails) {
    const auto k = [](long double c) { return Stage{Move::kick, c}; };
    const auto d = [](long double c) { return Stage{Move::drift, c}; };
    const Method broken =
        with_rule("forest_ruth4",
                  Splitting::palindrome({d(0.675603L), k(1.351207191959657634L),
                                         d(-0.17560359597982881702L), k(-1.702414383919315268L)}));
    expect_failure(broken, "claimed 4");
}

// Swapped weights of a tableau keep their sum.
TEST(BrokenTable, OfRungeAndKuttaFails) {
    const Method broken = with_rule("rk4", Tableau{{{1 / 2.0L}, {0, 1 / 2.0L}, {0, 0, 1}},
                                                   {1 / 3.0L, 1 / 6.0L, 1 / 3.0L, 1 / 6.0L},
                                                   {0, 1 / 2.0L, 1 / 2.0L, 1}});
    expect_failure(broken, "positions fall as dt^");
}

TEST(FalseClaim, OfBeingSymplecticFails) {
    Method claims = find_method("rk4");
    claims.symplectic = true;
    expect_failure(claims, "claimed symplectic, but the defect is");
    expect_failure(claims, "energy grows by");
}

TEST(FalseClaim, OfNotBeingSymplecticFails) {
    Method claims = find_method("velocity_verlet");
    claims.symplectic = false;
    expect_failure(claims, "claimed not symplectic");
}

TEST(FalseClaim, OfSymmetryFails) {
    Method claims = find_method("mclachlan_atela5");
    claims.symmetric = true;
    expect_failure(claims, "claimed symmetric, but the defect is");
}

TEST(FalseClaim, OfAnotherOrderFails) {
    Method claims = find_method("rk3_kutta");
    claims.order = 4;
    expect_failure(claims, "claimed 4");
    claims.order = 2;
    expect_failure(claims, "claimed 2");
}

TEST(FalseClaim, OfFewerEvaluationsFails) {
    Method claims = find_method("position_verlet");
    claims.evaluations = 2;
    expect_failure(claims, "1.000 force evaluations per step, claimed 2");
}

// A published "SymplecticEuler" was plain explicit Euler.
TEST(FalseClaim, OfExplicitEulerToBeSemiImplicitFails) {
    expect_failure(with_rule("semi_implicit_euler", find_method("explicit_euler").rule),
                   "claimed symplectic");
}

}  // namespace
}  // namespace oiler::test
