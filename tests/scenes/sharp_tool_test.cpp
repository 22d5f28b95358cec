// SPDX-License-Identifier: GPL-3.0-or-later
// Contact with tools is at nodes; between them flat triangles cut corners, by no more than
// core/run/facet_penetration.hpp says.
#include "core/run/facet_penetration.hpp"
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

namespace plyform::sharp_tool_test {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;

/// (1), (2) of core/run/facet_penetration.hpp: c in mm. side, radius, thickness in mm; half_turn:
/// a, rad, above 0 and below pi/2.
double cut_between_nodes(double side, double radius, double thickness, double half_turn) {
  const double R = radius + 0.5 * thickness, half = 0.5 * side;
  if (half <= R * std::sin(half_turn)) return R - std::sqrt(R * R - half * half); // (1)
  return half * std::tan(half_turn) - R * (1.0 / std::cos(half_turn) - 1.0);      // (2)
}

/// The longest side (mm) whose cut is half a thickness.
double side_of_half_cut(double radius, double thickness, double half_turn) {
  const double R = radius + 0.5 * thickness, cut = 0.5 * thickness;
  if (cut <= R * (1.0 - std::cos(half_turn))) return 2.0 * std::sqrt(cut * (2.0 * R - cut)); // (1)
  return 2.0 * (cut + R * (1.0 / std::cos(half_turn) - 1.0)) / std::tan(half_turn);          // (2)
}

/// A strip 20 mm wide lies from x = -60 to 60 over a table that ends, or curves away, near x = 0.
/// Its right end is drawn down by 48 mm, its left end kept level and free to follow. No friction.
Scene drawn_over(const ToolShape& shape, const Vec3& position, const Eigen::Matrix3d& rotation,
                 double size) {
  Case data = stack_of({0.0}, rectangle(120.0, 20.0, size));
  Tool table;
  table.name = "table";
  table.shape = shape;
  table.position = position;
  table.rotation = rotation;
  data.tools = {table};
  set_friction(data, 0.0);
  data.boundaries = {hold("pull", {60.0, -10.0}, {60.0, 10.0}, Vec3(-0.28, 0.0, -0.96), 50.0),
                     hold("level", {-60.0, -10.0}, {-60.0, 10.0}, Vec3::UnitX(), 0.0)};
  data.boundaries[1].as<Grip>().held = {false, true, true};
  data.gravity = {0.0, 0.0, -1e5}; // mm/s^2
  data.solver.fibre_softening = 100.0;
  data.solver.mass_damping = 500.0; // 1/s
  data.solver.duration = 0.02;
  return make_scene(data);
}

/// Deepest (mm) of a fine sample of all triangles, by the shape's own distance.
double sampled_depth(const Scene& s) {
  constexpr int parts = 16;
  double depth = 0.0;
  for (const Triangle& t : s.plies[0].membrane.triangles)
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) {
        Vec3 x = Vec3::Zero();
        const double w[] = {double(i) / parts, double(j) / parts, double(parts - i - j) / parts};
        for (std::size_t k = 0; k < 3; ++k)
          x += w[k] * s.plies[0].x[t[k]];
        SurfaceHint hint;
        depth = std::max(depth, 0.3 - distance_to_tool(s.tools[0].body, x, hint).distance);
      }
  return depth;
}

/// What is measured is below the bound (for a turn of 90 degrees, the most that it can be here),
/// and not by far; the summary says it to the resolution that it states.
void expect_within_bound(const std::function<Scene()>& make, double radius,
                         const std::string& what) {
  const EndedRun run = run_on_any_threads(make);
  ASSERT_TRUE(ended(run.result.summary.status)) << what << ": " << run.result.summary.message;
  const ContactReport& c = run.result.summary.contact;
  const double side = longest_side(run.scene.plies[0].edges, run.scene.plies[0].x);
  const double bound = cut_between_nodes(side, radius, 0.6, 0.5 * quarter);
  const double depth = sampled_depth(run.scene), at_nodes = c.max_tool_penetration_mm;
  const double told = c.max_tool_penetration_between_nodes_mm;
  fmt::print(
      "{}: side {:.3g} mm, cut {:.3g} mm of {:.3g}, told {:.3g}, at nodes {:.2g}, {:.2f} s\n", what,
      side, depth, bound, told, at_nodes, run.result.summary.wall_time_s);
  EXPECT_LE(depth, bound + at_nodes) << what;
  EXPECT_GE(depth, 0.1 * bound) << what;
  EXPECT_GE(told, at_nodes) << what;
  EXPECT_GE(told, depth - 0.01 * 0.6) << what;  // a hundredth of a thickness
  EXPECT_LE(told, depth + side / 32.0) << what; // the sample's points are side / 16 apart
}

