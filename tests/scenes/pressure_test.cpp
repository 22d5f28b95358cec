// SPDX-License-Identifier: GPL-3.0-or-later
// Pressures on round membranes against closed forms, at rest. Strips: pressed_strips_test.cpp.
//
// A clamped round membrane of radius a, without bending, C = E t, deflection w(r), tension N along
// the radius. With small slopes and a pressure that stays vertical (H. Hencky, Zeitschrift fuer
// Mathematik und Physik 63 (1915) 311-317; a slip in his coefficients was put right by W. Z. Chien,
// 1948, so that they are computed here):
//   N w' = -p r / 2,   r d/dr (1/r d/dr (r^2 N)) = -C/2 w'^2,   r N' + (1 - nu) N = 0 at a
// Series N = 1/4 (p^2 a^2 C)^(1/3) B(rho), B = sum b_k rho^(2k), rho = r/a:
//   k (k + 1) b_k = -2 [1/B^2]_(k-1),   sum (2k + 1 - nu) b_k = 0                          (H)
// so that w0 / a = c(nu) (p a / C)^(1/3), c = integral of 2 rho / B = sum [1/B]_k / (k + 1).
//
// The same without the neglects (slopes of any size, pressure normal to the surface, the law of the
// sheet as it is), with T tension along the meridian per unformed length, S of the law:
//   R T sin(phi) = p r^2 / 2,   (R T cos(phi))' = l2 S22 - p r l1 sin(phi)                 (L)
// (L) is what a fine mesh must give; how far (H) is from it says to which deflection (H) is right.
#include "core/run/run.hpp"
#include "core/solver/scene.hpp"
#include "support/pressure_scenes.hpp"
#include "support/thread_checks.hpp"

#include <array>
#include <gtest/gtest.h>

namespace plyform::pressure_test {
namespace {

using namespace pressure_scenes;

constexpr double radius = 100.0; // mm

// ---- Hencky's series ----

/// Coefficients of 1/B.
std::vector<double> inverse(const std::vector<double>& b) {
  std::vector<double> inv;
  for (std::size_t k = 0; k < b.size(); ++k) {
    double sum = k == 0 ? 1.0 : 0.0;
    for (std::size_t j = 1; j <= k; ++j)
      sum -= b[j] * inv[k - j];
    inv.push_back(sum / b[0]);
  }
  return inv;
}

std::vector<double> series_from(double b0) {
  std::vector<double> b{b0};
  for (std::size_t k = 1; k < 40; ++k) {
    const std::vector<double> inv = inverse(b);
    double square = 0.0;
    for (std::size_t j = 0; j < k; ++j)
      square += inv[j] * inv[k - 1 - j];
    b.push_back(-2.0 * square / static_cast<double>(k * (k + 1)));
  }
  return b;
}

struct Hencky {
  double deflection = 0.0; ///< c
  double edge = 0.0;       ///< N at a over (p^2 a^2 C)^(1/3)
};

Hencky hencky(double poissons_ratio) {
  const double b0 = root(1.6, 2.5, [&](double first) {
    const std::vector<double> b = series_from(first);
    double sum = 0.0;
    for (std::size_t k = 0; k < b.size(); ++k)
      sum += (2.0 * static_cast<double>(k) + 1.0 - poissons_ratio) * b[k];
    return sum;
  });
  const std::vector<double> b = series_from(b0), inv = inverse(b);
  Hencky h;
  for (std::size_t k = 0; k < b.size(); ++k) {
    h.deflection += inv[k] / static_cast<double>(k + 1);
    h.edge += 0.25 * b[k];
  }
  return h;
}

// ---- without the neglects ----

struct Membrane {
  double deflection = 0.0, edge = 0.0; ///< mm, N/mm
};

/// A state on a meridian: r, R T cos(phi), and how far it has gone down from the middle.
using State = std::array<double, 3>;

struct Meridian {
  double p;

  /// T (N/mm) at R, and the derivatives of the state by R.
  double slopes(double at, const State& y, State& d) const {
    const double plane = stretch_stiffness / (1.0 - nu * nu);
    const double across = y[1] / at, up = p * y[0] * y[0] / (2.0 * at);
    const double tension = std::hypot(across, up), l2 = y[0] / at, e2 = 0.5 * (l2 * l2 - 1.0);
    double l1 = 1.0 + tension / plane; // Newton: l1 S11 = T
    for (int i = 0; i < 20; ++i) {
      const double s1 = plane * (0.5 * (l1 * l1 - 1.0) + nu * e2);
      l1 -= (l1 * s1 - tension) / (s1 + plane * l1 * l1);
    }
    const double s2 = plane * (e2 + nu * 0.5 * (l1 * l1 - 1.0));
    d = {l1 * across / tension, l2 * s2 - p * y[0] * l1 * up / tension, l1 * up / tension};
    return tension;
  }

