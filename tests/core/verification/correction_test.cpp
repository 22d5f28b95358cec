// SPDX-License-Identifier: GPL-3.0-or-later
// Cost parameters corrected by the errors that siblings have shown.
#include "core/results/field_difference.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/verification/correction.hpp"
#include "core/verification/verify.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::correction_test {
namespace {

/// The small hemisphere, one ply; wanted: degrees.
PreparedCase small_hemisphere(double wanted, std::vector<Override> overrides = {}) {
  overrides.insert(overrides.end(),
                   {{"ply", "[{name='ply1', fabric='glass', blank='square', angle=20}]"},
                    {"tool.0.position", "[0, 0, 45.6]"},
                    {"tool.2.position", "[0, 0, 0.6]"},
                    {"accuracy.shear_deg", std::to_string(wanted)}});
  PreparedCase prepared = prepare_case(PLYFORM_CASES "/verify/hemisphere.toml", overrides);
  EXPECT_TRUE(prepared.value);
  return prepared;
}

/// A verification with these errors of the shear, degrees.
Verification with_errors(double mesh, double inertia, double softening, double chance = 0.0) {
  Verification v;
  v.shear.mesh = mesh, v.shear.inertia = inertia, v.shear.softening = softening;
  v.shear.chance = chance;
  return v;
}

TEST(Correction, LeavesARunThatKeepsWhatWasAskedFor) {
  const PreparedCase prepared = small_hemisphere(2.0);
  const CorrectedCase corrected = corrected_case(*prepared.value, with_errors(0.5, 0.5, 0.5), {});
  EXPECT_TRUE(corrected.asked.kept());
  EXPECT_FALSE(corrected.changed());
  const VerifiedFigure unknown = with_errors(std::nan(""), 0.5, 0.5).shear;
  Verification v;
  v.shear = unknown;
  EXPECT_FALSE(corrected_case(*prepared.value, v, {}).asked.kept());
  v.shear.mesh.reset(); // not measured: nothing to correct by
  const CorrectedCase none = corrected_case(*prepared.value, v, {});
  EXPECT_FALSE(none.asked.kept() || none.changed());
  EXPECT_NE(none.asked.why_not.find("no band"), std::string::npos);
}

TEST(Correction, IsTheLeastWorkThatKeepsWhatWasAskedFor) {
  const PreparedCase prepared = small_hemisphere(1.0);
  const Case& data = *prepared.value;
  constexpr double mesh = 0.9, inertia = 0.6, softening = 0.5;
  const CorrectedCase corrected = corrected_case(data, with_errors(mesh, inertia, softening), {});
  const AskedAccuracy& a = corrected.asked;
  EXPECT_NEAR(a.wanted_deg, 1.0, 1e-9);
  EXPECT_NEAR(a.expected_deg, 1.0, 1e-9);
  EXPECT_NEAR(corrected.data.blanks[0].element_size, a.element_size * data.blanks[0].element_size,
              1e-12);
  EXPECT_NEAR(corrected.data.solver.duration, a.duration * data.solver.duration, 1e-12);
  EXPECT_NEAR(corrected.data.solver.fibre_softening, a.softening * data.solver.fibre_softening,
              1e-9);
  const auto work = [](double size, double duration, double soft) {
    return std::pow(size, -2.7) * duration / std::sqrt(soft);
  };
  const double least = work(a.element_size, a.duration, a.softening);
  int kept = 0;
  for (double size = 0.5; size <= 1.0; size += 0.01) // by hand
    for (double duration = 1.0; duration <= 4.0; duration += 0.02)
      for (double soft = 0.1; soft <= 1.0; soft += 0.02) {
        const double all = std::hypot(mesh * std::pow(size, order_of_mesh),
                                      inertia * std::pow(duration, -order_of_inertia),
                                      softening * std::pow(soft, order_of_softening));
        if (safety * all > 1.0) continue;
        ++kept;
        EXPECT_GE(work(size, duration, soft), 0.999 * least) << size << duration << soft;
      }
  EXPECT_GT(kept, 1000);
}

TEST(Correction, LeavesAParameterThatIsBetterThanNeeded) {
  const PreparedCase prepared = small_hemisphere(1.0);
  const AskedAccuracy a = corrected_case(*prepared.value, with_errors(1.2, 0.01, 0.0), {}).asked;
  EXPECT_EQ(a.duration, 1.0);
  EXPECT_EQ(a.softening, 1.0);
  EXPECT_LT(a.element_size, 1.0);
  EXPECT_NEAR(a.expected_deg, 1.0, 1e-9);
}

TEST(Correction, LeavesWhatWasSetByHandAndSaysWhenNothingHelps) {
  const PreparedCase by_hand = small_hemisphere(1.0, {{"blanks.square.element_size", "6.8"}});
  EXPECT_TRUE(by_hand.fixed.element_size);
  const Verification v = with_errors(0.5, 0.6, 0.5);
  const AskedAccuracy a = corrected_case(*by_hand.value, v, by_hand.fixed).asked;
  EXPECT_EQ(a.element_size, 1.0);
  EXPECT_GT(a.duration, 1.0);
  EXPECT_LT(a.softening, 1.0);
  EXPECT_NEAR(a.expected_deg, 1.0, 1e-9);
  const CorrectedCase none = corrected_case(*by_hand.value, v, {true, true, true});
  EXPECT_FALSE(none.changed());
  EXPECT_NE(none.asked.why_not.find("elements, duration, softening"), std::string::npos);
}

TEST(Correction, GoesNoFurtherThanTheOrdersWereMeasured) {
  const PreparedCase prepared = small_hemisphere(0.1);
  const AskedAccuracy a = corrected_case(*prepared.value, with_errors(2.0, 2.0, 0.0), {}).asked;
  EXPECT_EQ(a.element_size, 0.5);
  EXPECT_EQ(a.duration, 4.0);
  EXPECT_GT(a.expected_deg, 0.1); // and is told so
}

TEST(Correction, ScalesEachEstimateOfAForce) {
  Verification first = with_errors(1.0, 1.0, 1.0);
  VerifiedFigure& f = first.figures.emplace_back();
  f.name = "force of punch", f.unit = "N", f.force = true, f.value = 100.0;
  f.mesh = f.inertia = f.softening = f.chance = 0.0; // their sums alone make the band
  f.estimates = {{8.0, 8.0, 8.0}, {-8.0, 8.0, 8.0}};
  AskedAccuracy asked;
  asked.element_size = std::pow(0.5, 1.0 / order_of_mesh), asked.duration = 2.0;
  asked.softening = 0.25;
  const Verification now = after_correction(first, asked, {}, {});
  // 8 / 2, 8 / 2^3 and 8 / 4, with their signs
  EXPECT_NEAR(now.figures[0].band.value(), safety * std::sqrt(0.5 * (49.0 + 1.0)), 1e-12);
}

/// Root mean square difference in shear to a run of half the element size, half the speed and half
/// the softening of `data`, degrees.
double error_of(const RunResult& run, Case data) {
  data.solver.outputs = 1;
  data.blanks[0].element_size *= 0.5;
  data.solver.duration *= 2.0;
  data.solver.fibre_softening *= 0.5;
  return shear_error(run.last, run_case(data, 1, {}).last).rms;
}

TEST(Correction, BringsARunThatHasMissedNearer) {
  const PreparedCase prepared = small_hemisphere(1.6, {{"solver.duration", "0.02"}});
  Case data = *prepared.value;
  Trace trace;
  RunHooks hooks;
  watch(hooks, trace, true);
  const RunResult first = run_case(data, 1, hooks);
  const auto verification = verify(data, first, trace, 1, {});
  ASSERT_TRUE(verification);
  const CorrectedCase corrected = corrected_case(data, *verification, {});
  ASSERT_FALSE(corrected.asked.kept());
  ASSERT_TRUE(corrected.changed());
  const RunResult second = run_case(corrected.data, 1, {});
  ASSERT_TRUE(ended(second.summary.status)) << second.summary.message;
  const double before = error_of(first, data), after = error_of(second, data);
  EXPECT_LT(after, 0.8 * before);
  EXPECT_LT(after, corrected.asked.wanted_deg);
  const Verification now =
      after_correction(*verification, corrected.asked, {first.last, first.summary.plies},
                       {second.last, second.summary.plies});
  EXPECT_NEAR(now.shear.band.value(), corrected.asked.expected_deg, 1e-12);
  EXPECT_GT(now.asked->moved_deg, 0.0);
  ASSERT_EQ(now.figures.size(), verification->figures.size());
  for (std::size_t i = 0; i < now.figures.size(); ++i) {
    EXPECT_EQ(now.figures[i].name, verification->figures[i].name);
    EXPECT_EQ(now.figures[i].mesh.has_value(), verification->figures[i].mesh.has_value());
    if (!now.figures[i].mesh) continue; // the blank-holder's force is given
    EXPECT_LE(std::abs(now.figures[i].mesh.value()),
              std::abs(verification->figures[i].mesh.value()));
  }
  EXPECT_EQ(now.figures.back().value, second.last.tools.back().force_N);
}

} // namespace
} // namespace plyform::correction_test
