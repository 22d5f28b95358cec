// SPDX-License-Identifier: GPL-3.0-or-later
// A fabric: families of parallel yarns with their laws of tension and bending, crossings of two of
// them with a law of shear, stitches, and a law of the sheet beside them. A weave has two families,
// warp and weft, and one crossing; a non-crimp fabric has stitches too; a unidirectional fabric one
// family and a sheet law; a triaxial one three and three; a foil a sheet law alone.
//
// Units inside the program: mm, N, s, t (1 t = 1 N s^2/mm). Source of the law's form: Hamila and
// Boisse 2008, section 3.5 and table 1.
#pragma once

#include "base/geometry.hpp"
#include "core/model/compaction.hpp"
#include "core/model/crimp.hpp"
#include "core/model/shear_law.hpp"
#include "core/model/sheet_law.hpp"
#include "core/model/temperature.hpp"
#include "core/model/viscous_shear.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plyform {

/// Tangent stiffness of a buckled yarn over its compression stiffness: small, but large enough that
/// further shortening does not localise in one row of elements.
constexpr double buckled_share = 0.01;

/// Tension of one yarn against its strain: N = stiffness * strain, or a table. For strain <= 0
/// N = compression * strain; with compression 0, the paper's law, exactly zero. Compressed by more
/// than buckling_force, i.e. at strains below -buckling_force / compression, the slope is
/// buckled_share times that; unloading follows the same path (nonlinear elastic).
struct TensionLaw {
  double stiffness = 0.0;              ///< N per yarn; used when the table is empty
  std::vector<double> strain, tension; ///< ascending from (0, 0), linear between, last slope beyond
  /// N per yarn; at most largest_slope(), on which the stable step relies
  double compression = 0.0;
  double buckling_force = std::numeric_limits<double>::infinity(); ///< N, at least 0
  bool operator==(const TensionLaw&) const = default;
  /// N (N per yarn), dN/dstrain (N), W = integral of N (N, i.e. N mm per mm of yarn).
  LawPoint at(double eps) const;
  double largest_slope() const; ///< N, in tension
  /// The least strain with this tension (N, at least 0); infinite if there is none.
  double strain_at(double force) const;
  /// Whether the law has no table: stiffness, compression and buckling_force define it.
  bool linear() const { return strain.empty(); }
  bool buckles() const { return compression > 0.0 && std::isfinite(buckling_force); }
  double buckling_strain() const { return buckling_force / compression; } ///< of one that buckles
};

/// Factor by which a yarn's tension is actually divided if a softening of `asked` (at least 1) is
/// requested: limited so that the yarn stays as stiff in tension as in compression, which is never
/// softened. More would not lengthen the stable time step, which the stiffer of the two determines.
double effective_softening(const TensionLaw& law, double asked);

/// The law of a yarn effective_softening(law, asked) times as soft in tension. Compression is not
/// changed.
TensionLaw softened(TensionLaw law, double asked);

/// Moment per width against curvature, odd: M = stiffness * kappa, or a table for kappa >= 0.
struct MomentLaw {
  double stiffness = 0.0;                ///< N mm (per mm of width: N mm^2/mm)
  std::vector<double> curvature, moment; ///< 1/mm and N, ascending from (0, 0); last slope beyond
  bool operator==(const MomentLaw&) const = default;
  /// M (N), dM/dkappa (N mm), W (N/mm); kappa in 1/mm, of either sign.
  LawPoint at(double kappa) const;
  double largest_slope() const; ///< N mm
};

/// Bending of one family of yarns, or of a plate along one direction.
struct FamilyBending {
  Vec2 along = Vec2::UnitX(); ///< v: direction in the fabric's axes, MaterialAxes
  MomentLaw law;              ///< per width across it
  double in_plane = 0.0;      ///< D_g, N mm
  double viscosity = 0.0;     ///< N mm s, moment by the rate of the process: viscous_bending.hpp
  /// Its curvature from those in the axes, kappa_11, kappa_22 and kappa_12: the sum of the
  /// products.
  Vec3 of_axes() const {
    return {along.x() * along.x(), along.y() * along.y(), 2.0 * along.x() * along.y()};
  }
};

