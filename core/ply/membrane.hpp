// SPDX-License-Identifier: GPL-3.0-or-later
// The semi-discrete three-node membrane of Hamila and Boisse (2008), in energy form, for any number
// of families of yarns, crossings between them, and a law of the sheet beside them. Stitches are
// families too, behind those of yarns, which cross none and have neither s_a nor g_a.
//
//               2
//              / \               0 1 2  nodes, anticlockwise seen from the upper side
//             /   \              f_a    unit vector along the yarns of family a
//            /     \             omega  angle from f_a to f_b of two families that cross
//           /   ^   \            f_a and omega are constant in a triangle
//          /   / f_b \           and change as it deforms. Before forming
//         /   / ) omega          the yarns may lie at any angle to its sides
//        /   +----> f_a\         and to each
//       /               \        other.
//      0-----------------1
//
//   x_n      mm      positions of the triangle's nodes, n = 0 1 2
//   e_i              material axes, i = 1 2: two directions of the sheet before forming, those of
//                    the two families of a weave (MaterialAxes of core/model/fabric.hpp)
//   c_i,n    1/mm    gradient of N_n along e_i, sums to 0 over n
//   k_i      -       image of e_i, k_i = sum_n c_i,n x_n                                    (1)(11)
//   v_a,i    -       components of a family's direction before forming: e_a = sum_i v_a,i e_i
//   k_a      -       its image, k_a = sum_i v_a,i k_i
//   lambda_a -       |k_a|;  eps_a = lambda_a - 1;  f_a = k_a / lambda_a
//   omega    rad     angle from f_a to f_b, omega0 before forming; gamma = omega0 - omega
//   N_a      N       tension of one yarn;  Cs  N mm  torque of one unit cell of a crossing
//   d_a      1/mm    yarns per mm;  n_c = d_a d_b sin(omega0)  1/mm^2  unit cells per area
//   psi      N/mm    energy per area of the sheet's law (core/model/sheet_law.hpp)
//   A0       mm^2    initial area
//
//   P        -       group: a pair of triangles that share a mean strain, or one alone
//   A        mm^2    sum of A0 over the group; mean: average over the group weighted by area
//   delta_a  -       eps_a - mean eps_a, zero for a triangle alone
//   g_c      rad     sqrt(gamma^2 + beta (delta_a^2 + delta_b^2)): deviations count as shear of the
//                    crossings of their families; without crossing the sheet's law resists them
//   beta     -       8
//   f        -       what the temperature of a triangle makes of its Cs and Es:
//                    Fabric::shear_over_temperature
//   s_a      N       stabilisation of the deviations, for fabrics without shear stiffness: 1e-6 of
//                    the yarn stiffness, and, if there is shear stiffness, no more than a tenth of
//                    the stiffness sum_c n_c beta p / d_a that it gives the deviations at half a
//                    radian, of the softer side; else very stiff yarns would lock
//   g_a      N       collapse penalty, against folding a triangle flat, acts below a stretch of one
//                    half: 1e-3 of the yarn stiffness, and no more than the (softened) yarn's own,
//                    which is slack there unless it bears compression or its group is taut
//
// clang-format off
//   E_P = A sum_a d_a W_a(mean eps_a)             (yarns with crimp: core/ply/membrane_crimp.hpp)
//         + sum over P of A0 [ sum_c n_c Es(gamma, g_c) + psi
//                              + sum_a d_a ( s_a/2 delta_a^2 + g_a/2 max(0, 1/2 - lambda_a)^2 ) ]  (E)
//   p   = Cs(g_c) / g_c, N mm: secant stiffness of a cell;  t_a = sum_c n_c beta p delta_a / d_a
//   T   = p gamma, N mm: torque of a cell
//   N_a = W_a'(mean eps_a) + s_a delta_a + t_a - mean t_a - g_a max(0, 1/2 - lambda_a)             (N)
//   p_a = A0 [ d_a N_a f_a + sum_c n_c T (f_b - cos(omega) f_a) / (lambda_a sin(omega)) ]          (P)
//   q_i = sum_a v_a,i p_a + A0 dpsi/dk_i                                                           (Q)
//   F_n = -( c_1,n q_1 + c_2,n q_2 )                                                   (31)(32)(39)(F)
// clang-format on
//
// Es = Ws(g_c) of a law that is odd. Of one of both signs Es, p and T are E, p and the torque of
// (C) and (D) of core/model/shear_law.hpp, with s^2 = g_c^2 - gamma^2.
//
// Sums over a run over all families, sums over c over all crossings (in (P), those of family a).
// Numbers in brackets: the corresponding equations of the paper. With two families and groups of
// one triangle this is the paper's element exactly, except for the collapse penalty, which acts
// only where no result is valid; for omega0 = 90 degrees (Q) is then the sum of (31), (32) and
// (39). The element only needs k_1 and k_2, so the fibres may lie at any angle to the sides and to
// each other.
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
#include "core/ply/shear_pieces.hpp"

