// SPDX-License-Identifier: GPL-3.0-or-later
// Shear that resists by its rate, in whole scenes: picture frames at several rates, relaxation
// after a stop, and a draft.
#include "support/kill_checks.hpp"
#include "support/picture_frames.hpp"

#include <cstdio>
#include <gtest/gtest.h>

namespace plyform::viscous_shear_scene_test {
namespace {

constexpr double pi = std::numbers::pi;

/// A frame of 100 mm that shears to 50 degrees in a process of some seconds.
Case frame_of(const ViscousShear& law, double process, MeshKind mesh = MeshKind::alternating) {
  Case data = picture_frame(mesh);
  data.fabrics[0].crossings[0].viscous = law;
  data.solver.fibre_softening = 10.0; // the spring of the dashpot is hardly stretched
  data.process.duration = process;
  return data;
}

/// 1/s of the process, at a time of the simulation.
double rate_of(const Case& data, double time) {
  const double h = 1e-4 * data.solver.duration;
  if (time >= data.solver.duration) return 0.0;
  return (frame_angle(data, time + h) - frame_angle(data, time - h)) /
         (2.0 * h * data.process_time());
}

/// N mm s: torque at 1/s as large as the elastic one of the weave at 50 degrees.
double usual_viscosity() {
  return glass_weave().crossings[0].shear.at(50.0 * pi / 180.0).value;
}

/// The load of frames in processes of 1, 10 and 100 s is that of C_e + D(gamma, gamma'), within 1
/// %.
void expect_loads(const ViscousShear& law, MeshKind mesh = MeshKind::alternating) {
  for (const double process : {1.0, 10.0, 100.0}) {
    const Case data = frame_of(law, process, mesh);
    int judged = 0;
    double largest = 0.0;
    for (const Frame& frame : outputs_of(data)) {
      const double gamma = frame_angle(data, frame.time), rate = rate_of(data, frame.time);
      if (gamma < 10.0 * pi / 180.0 || rate < 0.3 / process) continue;
      ++judged;
      const double torque =
          data.fabrics[0].crossings[0].shear.at(gamma).value + law.torque(gamma, rate);
      const double wanted = frame_load(data, gamma, torque);
      EXPECT_NEAR(frame.boundaries[0].force_N / wanted, 1.0, 0.01) << process << " " << gamma;
      largest = std::max(largest, std::abs(frame.boundaries[0].force_N / wanted - 1.0));
      for (std::size_t e = 0; e < frame.plies[0].shear_rate.size(); ++e) {
        EXPECT_NEAR(frame.plies[0].shear_rate[e], rate, 0.1 * rate + 0.02 / process);
        const double sheet = data.fabrics[0].families[0].density *
                             data.fabrics[0].families[1].density * law.torque(gamma, rate);
        EXPECT_NEAR(frame.plies[0].viscous_shear[e], sheet, 0.01 * sheet);
      }
    }
    std::printf("[ rate     ] %g s: load off by %.2g %% at most\n", process, 100.0 * largest);
    EXPECT_GE(judged, 6);
  }
}

TEST(ViscousShearScene, FrameHasTheLoadOfItsRate) {
  ViscousShear law;
  law.c = {usual_viscosity()};
  expect_loads(law);
}

TEST(ViscousShearScene, FrameHasTheLoadOfAViscosityOverAngle) {
  ViscousShear law;
  law.c = {0.3 * usual_viscosity(), 0.5 * usual_viscosity(), 0.4 * usual_viscosity()};
  expect_loads(law, MeshKind::free);
}

/// A melt that thins: torque with the root of the rate.
TEST(ViscousShearScene, FrameHasTheLoadOfATableOverAngleAndRate) {
  ViscousShear law;
  for (const double rate : {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0})
    law.curves.push_back(
        {rate,
         {0.0, 0.5, 1.0},
         {0.3 * usual_viscosity() * std::sqrt(rate), 0.5 * usual_viscosity() * std::sqrt(rate),
          usual_viscosity() * std::sqrt(rate)}});
  expect_loads(law);
}

/// Torque of a branch (N mm) at a time of the process, from all that came before.
double branch_torque(const Case& data, const MaxwellBranch& branch, double time) {
  const int n = 4000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double s0 = time * i / n, s1 = time * (i + 1) / n;
    sum += (frame_angle(data, s1) - frame_angle(data, s0)) *
           std::exp(-(time - 0.5 * (s0 + s1)) * data.process_time() / branch.time);
  }
  return branch.modulus * sum;
}

/// Held after a stroke of 10 s for as long again, with branches that relax in 1, 5 and 50 s.
TEST(ViscousShearScene, TorqueRelaxesAfterAStop) {
  const double torque = glass_weave().crossings[0].shear.at(50.0 * pi / 180.0).value;
  ViscousShear law;
  law.branches = {{4.0 * torque, 1.0}, {2.0 * torque, 5.0}, {torque, 50.0}};
  Case data = frame_of(law, 10.0);
  data.solver.dwell = 1.0;
  data.solver.outputs = 40;
  int held = 0, moving = 0;
  double largest = 0.0;
  const std::vector<Frame> frames = outputs_of(data);
  EXPECT_NEAR(frames.back().time, 2.0 * data.solver.duration, 0.01 * data.solver.duration);
  for (const Frame& frame : frames) {
    const double gamma = frame_angle(data, frame.time);
    if (gamma < 5.0 * pi / 180.0) continue;
    const double end = std::min(frame.time, data.solver.duration);
    const double since = (frame.time - end) * data.process_time(); // s of the process
    double sum = data.fabrics[0].crossings[0].shear.at(gamma).value;
    for (const MaxwellBranch& branch : law.branches)
      sum += branch_torque(data, branch, end) * std::exp(-since / branch.time);
    const double wanted = frame_load(data, gamma, sum);
    EXPECT_NEAR(frame.boundaries[0].force_N / wanted, 1.0, 0.01) << frame.time;
    largest = std::max(largest, std::abs(frame.boundaries[0].force_N / wanted - 1.0));
    ++(since > 0.0 ? held : moving);
  }
  std::printf("[ relaxed  ] load off by %.2g %% at most, %d states held\n", 100.0 * largest, held);
  EXPECT_GE(moving, 10);
  EXPECT_GE(held, 1);
}

/// Two plies over a ball, rates and branches: energy is closed with its losses, bits are the same
/// on any number of threads, and a run that is killed ends as one that is not.
TEST(ViscousShearScene, FormsOverABall) {
  Case data = coarse_hemisphere({0.0, 0.25 * pi});
  for (Fabric& fabric : data.fabrics) {
    ViscousShear law;
    law.c = {10.0 * usual_viscosity()};
    law.branches = {{fabric.crossings[0].shear.at(0.5).value, 2.0}};
    fabric.crossings[0].viscous = law;
  }
  data.tools[0].stroke = 30.0;
  data.solver.duration = 0.02;
  data.process.duration = 10.0;
  const Energies last = expect_sound_and_repeatable(data, 2);
  EXPECT_GT(last.viscous, 0.05 * last.external);
}

/// Viscosities and times are f times those of the reference: in a process that is f times as long
/// all forces are the same (superposition of time and temperature).
TEST(ViscousShearScene, AtAnotherTemperatureIsAsInAProcessOfAnotherLength) {
  ViscousShear law;
  law.c = {usual_viscosity()};
  law.branches = {{0.5 * usual_viscosity(), 2.0}};
  Case warm = frame_of(law, 10.0), reference = warm;
  warm.fabrics[0].flow = ArrheniusFactor{41000.0, 180.0};
  warm.process.temperature = 200.0;
  const double f = warm.fabrics[0].flow.at(200.0);
  reference.process.duration = 10.0 / f;
  const std::vector<Frame> one = outputs_of(warm), other = outputs_of(reference);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_NEAR(one[i].boundaries[0].force_N, other[i].boundaries[0].force_N,
                1e-6 * one.back().boundaries[0].force_N);
  EXPECT_EQ(one.back().plies[0].temperature[0], 200.0);
}

/// The same of the melt of a tape.
TEST(ViscousShearScene, MeltAtAnotherTemperatureIsAsInAProcessOfAnotherLength) {
  Case warm = frame_of({}, 10.0);
  warm.fabrics[0] = unidirectional();
  warm.fabrics[0].families[0].angle = 0.0;
  warm.fabrics[0].matrix = ViscousMatrix{10.0, 5.0};
  warm.fabrics[0].flow = ArrheniusFactor{41000.0, 180.0};
  Case reference = warm, longer = warm;
  warm.process.temperature = 200.0;
  reference.process.temperature = longer.process.temperature = 180.0;
  reference.process.duration = 10.0 / warm.fabrics[0].flow.at(200.0);
  const std::vector<Frame> one = outputs_of(warm), other = outputs_of(reference);
  ASSERT_EQ(one.size(), other.size());
  const double last = one.back().boundaries[0].force_N;
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_NEAR(one[i].boundaries[0].force_N, other[i].boundaries[0].force_N, 1e-6 * last);
  const std::size_t middle = one.size() / 2;
  EXPECT_LT(one[middle].boundaries[0].force_N,
            0.9 * outputs_of(longer)[middle].boundaries[0].force_N);
}

TEST(ViscousShearScene, OfAPlyThatCoolsHasTheLoadOfItsTemperature) {
  ViscousShear law;
  law.c = {usual_viscosity()};
  Case data = frame_of(law, 10.0);
  Fabric& fabric = data.fabrics[0];
  fabric.flow = ArrheniusFactor{41000.0, 180.0};
  fabric.heat_capacity = 1.2e9; // N mm/(t K)
  data.process.temperature = 200.0;
  data.process.cooling = Cooling{0.0, 0.0, 0.02, {{0.0, 20.0}}};
  double largest = 0.0;
  int judged = 0;
  for (const Frame& frame : outputs_of(data)) {
    const double gamma = frame_angle(data, frame.time), rate = rate_of(data, frame.time);
    if (gamma < 10.0 * pi / 180.0 || rate < 0.03) continue;
    ++judged;
    const double celsius = frame.plies[0].temperature[0];
    const double torque = fabric.crossings[0].shear.at(gamma).value +
                          fabric.flow.at(celsius) * law.torque(gamma, rate);
    const double off = frame.boundaries[0].force_N / frame_load(data, gamma, torque) - 1.0;
    EXPECT_NEAR(off, 0.0, 0.01) << celsius;
    largest = std::max(largest, std::abs(off));
  }
  std::printf("[ rate     ] of a ply that cools: load off by %.2g %% at most\n", 100.0 * largest);
  EXPECT_GE(judged, 6);
}

} // namespace
} // namespace plyform::viscous_shear_scene_test
