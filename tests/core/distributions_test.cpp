// Quantiles and probabilities against published tables and closed forms.
#include "core/distributions.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace scanbench {
namespace {

TEST(Distributions, QuantilesOfChiSquareAreThoseOfPublishedTables) {
  EXPECT_NEAR(chi_square_quantile(0.975, 2), -2 * std::log(0.025), 1e-12);
  EXPECT_NEAR(chi_square_quantile(0.025, 2), -2 * std::log(0.975), 1e-13);
  EXPECT_NEAR(chi_square_quantile(0.025, 20), 9.59078, 1e-5);
  EXPECT_NEAR(chi_square_quantile(0.975, 20), 34.16961, 1e-5);
  EXPECT_NEAR(chi_square_quantile(0.025, 100), 74.22193, 1e-5);
  EXPECT_NEAR(chi_square_quantile(0.975, 100), 129.56120, 1e-5);
  // For many degrees of freedom nu: nu (1 - 2 / (9 nu) + z sqrt(2 / (9 nu)))^3 (Wilson & Hilferty).
  const double nu = 2e5;
  const double z = 1.959963985;
  EXPECT_NEAR(chi_square_quantile(0.975, 200000), nu * std::pow(1 - 2 / (9 * nu) + z * std::sqrt(2 / (9 * nu)), 3),
              0.1);
}

TEST(Distributions, QuantilesOfStudentAndNormalAreThoseOfPublishedTables) {
  EXPECT_NEAR(student_quantile(0.975, 1), std::tan(0.475 * 3.14159265358979), 1e-9);  // Cauchy
  EXPECT_NEAR(student_quantile(0.975, 10), 2.228139, 1e-6);
  EXPECT_NEAR(student_quantile(0.025, 10), -2.228139, 1e-6);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963985, 1e-9);
  EXPECT_NEAR(normal_probability(1.0), 0.5 * (1 + std::erf(std::sqrt(0.5))), 1e-14);
}

TEST(Distributions, TwoSidedProbabilitiesDoNotDependOnTheSign) {
  EXPECT_NEAR(normal_two_sided(-1.959963985), 0.05, 1e-9);
  EXPECT_NEAR(student_two_sided(-2.228139, 10), 0.05, 1e-6);
  EXPECT_EQ(student_two_sided(1.0, 1), student_two_sided(-1.0, 1));
  EXPECT_NEAR(student_two_sided(1.0, 1), 0.5, 1e-12);
}

TEST(Distributions, BoundsOfASharePutTheTailOnWhatWasObserved) {
  // No success in n trials: (1 - p)^n = tail at the upper bound.
  EXPECT_EQ(share_lower_bound(20, 0, 0.025), 0.0);
  EXPECT_NEAR(std::pow(1 - share_upper_bound(20, 0, 0.025), 20), 0.025, 1e-10);
  EXPECT_EQ(share_upper_bound(20, 20, 0.025), 1.0);
  EXPECT_NEAR(std::pow(share_lower_bound(20, 20, 0.025), 20), 0.025, 1e-10);
}

}  // namespace
}  // namespace scanbench