#include <optional>
#include <span>
#include <vector>

namespace plyform {

constexpr double deviation_weight = 8.0; ///< beta of (E)

/// Constants of the material axes in one triangle: c_i,1 and c_i,2 (c_i,0 = -c_i,1 - c_i,2).
struct AxesGradients {
  double c11, c12, c21, c22;
};

/// Internal force of a triangle: q_1, q_2 of (Q), N mm, conjugate to k_1, k_2.
struct ElementForce {
  Vec3 q1, q2;
};

/// Stiffnesses of one family besides that of the yarn: s_a and g_a, N.
struct SideStiffness {
  double stabilisation = 0.0, collapse_penalty = 0.0;
};

/// One number a family.
using OfFamilies = std::array<double, most_families>;

/// A family of yarns, or of stitches, in a membrane.
struct MembraneFamily {
  Vec2 along = Vec2::UnitX(); ///< v_a
  double density = 0.0;       ///< d_a, 1/mm
  /// W_a: that of the fabric, softened; of stitches its slopes only, not softened
  TensionLaw yarn;
  double softening = 1.0; ///< by this: effective_softening
  double viscosity = 0.0; ///< eta, N s per yarn, in tension only: N += eta d(eps)/dt
  SideStiffness side;
  std::optional<StitchLaw> stitch;         ///< W_a of stitches
  std::optional<MaxwellBranch> relaxation; ///< of yarns, softened likewise
  /// Whether a crossing's cell gives its tension: core/ply/membrane_crimp.hpp.
  bool crimped = false;
  /// Its law: refers to this family.
  AnyYarnLaw law() const {
    if (stitch) return StitchYarn{*stitch};
    return yarn_law(yarn, relaxation, viscosity, crimped);
  }
  /// W_a of a yarn, or of a stitch that is whole; of crimped yarns without their cells.
  LawPoint elastic(double strain) const { return stitch ? stitch->at(strain) : yarn.at(strain); }
};

/// A crossing of two families in a membrane.
struct MembraneCrossing {
  std::size_t first = 0, second = 1; ///< families a and b
  double omega0 = 0.0;               ///< rad
  double cells = 0.0;                ///< n_c, 1/mm^2
  ShearLaw shear;                    ///< Cs
  bool is_axes = false;              ///< whether its families are the axes, in their order
  double steepest = 0.0;             ///< N mm, largest slope of a table
  ShearTable table{};                ///< of one: what the kernel looks up
  std::optional<CrimpedCell> crimp{};
  /// N mm, of one that resists by rates (core/ply/viscous_membrane.hpp): springs in line with its
  /// dashpot, for shear and for deviations, and the sum of the moduli of its branches.
  double spring = 0.0, deviation_spring = 0.0, branches = 0.0;
  /// The largest factor of Cs that temperatures may come to, for the stable step.
  double stiffest = 1.0;
};

/// What the yarns of one family in one strain group remember from step to step: the states of
/// core/model/yarn_law.hpp at their mean strain.
using YarnMemory = std::array<double, yarn_states>;

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
  Fabric fabric;                        ///< as given, not softened
  std::vector<MembraneFamily> families; ///< those of the fabric, then its stitches
  std::vector<MembraneCrossing> crossings;
  bool crimped = false; ///< whether any of them has crimp
  /// N/mm, springs in line with the dashpots of a melt (core/ply/viscous_membrane.hpp): for shear
  /// along yarns and for drawing them apart.
  double matrix_spring = 0.0;
  double process_time = 1.0;   ///< s of the process in each simulated second: Case::process_time
  double omega0 = 0.0;         ///< rad, between the axes before forming
  Vec2 across = Vec2::UnitY(); ///< components of the direction across e_1
  std::vector<Triangle> triangles;       ///< m, those of a strain group successive
  std::vector<std::int32_t> group_begin; ///< groups + 1, into triangles
  std::vector<AxesGradients> c;          ///< m
  std::vector<double> area;              ///< m, A0
  std::vector<double> node_area;         ///< n, mm^2, a third of the triangles around the node
  std::vector<double> node_mass;         ///< n, t, with what density_factor adds
  /// m, factor of each triangle's mass (core/solver/element_mass_scaling.hpp); empty: 1
  std::vector<double> density_factor;
  std::vector<std::int32_t> gather_begin; ///< n + 1, into gather
  std::vector<std::int32_t> gather;       ///< per node: 3 * triangle + corner, ascending