/// A melt around yarns of one direction, which hardly strain along them: an incompressible fluid
/// that they make directed (core/ply/viscous_membrane.hpp).
struct ViscousMatrix {
  double longitudinal = 0.0, transverse = 0.0; ///< N s/mm^2, of shear along the yarns and across
  bool operator==(const ViscousMatrix&) const = default;
};

/// Bending of a sheet: core/ply/bending.hpp (M). Nothing: none.
struct BendingLaw {
  std::vector<FamilyBending> families;
  double coupling = 0.0, twist = 0.0; ///< D_c, D_t, N mm, of the curvatures in the fabric's axes
  bool any() const;
  bool in_plane() const; ///< whether any family has D_g
  /// N mm, moments m_11, m_22, m_12 against curvatures in the axes: at no curvature, and the
  /// largest.
  Eigen::Matrix3d stiffness_at_rest() const;
  Eigen::Matrix3d largest_stiffness() const;
};

/// Where a number of a fabric comes from.
enum class ValueSource {
  given,     ///< in the fabric file, or by the code that made the fabric
  missing,   ///< not in the fabric file; the property is then zero
  estimated, ///< was missing and has been estimated: core/model/fabric_estimates.hpp
};

/// Sources of those properties of one family of yarns that a file may leave out.
struct YarnSources {
  ValueSource compression = ValueSource::given, bending = ValueSource::given,
              in_plane_bending = ValueSource::given;
};

/// mm/s^2, turns mass per area into weight.
inline constexpr double standard_gravity = 9810.0;

/// Yarns that lie parallel to each other in the fabric before forming.
struct YarnFamily {
  std::string name; ///< in files and columns of results: warp, weft ...
  /// rad, from the ply's angle to these yarns; of a fabric's families within half a turn from the
  /// first one's on
  double angle = 0.0;
  double density = 0.0; ///< d, yarns per mm across the yarns
  TensionLaw tension;   ///< of one yarn
  /// Beside it, of one yarn, modulus in N: core/model/relaxing_yarn.hpp.
  std::optional<MaxwellBranch> relaxation;
  MomentLaw bending;              ///< M, per width across the yarns
  double in_plane_bending = 0.0;  ///< D_g, N mm
  double bending_viscosity = 0.0; ///< N mm s, moment per width by the rate of curvature
  /// Change of the distance between neighbouring yarns, over what it was, beyond which they gape.
  std::optional<double> opening_limit;
  YarnSources sources;
};

/// Force of a stitch against its strain, that of the sheet along it: `tension` of what the strain
/// is beyond `taut_at`. It pushes nowhere.
struct StitchLaw {
  TensionLaw tension;   ///< of one stitch, without compression
  double taut_at = 0.0; ///< strain at which it becomes taut; below 0: it pulls from the start
  double breaking_force = std::numeric_limits<double>::infinity(); ///< N, above the force at rest
  bool operator==(const StitchLaw&) const = default;
  LawPoint at(double eps) const { return tension.at(eps - taut_at); } ///< of one that is whole
  double breaking_strain() const; ///< infinite if it never breaks
};

/// Stitches that lie parallel to each other in the fabric before forming. They move with the sheet,
/// and bear tension alone: no axis of the fabric, no crossing and no bending goes by them.
struct Stitch {
  std::string name;
  double angle = 0.0;   ///< rad, from the ply's angle
  double density = 0.0; ///< d, stitches per mm across them
  StitchLaw law;        ///< of one stitch
};

/// Two families that resist a change of the angle between them.
struct Crossing {
  std::size_t first = 0, second = 1; ///< indices into Fabric::families
  ShearLaw shear;                    ///< torque of one unit cell
  /// Tension of both families by the cell that their yarns make; a family is in one at most.
  std::optional<CrimpedCell> crimp{};
  std::optional<ViscousShear> viscous{}; ///< what one unit cell resists by the rate of shear
};

/// What a fabric may have at most, of families and stitches together, and of crossings. Kernels
/// keep as many numbers at hand.
constexpr std::size_t most_families = 8, most_crossings = 8;

/// The two directions of a fabric before forming by which its strains are computed: the first
/// family, and that which is furthest from parallel to it; of one family it and the line across it;
/// of none the ply's angle and the line across it.
struct MaterialAxes {
  double first = 0.0, second = 1.5707963267948966;  ///< rad, from the ply's angle
  double between() const { return second - first; } ///< in (0, pi)
  /// Components of the unit vector at `angle` (rad, from the ply's angle): e = v[0] e_1 + v[1] e_2.
  Vec2 components(double angle) const;
};

