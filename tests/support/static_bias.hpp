// SPDX-License-Identifier: GPL-3.0-or-later
// The bias-extension test at rest, on any mesh: the element's own forces and energy brought to
// equilibrium by Newton's method, without the time step and its inertia. Shows locking, and how the
// load converges.
#pragma once

#include "core/identify/shear_tests.hpp"
#include "core/ply/bending.hpp"
#include "core/ply/membrane.hpp"
#include "support/bending_reference.hpp"
#include "support/membrane_checks.hpp"
#include "support/strip_mesh.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>

namespace plyform {

/// Internal forces, their tangent and the energy of a membrane that stays in its plane.
class FlatMembrane {
public:
  /// bending: of its yarns in its plane, if they bend. Stitches break by relax_and_break alone, at
  /// forces that the membrane's own are above.
  FlatMembrane(Membrane membrane, std::vector<char> held, std::optional<Bending> turning = {})
      : m(std::move(membrane)), bending(std::move(turning)), states(memory_at_start(m)) {
    for (const char h : held) {
      freedom.push_back(h ? -1 : freedoms);
      freedoms += h ? 0 : 2;
    }
  }

  /// Moves the free nodes of x (mm) until Newton's next step would change the energy by less than
  /// `accuracy` of it. Throws std::runtime_error if that fails.
  void relax(std::vector<Vec3>& x, double accuracy = 1e-10) {
    constexpr int most_iterations = 3000; // locked meshes of slack yarns need 1000
    double energy = total_energy(x), damping = 0.0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const Eigen::VectorXd force = forces(x);
      const Eigen::VectorXd move = newton(x, force, damping);
      const double gain = force.dot(move); // first-order decrease of the energy
      if (gain < accuracy * energy) return;
      double share = std::min(1.0, 5.0 / move.lpNorm<Eigen::Infinity>()); // 5 mm at most
      std::vector<Vec3> next;
      double lower = energy;
      for (int half = 0; half < 30; ++half, share *= 0.5) {
        next = moved(x, share * move);
        lower = total_energy(next);
        if (lower <= energy - 1e-4 * share * gain) break;
      }
      if (!(lower < energy)) {
        if (gain < 1e-8 * energy) return; // as far as rounding of the energy lets it go
        damping = std::max(1e-3, 10.0 * damping);
        if (damping > 1e6) throw std::runtime_error("no equilibrium found");
        continue;
      }
      damping = share > 0.5 ? 0.1 * damping : damping;
      if (damping < 1e-8) damping = 0.0;
      x = next;
      energy = lower;
    }
    throw std::runtime_error("no equilibrium after 3000 iterations");
  }

  /// The same; stitches strained by more than these at rest break, all at once, until none is.
  void relax_and_break(std::vector<Vec3>& x, const std::vector<double>& breaking_strain,
                       double accuracy) {
    do
      relax(x, accuracy);
    while (break_stitches(x, breaking_strain));
  }

  std::vector<Vec3> nodal(const std::vector<Vec3>& x) {
    std::vector<Vec3> force = nodal_forces(m, x, 0.0, states);
    if (!bending) return force;
    const std::vector<Vec3> turning = reference_bending_forces(*bending, x);
    for (std::size_t n = 0; n < x.size(); ++n)
      force[n] += turning[n];
    return force;
  }
  const Membrane& membrane() const { return m; }

private:
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  /// Stretches and shear angle of a triangle in its plane with first and second derivatives by the
  /// places of its corners.
  struct PlaneState {
    double area, gamma;
    std::array<double, most_families> lambda; ///< of the yarns, then of stitches
    std::array<Vec6, most_families> by_lambda;
    std::array<Mat6, most_families> bend_lambda;
    Vec6 by_gamma;
    Mat6 bend_gamma;
  };