  /// From the middle, stretched by l, to the edge, by Runge and Kutta; the tension there.
  double shoot(double l, State& y) const {
    constexpr int steps = 1000;
    const double begin = 1e-6 * radius, h = (radius - begin) / steps;
    const double s = stretch_stiffness / (1.0 - nu) * 0.5 * (l * l - 1.0);
    y = {l * begin, begin * l * s, 0.0};
    const auto ahead = [](const State& from, double by, const State& d) {
      return State{from[0] + by * d[0], from[1] + by * d[1], from[2] + by * d[2]};
    };
    State k1, k2, k3, k4;
    for (int i = 0; i < steps; ++i) {
      const double at = begin + h * i;
      slopes(at, y, k1);
      slopes(at + 0.5 * h, ahead(y, 0.5 * h, k1), k2);
      slopes(at + 0.5 * h, ahead(y, 0.5 * h, k2), k3);
      slopes(at + h, ahead(y, h, k3), k4);
      for (std::size_t j = 0; j < 3; ++j)
        y[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
    }
    return slopes(radius, y, k1);
  }
};

Membrane without_neglects(double p) {
  const Meridian meridian{p};
  State y;
  const double l = root(1.0 + 1e-6, 1.2, [&](double stretch) {
    meridian.shoot(stretch, y);
    return y[0] - radius;
  });
  const double edge = meridian.shoot(l, y);
  return {y[2], edge};
}

TEST(Pressure, ClosedFormsOfTheMembraneAgreeWhereSlopesAreSmall) {
  EXPECT_NEAR(hencky(0.3).deflection, 0.6534, 1e-4); // b0 = 1.7244
  EXPECT_NEAR(hencky(0.2).deflection, 0.6774, 1e-4);
  const auto deflection_over = [](double share) {
    const double p = std::pow(share / hencky(nu).deflection, 3.0) * stretch_stiffness / radius;
    return share * radius / without_neglects(p).deflection;
  };
  EXPECT_NEAR(deflection_over(0.03), 1.0, 3e-4);
  EXPECT_NEAR(deflection_over(0.15), 0.995, 1e-3); // so that 2 % of (H) is fair there
}

// ---- the membrane as a scene ----

BlankSpec disc(double size, MeshKind mesh) {
  BlankSpec blank;
  append_circle(blank.outline, Vec2::Zero(), radius);
  blank.mesh = mesh;
  blank.element_size = size;
  return blank;
}

/// Holds each node on the rim.
void clamp_rim(Case& data) {
  const BlankMesh mesh = mesh_blank(data.blanks[0], 0.0, 0.5 * std::numbers::pi);
  for (const Vec2& x : mesh.x) {
    if (x.norm() < radius * (1.0 - 1e-6)) continue;
    Grip grip;
    grip.place = {false, {x - Vec2::Constant(1e-3), x + Vec2::Constant(1e-3)}};
    data.boundaries.push_back({"rim" + std::to_string(data.boundaries.size()), -1, grip});
  }
}

Case inflated_disc(double size, double pressure, MeshKind mesh = MeshKind::free) {
  Case data = stack_of({0.0}, disc(size, mesh));
  data.fabrics = {film()};
  data.plies[0].z = 0.0;
  clamp_rim(data);
  inflate(data, pressure, 0.02, 1500.0);
  return data;
}

double highest(const RunResult& run) {
  double most = 0.0;
  for (const Vec3& x : run.last.plies[0].x)
    most = std::max(most, x.z());
  return most;
}

/// N/mm along the meridian at the rim: what boundaries hold there, across, and of what the pressure
/// lifts in all.
double edge_tension(const RunResult& run, double p) {
  const PlyFrame& ply = run.last.plies[0];
  double outward = 0.0, area = 0.0;
  for (std::size_t n = 0; n < ply.x.size(); ++n)
    outward += ply.reaction[n].head<2>().dot(ply.x0[n].head<2>().normalized());
  for (const Triangle& t : ply.triangles)
    area += 0.5 *
            (ply.x0[at(t[1])] - ply.x0[at(t[0])]).cross(ply.x0[at(t[2])] - ply.x0[at(t[0])]).norm();
  return std::hypot(outward, p * area) / (2.0 * std::numbers::pi * radius);
}

TEST(Pressure, ClampedRoundMembraneRisesAsHenckysSeries) {
  const Hencky h = hencky(nu);
  for (const double share : {0.05, 0.15}) { // of the radius
    const double p = std::pow(share / h.deflection, 3.0) * stretch_stiffness / radius;
    const RunResult run = run_case(inflated_disc(8.0, p), 1, {});
    expect_rest(run);
    const Membrane exact = without_neglects(p);
    RecordProperty("deflection_over_hencky", std::to_string(highest(run) / (share * radius)));
    fmt::print(
        "deflection {:.3f} mm, {:.4f} of (H), {:.4f} of (L); tension at the rim {:.4f} N/mm, "
        "{:.4f} of (L); balance {:.1e}\n",
        highest(run), highest(run) / (share * radius), highest(run) / exact.deflection,
        edge_tension(run, p), edge_tension(run, p) / exact.edge, run.last.energy.balance_error());
    EXPECT_NEAR(highest(run), share * radius, 0.02 * share * radius);
    EXPECT_NEAR(highest(run), exact.deflection, 0.01 * exact.deflection);
    EXPECT_NEAR(edge_tension(run, p), exact.edge, 0.02 * exact.edge);
  }
}

TEST(Pressure, MembraneConvergesWithTheSquareOfTheElementSize) {
  const double p = std::pow(0.15 / hencky(nu).deflection, 3.0) * stretch_stiffness / radius;
  const double exact = without_neglects(p).deflection;
  const auto error = [&](double size) {
    const RunResult run = run_case(inflated_disc(size, p), 1, {});
    expect_rest(run);
    fmt::print("elements of {} mm: deflection {:+.3f} %\n", size,
               100.0 * (highest(run) / exact - 1.0));
    return std::abs(highest(run) / exact - 1.0);
  };
  const double coarse = error(24.0), fine = error(8.0);
  const double order = std::log(coarse / fine) / std::log(3.0);
  fmt::print("order {:.2f}\n", order);
  EXPECT_GT(order, 1.6);
}

TEST(Pressure, RunEndsBeforeItsDwellWhenTheMembraneRests) {
  Case data = inflated_disc(25.0, 0.01);
  data.solver.dwell = 2.0;
  const RunResult rests = run_case(data, 1, {});
  expect_rest(rests);
  EXPECT_GT(rests.last.time, 1.04 * data.solver.duration); // one window at least
  EXPECT_LT(rests.last.time, 1.5 * data.solver.duration);
  data.solver.mass_damping = 0.0; // it swings, and stands still at either end of its way
  data.solver.dwell = 0.5;
  const RunResult swings = run_case(data, 1, {});
  ASSERT_TRUE(ended(swings.summary.status)) << swings.summary.message;
  EXPECT_NEAR(swings.last.time, 1.5 * data.solver.duration, 0.01 * data.solver.duration);
  bool said = false;
  for (const std::string& line : swings.summary.work.missing)
    said = said || line.find("plies had not come to rest") != std::string::npos;
  EXPECT_TRUE(said);
}

// Where the membrane leaves the plate, nodes on it are pressed along its normal beside triangles
// that lift off: on a plane that is right, and its rim bears little of the load.
TEST(Pressure, APlateThatBearsTheMembraneHasNoEdgesToDoubt) {
  Case data = inflated_disc(12.0, 0.0);
  data.fabrics[0].sheet = IsotropicLaw{2.5, nu};
  data.loads = {{0, PlyFace::above, 0.02, {{0.6, 0.02}}}};
  Tool plate;
  plate.name = "plate";
  plate.shape = Plane{};
  plate.position = Vec3(0.0, 0.0, -8.0);
  data.tools = {plate};
  set_friction(data, 0.2);
  data.solver.outputs = 4;
  const RunResult run = run_case(data, 1, {});
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_GT(std::abs(run.last.tools[0].force_N), 300.0); // of the 628 N on the membrane
  EXPECT_EQ(run.summary.message.find("edges of plate"), std::string::npos) << run.summary.message;
}

TEST(Pressure, GivesTheSameBitsForAnyNumberOfThreads) {
  Case data = inflated_disc(25.0, 0.01);
  data.solver.duration = 0.003;
  run_on_any_threads([&] { return make_scene(data); });
}

} // namespace
} // namespace plyform::pressure_test
