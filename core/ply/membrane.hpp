// SPDX-License-Identifier: GPL-3.0-or-later
// The semi-discrete three-node membrane of Hamila and Boisse (2008), in energy form.
//
//               2
//              / \               0 1 2  nodes, anticlockwise seen from the upper side
//             /   \              f_1    unit vector along the warp yarns
//            /     \             f_2    unit vector along the weft yarns
//           /   ^   \            omega  angle from f_1 to f_2
//          /   / f_2 \           f_1, f_2 and omega are constant in a triangle and
//         /   / ) omega          change as it deforms. Before forming warp and weft
//        /   +----> f_1\         may lie at any angle to its sides and to each
//       /               \        other.
//      0-----------------1
//
//   x_n      mm      positions of the triangle's nodes, n = 0 1 2
//   c_a,n    1/mm    gradient of N_n along fibre family a (1 warp, 2 weft), sums to 0 over n
//   k_a      -       k_a = sum_n c_a,n x_n                                              (1)(11)
//   lambda_a -       |k_a|;  eps_a = lambda_a - 1;  f_a = k_a / lambda_a
//   omega    rad     angle from f_1 to f_2, omega0 before forming; gamma = omega0 - omega
//   N_a      N       tension of one yarn;  Cs  N mm  torque of one unit cell
//   d_a      1/mm    yarns per mm;  n_c = d_1 d_2 sin(omega0)  1/mm^2  unit cells per area
//   A0       mm^2    initial area
//
//   P        -       group: a pair of triangles that share a mean strain, or one alone
//   A        mm^2    sum of A0 over the group; mean: average over the group weighted by area
//   delta_a  -       eps_a - mean eps_a, zero for a triangle alone
//   g        rad     sqrt(gamma^2 + beta (delta_1^2 + delta_2^2)): deviations count as shear
//   beta     -       8
//   s_a      N       stabilisation of the deviations, for fabrics without shear stiffness: 1e-6 of
//                    the yarn stiffness, and, if there is shear stiffness, no more than a tenth of
//                    the stiffness n_c beta p / d_a that it gives the deviations at half a radian;
//                    else very stiff yarns would lock
//   g_a      N       collapse penalty, against folding a triangle flat, acts below a stretch of one
//                    half: 1e-3 of the yarn stiffness, and no more than the (softened) yarn's own,
//                    which is slack there unless it bears compression or its group is taut
//
// clang-format off
//   E_P = A [ d_1 W_1(mean eps_1) + d_2 W_2(mean eps_2) ]
//         + sum over P of A0 [ n_c Ws(g) + sum_a d_a ( s_a/2 delta_a^2
//                                                    + g_a/2 max(0, 1/2 - lambda_a)^2 ) ]    (E)
//   p   = Cs(g) / g, N mm: secant stiffness of the cell;  t_a = n_c beta p delta_a / d_a
//   N_a = W_a'(mean eps_a) + s_a delta_a + t_a - mean t_a - g_a max(0, 1/2 - lambda_a)       (N)
//   q_a = A0 [ d_a N_a f_a + n_c p gamma (f_b - cos(omega) f_a) / (lambda_a sin(omega)) ]    (Q)
//   F_n = -( c_1,n q_1 + c_2,n q_2 )                                            (31)(32)(39)(F)
// clang-format on
//
// Numbers in brackets: the corresponding equations of the paper. With groups of one triangle this
// is the paper's element exactly, except for the collapse penalty, which acts only where no result
// is valid; for omega0 = 90 degrees (Q) is then the sum of (31), (32) and (39). The element only
// needs k_1 and k_2, so the fibres may lie at any angle to the sides and to each other.
//
// Why pairs: two stiff fibre strains per triangle are about four constraints per node, twice the
// number of its in-plane degrees of freedom; the mesh locks unless sides run along both families.
// One mean strain per family and pair of triangles leaves two constraints per node. By convexity a
// pair is never stiffer than its triangles. Why deviations count as shear: the modes that a pair
// leaves unconstrained (hourglass-like) must cost as much energy as the shear that they could
// replace, at any shear angle, and no more: docs/tried.md has figures.
#pragma once

#include "base/geometry.hpp"
#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"
#include "core/model/yarn_law.hpp"

#include <span>
#include <vector>

namespace plyform {

constexpr double deviation_weight = 8.0; ///< beta of (E)

/// Fibre family constants of one triangle: c_a,1 and c_a,2 (c_a,0 = -c_a,1 - c_a,2).
struct FibreGradients {
  double c11, c12, c21, c22;
};

/// Internal force of a triangle: q_1, q_2 of (Q), N mm, conjugate to k_1, k_2.
struct ElementForce {
  Vec3 q1, q2;
};

/// Fibre viscosity, in tension only: N += eta d(eps)/dt, eta in N s per yarn.
struct FibreViscosity {
  double warp = 0.0, weft = 0.0;
};

/// Stiffnesses of one family besides that of the yarn: s_a and g_a, N.
struct SideStiffness {
  double stabilisation = 0.0, collapse_penalty = 0.0;
};

/// What the yarns of one strain group remember from step to step, warp and weft: the states of
/// core/model/yarn_law.hpp at their mean strain.
using YarnMemory = std::array<std::array<double, yarn_states>, 2>;

/// What the laws at the points of a ply remember: at the begin of a step, which its forces read,
/// and at its end, which they write. Where both are the same array, each evaluation is a step.
template <class State>
struct LawStates {
  std::span<const State> begin;
  std::span<State> end;
};

/// One ply's membrane; nodes and triangles are numbered within the ply. Constant. Sizes: n nodes,
/// m triangles.
struct Membrane {
  Fabric fabric;                             ///< as given, not softened
  std::array<TensionLaw, 2> yarn;            ///< W_a of warp and weft: those of `fabric`, softened
  std::array<double, 2> softening{1.0, 1.0}; ///< factors of that: effective_softening
  double omega0 = 0.0;                       ///< rad
  double cells_per_area = 0.0;               ///< n_c, 1/mm^2
  FibreViscosity viscosity;
  double process_time = 1.0; ///< s of the process in each simulated second: Case::process_time
  std::array<SideStiffness, 2> side{};   ///< warp, weft
  std::vector<Triangle> triangles;       ///< m, those of a strain group successive
  std::vector<std::int32_t> group_begin; ///< groups + 1, into triangles
  std::vector<FibreGradients> c;         ///< m
  std::vector<double> area;              ///< m, A0
  std::vector<double> node_area;         ///< n, mm^2, a third of the triangles around the node
  std::vector<double> node_mass;         ///< n, t, with what density_factor adds
  /// m, factor of each triangle's mass (core/solver/element_mass_scaling.hpp); empty: 1
  std::vector<double> density_factor;
  std::vector<std::int32_t> gather_begin; ///< n + 1, into gather
  std::vector<std::int32_t> gather;       ///< per node: 3 * triangle + corner, ascending