TEST(SharpTool, EdgeCutsNoDeeperThanItsBound) {
  for (const double size : {10.0, 5.0})
    expect_within_bound(
        [&] {
          return drawn_over(Box{{100.0, 60.0, 20.0}}, {-47.0, 0.0, -10.0},
                            Eigen::Matrix3d::Identity(), size);
        },
        0.0, fmt::format("edge, cells of {} mm", size));
}

TEST(SharpTool, CylinderSmallerThanAnElementCutsNoDeeperThanItsBound) {
  const Eigen::Matrix3d along_y = Eigen::AngleAxisd(quarter, Vec3::UnitX()).toRotationMatrix();
  for (const double radius : {4.0, 40.0})
    expect_within_bound(
        [&] {
          return drawn_over(Cylinder{radius, 60.0}, {0.0, 0.0, -radius}, along_y, 10.0);
        },
        radius, fmt::format("cylinder of {} mm, cells of 10 mm", radius));
}

/// The bound against brute force: chords between two flanks and the arc between them, everywhere.
TEST(SharpTool, BoundIsTheWorstOfAllChords) {
  for (const double radius : {0.0, 1.0, 5.0, 30.0})
    for (const double half_turn : {0.2, 0.5 * quarter, 0.9}) {
      const double R = radius + 0.3, corner = R * std::tan(half_turn);
      // the path of the mid-surface: flat, arc about (0, -R) from the tangent at -half_turn, flat
      const auto path = [&](double s) -> Vec2 {
        if (std::abs(s) <= R * half_turn) return {R * std::sin(s / R), R * std::cos(s / R)};
        const double over = std::abs(s) - R * half_turn, sign = s > 0.0 ? 1.0 : -1.0;
        return {sign * (R * std::sin(half_turn) + over * std::cos(half_turn)),
                R * std::cos(half_turn) - over * std::sin(half_turn)};
      };
      const double half_cut = side_of_half_cut(radius, 0.6, half_turn);
      for (const double side : {0.5, 3.0, 10.0, half_cut}) {
        double worst = 0.0;
        for (double from = -side - R; from < side + R; from += 0.01 * side) {
          const Vec2 a = path(from);
          double to = from, far = from + 4.0 * (side + corner); // bisection for the chord's end
          for (int i = 0; i < 60; ++i)
            ((path(0.5 * (to + far)) - a).norm() < side ? to : far) = 0.5 * (to + far);
          const Vec2 b = path(to);
          for (int i = 0; i <= 100; ++i) {
            const Vec2 p = a + 0.01 * i * (b - a);
            // distance to the solid inside the path: of the arc's sector, else of the flanks
            const double angle = std::atan2(std::abs(p.x()), p.y());
            const double d = angle <= half_turn ? p.norm()
                                                : std::abs(p.x()) * std::sin(half_turn) +
                                                      p.y() * std::cos(half_turn);
            worst = std::max(worst, R - d);
          }
        }
        const double bound = cut_between_nodes(side, radius, 0.6, half_turn);
        EXPECT_LE(worst, bound * (1.0 + 1e-9)) << radius << " " << half_turn << " " << side;
        // the nearest surface of a wedge is a flank: nearer than its edge by cos a
        const double slant = side > 2.0 * R * std::sin(half_turn) ? std::cos(half_turn) : 1.0;
        EXPECT_GE(worst, 0.95 * slant * bound) << radius << " " << half_turn << " " << side;
        if (side != half_cut) continue;
        EXPECT_LE(worst, 0.3 * (1.0 + 1e-9)) << radius << " " << half_turn;
        EXPECT_GE(worst, 0.95 * slant * 0.3) << radius << " " << half_turn;
      }
    }
}

} // namespace
} // namespace plyform::sharp_tool_test