  /// t, of the cloth alone at a node.
  double cloth_mass(std::size_t n) const { return fabric.surface_density * node_area[n]; }
  /// What a law of its yarns is asked. per_dt: 1/s, inverse of the simulated step.
  LawInput input(double strain, double per_dt, const LawPoint& cell = {},
                 double time_factor = 1.0) const {
    return {strain, per_dt, per_dt / process_time, cell, time_factor};
  }
  int groups() const { return static_cast<int>(group_begin.size()) - 1; }
};

/// The images of the material axes in one triangle.
struct AxesState {
  Vec3 f1, f2;             ///< unit vectors
  double lambda1, lambda2; ///< stretches
  double cos_omega, sin_omega, gamma;
  Vec3 k1() const { return lambda1 * f1; }
  Vec3 k2() const { return lambda2 * f2; }
};

/// The yarns of a family in one triangle.
struct FamilyState {
  Vec3 f;        ///< unit vector
  double lambda; ///< stretch
};

/// Two directions that cross in one triangle.
struct CrossingState {
  double cos_omega, sin_omega, gamma;
};

/// Builds the membrane of a ply. angle: rad from x, of the ply. The yarns of `fabric` are softened
/// by `softening` as far as effective_softening allows; s_a and g_a follow the stiffness before
/// softening. With `kind` automatic the triangles that along_fibres (core/mesh/pairs.hpp) marks are
/// plain, the others averaged; a fabric without yarns is plain. Triangles are reordered by strain
/// group. Throws std::invalid_argument for triangles of zero or negative area, too many families or
/// crossings (most_families, most_crossings), and crimped families of not equally many cells.
Membrane make_membrane(const BlankMesh& mesh, const Fabric& fabric, double angle, ElementKind kind,
                       double softening = 1.0);

/// (1), (11): the axes in a triangle. x: positions, mm, n.
AxesState axes_state(const Membrane& m, std::span<const Vec3> x, int triangle);

/// The yarns of a family whose components are `along`.
inline FamilyState family_state(const AxesState& axes, const Vec2& along) {
  if (along.y() == 0.0 && along.x() == 1.0) return {axes.f1, axes.lambda1};
  if (along.x() == 0.0 && along.y() == 1.0) return {axes.f2, axes.lambda2};
  const Vec3 k = along.x() * axes.k1() + along.y() * axes.k2();
  const double lambda = k.norm();
  return {k / lambda, lambda};
}

/// A triangle with its yarns and crossings, as many as there are.
struct TriangleState {
  AxesState axes;
  std::array<FamilyState, most_families> yarn;
  std::array<CrossingState, most_crossings> crossing;
};

/// Fills the state of a triangle. x: mm, n.
void find_triangle(const Membrane& m, std::span<const Vec3> x, int triangle, TriangleState& t);