  /// t, of the cloth alone at a node.
  double cloth_mass(std::size_t n) const { return fabric.surface_density * node_area[n]; }
  /// The law of the yarns of a family: refers to this membrane.
  AnyYarnLaw law(std::size_t family) const {
    return yarn_law(yarn[family], family == 0 ? viscosity.warp : viscosity.weft);
  }
  /// What it is asked. per_dt: 1/s, inverse of the simulated step.
  LawInput input(double strain, double per_dt) const {
    return {strain, per_dt, per_dt / process_time};
  }
  int groups() const { return static_cast<int>(group_begin.size()) - 1; }
};

/// Strains and directions of one triangle.
struct FibreState {
  Vec3 f1, f2;             ///< unit vectors
  double lambda1, lambda2; ///< stretches
  double cos_omega, sin_omega, gamma;
};

/// Builds the membrane of a ply. warp_angle: rad from x. The yarns of `fabric` are softened by
/// `softening` as far as effective_softening allows; s_a and g_a follow the stiffness before
/// softening. With `kind` automatic the triangles that along_fibres (core/mesh/pairs.hpp) marks are
/// plain, the others averaged. Triangles are reordered by strain group. Throws
/// std::invalid_argument for a triangle of zero or negative area.
Membrane make_membrane(const BlankMesh& mesh, const Fabric& fabric, double warp_angle,
                       ElementKind kind, double softening = 1.0);

/// (1), (11): strains and directions of a triangle. x: positions, mm, n.
FibreState fibre_state(const Membrane& m, std::span<const Vec3> x, int triangle);

/// Stiffness per area, N/mm, of the deviations in (E) at shear angle gamma (rad): beta n_c times
/// the larger of Cs'(gamma) and Cs(gamma)/gamma.
double deviation_stiffness(const Membrane& m, double gamma);

/// Yarn strains {warp, weft} of all m triangles: mean eps_a of the strain group of each. x: mm, n.
std::vector<std::array<double, 2>> yarn_strains(const Membrane& m, std::span<const Vec3> x);

/// Tensions {warp, weft} (N per yarn) of all m triangles, for output. For triangles alone W_a' at
/// their strain. Those of pairs oscillate from pair to pair, as do the multipliers of any element
/// with as many constraints as degrees of freedom: they are smoothed by two passes of nodal
/// averages, as is usual for the pressures of such elements (docs/verification/locking.md). x: mm,
/// n.
std::vector<std::array<double, 2>> yarn_tensions(const Membrane& m, std::span<const Vec3> x);

/// Whether a triangle has collapsed: shrunk to a tenth along a yarn, or the yarns within 1.1
/// degrees of parallel, which a triangle that inverts in its plane passes through. Limits:
/// element_limits.hpp.
bool collapsed(const FibreState& state);

/// Report of a force computation over some groups.
struct GroupReport {
  double lost = 0.0;      ///< N mm, dissipated by the yarns in the step that led to x
  bool collapsed = false; ///< whether a triangle has collapsed
};

/// What yarns remember at the start, one per strain group.
std::vector<YarnMemory> memory_at_start(const Membrane& m);

/// (Q) for groups [begin, end) at positions x (mm, n), viscous forces included. dt: s, the time
/// step that led to x; 0 leaves rates out. states: one per group, not used by a sheet
/// without yarns. q: N mm, m, of which those of the groups are written.
GroupReport element_forces(const Membrane& m, std::span<const Vec3> x, double dt, int begin,
                           int end, const LawStates<YarnMemory>& states, std::span<ElementForce> q);

/// (F): internal force on a node, N, from all its triangles in fixed order.
Vec3 node_force(const Membrane& m, std::span<const ElementForce> q, int node);

/// Energy of the fibres (with stabilisation and collapse penalty) and of shear. All energy of a
/// sheet without yarns counts as shear.
struct MembraneEnergy {
  double fibre = 0.0, shear = 0.0; ///< N mm
};
/// (E) summed over all triangles. x: mm, n. states: what yarns remember of the begin of the step dt
/// (s) that led to x, one per group; empty: from the start.
MembraneEnergy membrane_energy(const Membrane& m, std::span<const Vec3> x,
                               std::span<const YarnMemory> states = {}, double dt = 0.0);

} // namespace plyform
