// SPDX-License-Identifier: GPL-3.0-or-later
// Five plies in a closed hemisphere, a quarter of them: a ball in a cavity, with plies between that
// are thicker than the gap. Sheared plies at equal pressure have the same fibre volume fraction
//   V = sum (w / cos gamma) / gap,  w: mm of fibre of an unsheared ply                       (1)
// where the gap is that of two concentric spheres: not by the fillet of the die.
#include "core/run/run.hpp"
#include "support/boundary_scenes.hpp"
#include "support/packing_weave.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::closed_hemisphere_long_test {
namespace {

constexpr double ball = 75.0, cavity = 77.6, fillet = 40.0, stack = 5.0 * packing_free; // mm
constexpr double element = 6.0;                                                         // mm

/// A hemispherical cavity below z = 0, with a rounded edge.
RevolvedProfile cavity_with_fillet() {
  using Segment = ProfileSegment;
  const double x = std::sqrt(std::pow(cavity + fillet, 2) - fillet * fillet);
  const Vec2 centre(x, -fillet), meet = cavity / (cavity + fillet) * centre, top(x, 0.0);
  return {{Segment{Segment::Kind::arc, {0.0, -cavity}, meet, Vec2::Zero(), 1},
           Segment{Segment::Kind::arc, meet, top, centre, -1},
           Segment{Segment::Kind::line, top, {300.0, 0.0}}}};
}

Case closed_hemisphere(double size) {
  Case data =
      stack_of({0.0, 45.0 * degree, 0.0, 45.0 * degree, 0.0}, rectangle(170.0, 170.0, size));
  data.blanks[0].outline.boundary = {{0, 0}, {170, 0}, {170, 70}, {70, 170}, {0, 170}};
  data.boundaries = {plane("x0", Vec2::UnitX()), plane("y0", Vec2::UnitY())};
  data.fabrics = {packing_weave()};
  data.fabrics[0].families[1].tension = data.fabrics[0].families[0].tension; // for 45 degrees
  Tool punch;
  punch.name = "punch";
  punch.shape = Sphere{ball};
  punch.position = {0.0, 0.0, ball + stack};
  punch.motion = Motion::driven;
  punch.stroke = ball + stack;
  Tool die;
  die.name = "die";
  die.shape = cavity_with_fillet();
  Tool holder;
  holder.name = "blank_holder";
  holder.shape = Annulus{100.0, 300.0, 60.0, 25.0};
  holder.position = {0.0, 0.0, stack};
  holder.motion = Motion::force;
  holder.force = 75.0;
  data.tools = {punch, die, holder};
  set_friction(data, 0.2);
  data.solver.duration = 0.04;
  data.solver.dwell = 0.3;
  data.solver.fibre_softening = 100.0;
  data.solver.outputs = 10;
  return data;
}

Vec3 centre_of(const PlyFrame& ply, std::size_t triangle) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t n : ply.triangles[triangle])
    sum += ply.x[at(n)] / 3.0;
  return sum;
}

/// Whether a place is between ball and cavity, an element and more from where the die's fillet
/// begins: plies that are drawn tight over that lie off the cavity's edge.
bool is_between_spheres(const Vec3& x) {
  const double begins = std::asin(fillet / (cavity + fillet)); // rad below the rim's plane
  return x.z() < -std::sin(begins + element / cavity) * x.norm();
}

/// The triangle of a ply through which the radius through a place passes nearest.
std::size_t nearest(const PlyFrame& ply, const Vec3& place) {
  std::size_t found = 0;
  double best = -1.0;
  for (std::size_t e = 0; e < ply.triangles.size(); ++e) {
    const double cosine = centre_of(ply, e).normalized().dot(place.normalized());
    if (cosine > best) best = cosine, found = e;
  }
  return found;
}

/// Errors of a fibre volume over the places where the gap is the spheres'.
struct Misfit {
  double sum = 0.0, squares = 0.0, largest = 0.0;
  int places = 0, close = 0; ///< close: within 0.02
  void add(double error) {
    sum += error, squares += error * error, ++places;
    largest = std::max(largest, std::abs(error));
    if (std::abs(error) <= 0.02) ++close;
  }
  double mean() const { return sum / places; }
  double rms() const { return std::sqrt(squares / places); }
  double share() const { return static_cast<double>(close) / places; }
};

TEST(ClosedHemisphere, FivePliesHaveTheFibreVolumeOfShearedNets) {
  const RunResult run = run_case(closed_hemisphere(element), 1, {});
  fmt::print("{} {}\n", run.summary.status, run.summary.message);
  EXPECT_EQ(run.summary.status, "done");
  EXPECT_EQ(run.summary.contact.intersections_between_plies, 0);
  EXPECT_EQ(run.summary.contact.intersections_within_plies, 0);
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.01);
  Misfit misfit;
  double least = 1.0, most = 0.0;
  const PlyFrame& middle = run.last.plies[2];
  for (std::size_t e = 0; e < middle.triangles.size(); ++e) {
    const Vec3 centre = centre_of(middle, e);
    if (!is_between_spheres(centre)) continue;
    EXPECT_NEAR(middle.mould.gap[e], cavity - ball, 1e-6);
    double fibres = 0.0, measured = 0.0;
    for (const PlyFrame& ply : run.last.plies) {
      const std::size_t here = nearest(ply, centre);
      fibres += packing_weight / std::cos(ply.shear_deg[here] * degree);
      measured += ply.fibre_volume[here] / static_cast<double>(run.last.plies.size());
    }
    const double theory = fibres / (cavity - ball);
    EXPECT_NEAR(middle.mould.fibre_volume[e], theory, 0.02);
    misfit.add(measured - theory);
    least = std::min(least, theory), most = std::max(most, theory);
  }
  fmt::print(
      "{} places, V {:.3f} to {:.3f}; measured less theory: mean {:.4f}, rms {:.4f}, largest "
      "{:.3f}, within 0.02 at {:.1f} %\n",
      misfit.places, least, most, misfit.mean(), misfit.rms(), misfit.largest,
      100.0 * misfit.share());
  EXPECT_GT(misfit.places, 250);
  EXPECT_LT(std::abs(misfit.mean()), 0.02);
  EXPECT_LT(misfit.rms(), 0.02);
  EXPECT_GT(misfit.share(), 0.98);
  for (const PlyReport& ply : run.summary.plies)
    EXPECT_LT(ply.fibre_volume.value().largest, 0.62);
}

} // namespace
} // namespace plyform::closed_hemisphere_long_test