  /// Whether any stitch breaks at x.
  bool break_stitches(const std::vector<Vec3>& x, const std::vector<double>& breaking_strain) {
    if (breaking_strain.empty()) return false;
    const std::vector<std::vector<double>> strains = yarn_strains(m, x);
    const std::size_t all = m.families.size(), yarns = all - breaking_strain.size();
    const std::vector<YarnMemory> before = states;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto first = static_cast<std::size_t>(m.group_begin[i / all]);
      const std::size_t family = i % all;
      if (family >= yarns && strains[family][first] > breaking_strain[family - yarns])
        states[i][0] = 1.0;
    }
    return states != before;
  }

  double total_energy(const std::vector<Vec3>& x) const {
    const MembraneEnergy e = membrane_energy(m, x, states);
    return e.fibre + e.shear + e.stitch + (bending ? bending_energy(*bending, x) : 0.0);
  }

  Eigen::VectorXd forces(const std::vector<Vec3>& x) {
    Eigen::VectorXd f(freedoms);
    const std::vector<Vec3> all = nodal(x);
    for (std::size_t n = 0; n < x.size(); ++n)
      if (freedom[n] >= 0) f.segment<2>(freedom[n]) = all[n].head<2>();
    return f;
  }

  std::vector<Vec3> moved(std::vector<Vec3> x, const Eigen::VectorXd& by) const {
    for (std::size_t n = 0; n < x.size(); ++n)
      if (freedom[n] >= 0) x[n].head<2>() += by.segment<2>(freedom[n]);
    return x;
  }

  /// Stiffness of one patch, from the second derivatives of (E) by lambda_a, delta_a and gamma: by
  /// differences of forces it would straddle the kink of yarns that are just taut.
  void add_patch(const std::vector<Vec3>& x, int patch,
                 std::vector<Eigen::Triplet<double>>& entries) const {
    const auto p = static_cast<std::size_t>(patch);
    const int begin = m.group_begin[p], size = m.group_begin[p + 1] - begin;
    std::vector<PlaneState> t;
    double area = 0.0;
    std::array<double, most_families> mean{};
    for (int e = begin; e < begin + size; ++e) {
      t.push_back(plane_state(x, e));
      area += t.back().area;
      for (std::size_t a = 0; a < m.families.size(); ++a)
        mean[a] += t.back().area * t.back().lambda[a];
    }
    for (double& value : mean)
      value /= area;
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(6 * size, 6 * size);
    for (std::size_t a = 0; a < m.families.size(); ++a) {
      const double d = m.families[a].density;
      if (m.families[a].stitch && states[p * m.families.size() + a][0] > 0.0) continue; // broken
      const LawPoint yarn = m.families[a].elastic(mean[a] - 1.0);
      Eigen::VectorXd g = Eigen::VectorXd::Zero(6 * size);
      for (int i = 0; i < size; ++i) {
        const PlaneState& s = t[i];
        g.segment<6>(6 * i) += s.area / area * s.by_lambda[a];
        k.block<6, 6>(6 * i, 6 * i) += s.area * d * yarn.value * s.bend_lambda[a];
      }
      k += area * d * yarn.slope * g * g.transpose();
    }
    for (int i = 0; i < size; ++i)
      add_shear(t, i, area, mean, k);
    for (int r = 0; r < 6 * size; ++r)
      for (int c = 0; c < 6 * size; ++c) {
        const int row = unknown(begin, r), column = unknown(begin, c);
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, k(r, c));
      }
  }

  /// n_c A0 Ws(g) and the s_a of triangle i of a patch; the guard, slack here, is left out.
  void add_shear(const std::vector<PlaneState>& t, int triangle, double area,
                 const std::array<double, most_families>& mean, Eigen::MatrixXd& k) const {
    const auto i = static_cast<std::size_t>(triangle);
    const PlaneState& s = t[i];
    constexpr double beta = deviation_weight;
    std::array<double, 2> delta{s.lambda[0] - mean[0], s.lambda[1] - mean[1]};
    const double deviation2 = beta * (delta[0] * delta[0] + delta[1] * delta[1]);
    const double cells = m.crossings[0].cells * s.area;
    const CellTangent law = cell_tangent(m.fabric.crossings[0].shear, s.gamma, deviation2);
    const double secant = law.secant;
    Eigen::VectorXd by_gamma = Eigen::VectorXd::Zero(k.rows()), by_s2 = by_gamma; // half of s^2
    by_gamma.segment<6>(6 * triangle) = s.by_gamma;
    k += cells * law.gamma_gamma * by_gamma * by_gamma.transpose();
    k.block<6, 6>(6 * triangle, 6 * triangle) += cells * law.torque * s.bend_gamma;
    for (std::size_t a = 0; a < 2; ++a) {
      const double d = a == 0 ? m.fabric.families[0].density : m.fabric.families[1].density;
      const double side = s.area * d * m.families[a].side.stabilisation,
                   held = cells * beta * secant;
      Eigen::VectorXd by_delta = Eigen::VectorXd::Zero(k.rows());
      for (std::size_t j = 0; j < t.size(); ++j) {
        const double share = (j == i ? 1.0 : 0.0) - t[j].area / area;
        const auto at = static_cast<Eigen::Index>(6 * j);
        by_delta.segment<6>(at) += share * t[j].by_lambda[a];
        k.block<6, 6>(at, at) += (side + held) * delta[a] * share * t[j].bend_lambda[a];
      }
      k += (side + held) * by_delta * by_delta.transpose();
      by_s2 += beta * delta[a] * by_delta;
    }
    k += cells * law.gamma_s2 * (by_gamma * by_s2.transpose() + by_s2 * by_gamma.transpose()) +
         cells * law.s2_s2 * by_s2 * by_s2.transpose();
  }

  /// E of a cell by gamma and half of s^2: first derivatives, and second ones by differences.
  struct CellTangent {
    double torque, secant, gamma_gamma, gamma_s2, s2_s2;
  };
  static CellTangent cell_tangent(const ShearLaw& law, double gamma, double s2) {
    constexpr double h = 1e-6; // rad, and rad^2: half of s^2 is not below 0
    const ShearResponse at = law.respond(gamma, s2), after = law.respond(gamma + h, s2),
                        before = law.respond(gamma - h, s2), more = law.respond(gamma, s2 + h),
                        less = law.respond(gamma, std::max(0.0, s2 - h));
    return {at.torque, at.secant, (after.torque - before.torque) / (2.0 * h),
            (after.secant - before.secant) / (2.0 * h),
            2.0 * (more.secant - less.secant) / (h + std::min(h, s2))};
  }

  /// Unknown that column c of a patch's stiffness belongs to: triangles in turn, corners, x and y.
  int unknown(int begin, int c) const {
    const auto e = static_cast<std::size_t>(begin + c / 6);
    const int n = m.triangles[e][c % 6 / 2];
    const int first = freedom[n];
    return first < 0 ? -1 : first + c % 2;
  }

  PlaneState plane_state(const std::vector<Vec3>& x, int triangle) const {
    const auto e = static_cast<std::size_t>(triangle);
    const AxesGradients& c = m.c[e];
    const AxesState f = axes_state(m, x, triangle);
    PlaneState s;
    s.area = m.area[e];
    // axes_state has no sign of the angle beyond 0 to 180 degrees, which is all that occurs
    s.gamma = f.gamma;
    s.by_gamma.setZero();
    s.bend_gamma.setZero();
    const double turn = f.f1.cross(f.f2).z() > 0.0 ? 1.0 : -1.0; // weft to the left of warp
    for (std::size_t a = 0; a < m.families.size(); ++a) {
      const Vec2& of_axes = m.families[a].along;
      const auto in_axes = [&](double c1, double c2) {
        return of_axes.x() * c1 + of_axes.y() * c2;
      };
      const std::array<double, 3> shape{in_axes(-c.c11 - c.c12, -c.c21 - c.c22),
                                        in_axes(c.c11, c.c21), in_axes(c.c12, c.c22)};
      const FamilyState yarn = family_state(f, of_axes);
      s.lambda[a] = yarn.lambda;
      const Vec2 along = yarn.f.head<2>(), across(-along.y(), along.x());
      Vec6 u, v;
      for (std::size_t k = 0; k < 3; ++k) {
        u.segment<2>(static_cast<Eigen::Index>(2 * k)) = shape[k] * along;
        v.segment<2>(static_cast<Eigen::Index>(2 * k)) = shape[k] * across / s.lambda[a];
      }
      s.by_lambda[a] = u;
      s.bend_lambda[a] = s.lambda[a] * v * v.transpose();
      if (a > 1) continue;                              // stitches cross nothing
      const double sign = turn * (a == 0 ? 1.0 : -1.0); // gamma falls with the weft's direction
      s.by_gamma += sign * v;
      s.bend_gamma -= sign / s.lambda[a] * (u * v.transpose() + v * u.transpose());
    }
    return s;
  }

  /// A0 D_g of (G) times the square of the gradient of (T); the rest of its second derivative,
  /// which falls with kappa_g, is left to the iteration. Families without bending are left out.
  void add_turns(const std::vector<Vec3>& x, std::vector<Eigen::Triplet<double>>& entries) const {
    const Bending& b = *bending;
    for (std::size_t n = 0; n < x.size(); ++n)
      for (std::size_t k = 0; k < 2; ++k) {
        const auto begin = static_cast<std::size_t>(b.begin[n]),
                   end = static_cast<std::size_t>(b.begin[n + 1]);
        const double stiffness = b.area[n] * b.in_plane[2 * n + k];
        if (stiffness == 0.0) continue;
        Vec2 d = Vec2::Zero(), s = d;
        for (std::size_t i = begin; i < end; ++i) {
          const Vec2 at = x[b.node[i]].head<2>();
          d += b.a[i][k] * at, s += b.b[i][k] * at;
        }
        const Vec2 across = Vec2(-d.y(), d.x()) / d.squaredNorm();
        const Vec2 q = s / d.squaredNorm() - 2.0 * s.dot(across) * across, turned(q.y(), -q.x());
        for (std::size_t i = begin; i < end; ++i)
          for (std::size_t j = begin; j < end; ++j) {
            const int row = freedom[b.node[i]], column = freedom[b.node[j]];
            if (row < 0 || column < 0) continue;
            const Vec2 gi = b.b[i][k] * across + b.a[i][k] * turned,
                       gj = b.b[j][k] * across + b.a[j][k] * turned;
            for (int r = 0; r < 4; ++r)
              entries.emplace_back(row + r / 2, column + r % 2, stiffness * gi[r / 2] * gj[r % 2]);
          }
      }
  }

  /// K^-1 f, with as much added to the diagonal as makes K positive; `damping` keeps it.
  Eigen::VectorXd newton(const std::vector<Vec3>& x, const Eigen::VectorXd& force,
                         double& damping) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (int p = 0; p < m.groups(); ++p)
      add_patch(x, p, entries);
    if (bending) add_turns(x, entries);
    Eigen::SparseMatrix<double> stiffness(freedoms, freedoms), one(freedoms, freedoms);
    stiffness.setFromTriplets(entries.begin(), entries.end());
    one.setIdentity();
    for (; damping < 1e6; damping = std::max(1e-4, 10.0 * damping)) {
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(stiffness + damping * one);
      if (solver.info() == Eigen::Success && solver.vectorD().minCoeff() > 0.0)
        return solver.solve(force);
    }
    throw std::runtime_error("no tangent");
  }

  Membrane m;
  std::optional<Bending> bending;
  std::vector<YarnMemory> states; ///< of yarns, as memory_at_start
  std::vector<int> freedom;       ///< first of a node's two unknowns, or -1
  int freedoms = 0;
};