struct Fabric {
  std::string name;
  std::vector<YarnFamily> families;
  std::vector<Stitch> stitches;    ///< with the families at most most_families
  std::vector<Crossing> crossings; ///< at most most_crossings
  /// Law of the sheet beside the yarns: what holds them together, or a foil that has none.
  std::optional<SheetLaw> sheet;
  double surface_density = 0.0;        ///< t/mm^2 (1 g/m^2 = 1e-12 t/mm^2)
  double thickness = 0.0;              ///< mm
  std::optional<double> fibre_density; ///< t/mm^3, of the fibres themselves
  std::optional<double> heat_capacity; ///< N mm/(t K), of the whole ply (1 J/(g K) is 1e9 of it)
  TemperatureFactor flow; ///< of its viscosities and relaxation times, 1 at `flow_reference`
  TemperatureFactor shear_over_temperature; ///< of the elastic torques of its crossings, likewise
  double flow_reference = 0.0;              ///< degC
  std::optional<Compaction> compaction; ///< through the thickness; nothing: it does not give way
  std::optional<double> locking_angle;  ///< rad, shear angle beyond which the fabric wrinkles
  /// Of rubber: stretch up to which its law was measured.
  std::optional<double> stretch_limit;
  double twist = 0.0;      ///< D_t, N mm
  bool twist_given = true; ///< else `twist` is usual_twist
  /// Bending of the sheet by itself (N mm): D, the same along both axes, which are at right angles
  /// then, and D_c. Beside yarns in one direction it is what resists bending across them.
  double plate = 0.0, plate_coupling = 0.0;
  double plate_viscosity = 0.0; ///< N mm s, of D
  /// Melt that holds the yarns of one direction, beside `sheet`.
  std::optional<ViscousMatrix> matrix;
  ValueSource plate_source = ValueSource::given;

  bool has_yarns() const { return !families.empty(); }
  double weight() const { return surface_density * standard_gravity; } ///< N/mm^2
  /// mm, as thin as it is ever pressed.
  double least_thickness() const { return compaction ? compaction->densest() : thickness; }
};

/// What of a fabric follows the temperature, and its name.
struct LawOverTemperature {
  const char* of;
  const TemperatureFactor& factor;
};
inline std::array<LawOverTemperature, 2> laws_over_temperature(const Fabric& fabric) {
  return {{{"viscosity", fabric.flow}, {"shear", fabric.shear_over_temperature}}};
}

/// Whether it has two families and one crossing of them, warp and weft, and nothing else: no sheet,
/// no stitches.
bool is_weave(const Fabric& fabric);

/// A fabric of two families at right angles, `warp` and `weft`, and their crossing.
Fabric woven_fabric();

MaterialAxes material_axes(const Fabric& fabric);

/// In how many directions its yarns lie: families within 0.06 degrees of parallel have one.
int yarn_directions(const Fabric& fabric);

/// d_1 d_2 sin(angle between them) of a crossing, 1/mm^2: unit cells per area.
double cells_per_area(const Fabric& fabric, const Crossing& crossing);

/// rad, between the two families of a crossing before forming, in (0, pi).
double crossing_angle(const Fabric& fabric, const Crossing& crossing);

/// mm, along the first and along the second family of a crossing: from one yarn of the other family
/// to the next.
std::array<double, 2> crossing_spacing(const Fabric& fabric, const Crossing& crossing);

/// What lies along its axes, for messages: "warp", "along weft"; "fibre", "across"; of a foil "x",
/// "along y".
std::pair<std::string, std::string> axes_words(const Fabric& fabric);

BendingLaw bending_law(const Fabric& fabric);

/// Whether results have the opening between the yarns of a family: where no crossing holds their
/// distance, and where its limit is given.
bool shows_opening(const Fabric& fabric, std::size_t family);

/// Whether the yarns of all families bear compression; of a foil false.
bool bears_compression(const Fabric& fabric);

/// Whether stitches pull from the start, so that a ply moves though nothing moves it.
bool has_pretension(const Fabric& fabric);

/// Whether all families have the same yarns at the same density, and the same crimp.
bool balanced(const Fabric& fabric);

} // namespace plyform