/// rad, what is shown as shear of a triangle: gamma of the first crossing; of a fabric without one
/// the change of the right angle between e_1 and the line across it.
double shown_shear(const Membrane& m, const TriangleState& t);

/// Two directions with these unit vectors, omega0 (rad) apart before forming.
CrossingState crossing_state(const Vec3& f_a, const Vec3& f_b, double omega0);

/// Slope of Cs, N mm, on which the stable step relies at shear angle gamma (rad): of a table the
/// largest of all, so that no row comes as a surprise; of a polynomial that of the steeper side at
/// this angle. At the temperature at which the crossing is stiffest, as what follows.
double shear_slope(const MembraneCrossing& c, double gamma);

/// Stiffness per area, N/mm, that a crossing gives the deviations in (E) at shear angle gamma
/// (rad): beta n_c times the larger of shear_slope and Cs(gamma)/gamma, of the stiffer side.
double deviation_stiffness(const MembraneCrossing& c, double gamma);

/// Yarn strains of each family in all m triangles: mean eps_a of the strain group of each. x: mm,
/// n.
std::vector<std::vector<double>> yarn_strains(const Membrane& m, std::span<const Vec3> x);

/// Tensions (N per yarn) of each family in all m triangles, for output. For triangles alone W_a' at
/// their strain. Those of pairs oscillate from pair to pair, as do the multipliers of any element
/// with as many constraints as degrees of freedom: they are smoothed by two passes of nodal
/// averages, as is usual for the pressures of such elements (docs/verification/locking.md). Of
/// stitches that are whole, and not smoothed: they are soft. x: mm, n. states: what yarns remember,
/// as memory_at_start, for those with rates; empty: elastic tensions.
std::vector<std::vector<double>> yarn_tensions(const Membrane& m, std::span<const Vec3> x,
                                               std::span<const YarnMemory> states = {});

/// Whether a triangle has collapsed: shrunk to a tenth along an axis, or the axes within 1.1
/// degrees of parallel, which a triangle that inverts in its plane passes through. Limits:
/// element_limits.hpp.
bool collapsed(const AxesState& state);

/// Report of a force computation over some groups.
struct GroupReport {
  double lost = 0.0;      ///< N mm, dissipated by damping of the yarns in the step that led to x
  double torn = 0.0;      ///< N mm, stored before in stitches that broke in it
  double flowed = 0.0;    ///< N mm, dissipated in it by laws of yarns with rates
  bool collapsed = false; ///< whether a triangle has collapsed
};

/// What yarns remember at the start: families of the first strain group, of the second ...
std::vector<YarnMemory> memory_at_start(const Membrane& m);

/// (Q) for groups [begin, end) at positions x (mm, n), viscous forces included. dt: s, the time
/// step that led to x; 0 leaves rates out. states: as memory_at_start. q: N mm, m, of which those
/// of the groups are written. shear_factors: m, what temperatures make of Cs; empty: 1.
GroupReport element_forces(const Membrane& m, std::span<const Vec3> x, double dt, int begin,
                           int end, const LawStates<YarnMemory>& states, std::span<ElementForce> q,
                           std::span<const double> shear_factors = {});

/// (F): internal force on a node, N, from all its triangles in fixed order.
Vec3 node_force(const Membrane& m, std::span<const ElementForce> q, int node);

/// Energy of the fibres (with stabilisation and collapse penalty), of shear and of stitches. All
/// energy of a sheet's law counts as shear.
struct MembraneEnergy {
  double fibre = 0.0, shear = 0.0, stitch = 0.0; ///< N mm
};
/// (E) summed over all triangles. x: mm, n. states: what yarns remember of the begin of the step dt
/// (s) that led to x, as memory_at_start; empty: from the start. shear_factors: as element_forces.
MembraneEnergy membrane_energy(const Membrane& m, std::span<const Vec3> x,
                               std::span<const YarnMemory> states = {}, double dt = 0.0,
                               std::span<const double> shear_factors = {});

} // namespace plyform