/// Load (N) of the bias test of a strip (mm) with yarns at 45 degrees to the pull, when (40) says
/// that the middle zone is sheared by `angles` (rad, ascending). The first family lies at `warp`
/// (rad) to the pull: at 45 degrees the angle between them opens, at -45 it closes.
inline std::vector<double> bias_loads(const BlankMesh& mesh, const Fabric& fabric, double length,
                                      double width, ElementKind element,
                                      const std::vector<double>& angles, double accuracy = 1e-10,
                                      double warp = 0.25 * std::numbers::pi) {
  std::vector<char> held, pulled;
  std::vector<Vec3> x, start;
  for (const Vec2& p : mesh.x) {
    x.emplace_back(p.x(), p.y(), 0.0);
    pulled.push_back(p.x() > 0.5 * length - 1e-9 * length);
    held.push_back(pulled.back() || p.x() < -0.5 * length + 1e-9 * length);
  }
  start = x;
  Fabric unbroken = fabric;
  std::vector<double> breaking_strain;
  for (Stitch& s : unbroken.stitches) {
    breaking_strain.push_back(s.law.breaking_strain());
    if (std::isfinite(s.law.breaking_force)) s.law.breaking_force = 1e300;
  }
  Membrane membrane = make_membrane(mesh, unbroken, warp, element);
  std::optional<Bending> bending;
  if (const BendingLaw law = bending_law(fabric); law.in_plane())
    bending = make_bending(mesh.x, mesh.triangles, law, warp, warp + fabric.families[1].angle,
                           membrane.node_mass);
  FlatMembrane strip(std::move(membrane), held, std::move(bending));
  std::vector<double> loads;
  double before = 0.0, before_step = 0.0, angle = 0.0;
  std::vector<Vec3> last = x;
  for (const double wanted : angles) {
    const int parts = static_cast<int>(std::ceil((wanted - angle) / 0.09)); // 5 degrees
    for (int i = 1; i <= parts; ++i) {
      const double a = angle + (wanted - angle) * i / parts;
      const double stroke =
          (length - width) *
          (std::numbers::sqrt2 * std::cos(0.25 * std::numbers::pi - 0.5 * a) - 1.0);
      const std::vector<Vec3> now = x;
      for (std::size_t n = 0; n < x.size(); ++n) {
        // first guess: evenly drawn out, then on along the last step
        if (before == 0.0)
          x[n].x() += stroke * (start[n].x() / length + 0.5);
        else
          x[n] += (x[n] - last[n]) * ((stroke - before) / before_step);
        if (pulled[n]) x[n] = start[n] + Vec3(stroke, 0.0, 0.0);
      }
      last = now;
      before_step = stroke - before;
      before = stroke;
      strip.relax_and_break(x, breaking_strain, accuracy);
    }
    angle = wanted;
    const std::vector<Vec3> f = strip.nodal(x);
    double load = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n)
      if (pulled[n]) load -= f[n].x();
    loads.push_back(load);
  }
  return loads;
}

} // namespace plyform
