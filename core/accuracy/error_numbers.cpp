// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/error_numbers.hpp"

#include "core/mesh/mesh_blank.hpp"
#include "core/mesh/size_field.hpp"
#include "core/model/motion.hpp"
#include "core/model/reach_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace plyform {
namespace {

// Coefficients (degrees) and exponents of (E), fitted to the hemispheres of one (at 0 degrees),
// two, three and five plies and to bias_extension (docs/users/accuracy.md). Stacks of real cloth,
// whose yarns bear compression, slide on each other as one sheet: a fast stroke costs them little
// more than one ply.
constexpr double c_inertia = 0.52, c_stack = 33.7, c_cloth = 1.2, p_inertia = 1.5;
constexpr double c_softening = 1580.0, p_softening = 0.84, p_shared = -0.25;
constexpr double c_mesh = 40.0, c_fewer = 0.6, many_plies = 5.0;
// c_mesh of a stack of real cloth, over c_mesh: elements that cut into fillets let plies draw in
// too much, the more plies the more. Those of meshes from the scene do not.
constexpr double mesh_of_cloth = 1.3, mesh_of_further_ply = 0.18, few_plies = 3.0;

constexpr double half_radian = 0.5;
// Limits of the measurements that (E) was fitted to:
constexpr double measured_max_softening = 1000.0;
// Limit of I for the sake of forces, at this error; it falls with the root of the error asked for.
// Plies are thrown ahead of the punch and its force is too small: by 2 to 6 % at 0.18, 6 to 20 % at
// 0.36, 15 to 55 % at 0.7 (hemispheres of one ply and of two, three and five of real cloth).
constexpr double most_inertia = 0.36, most_inertia_at = 3.0;
// Limit for stacks, from stacks of yarns that carry tension only; not checked on real cloth.
constexpr double measured_max_softening_of_stack = 300.0;

/// w, N/mm.
double shear_energy_of(const Fabric& f) {
  double w = 0.0;
  for (const Crossing& c : f.crossings)
    w += cells_per_area(f, c) * c.shear.odd_part(half_radian).energy;
  return w;
}

/// w: energy of shear per area, N/mm.
void add_families(ErrorNumbers& n, const Fabric& f, double w) {
  constexpr double any = std::numeric_limits<double>::infinity();
  for (const YarnFamily& family : f.families) {
    const double stiffness = family.density * family.tension.largest_slope();
    if (!(stiffness > 0.0)) continue;
    n.families.push_back({w / stiffness, effective_softening(family.tension, any)});
    n.softening = std::max(n.softening, w / stiffness);
  }
}

/// Softening beyond which the stable time step does not increase: per mass, all yarns of the case
/// are then as soft in tension as the stiffest ones in compression. Infinite if none bears
/// compression.
double useful_softening(const Case& data) {
  double tension = 0.0, compression = 0.0; // N mm/t
  for (const Ply& ply : data.plies) {
    const Fabric& f = data.fabrics[ply.fabric];
    for (const YarnFamily& family : f.families) {
      const double per_mass = family.density / f.surface_density;
      tension = std::max(tension, per_mass * family.tension.largest_slope());
      compression = std::max(compression, per_mass * family.tension.compression);
    }
  }
  return compression > 0.0 ? tension / compression : std::numeric_limits<double>::infinity();
}

/// Whether the yarns of all plies bear compression.
bool bears_compression(const Case& data) {
  return std::all_of(data.plies.begin(), data.plies.end(), [&](const Ply& ply) {
    return plyform::bears_compression(data.fabrics[ply.fabric]);
  });
}

/// Whether all plies have meshes from the scene.
bool follows_tools(const Case& data) {
  return std::all_of(data.plies.begin(), data.plies.end(),
                     [&](const Ply& ply) { return data.blanks[ply.blank].sizes.has_value(); });
}

/// Element size of a blank, mm: side of a square of two triangles. Of a mesh that may have
/// different ones, from a file, by zones or sizes, that of the uniform mesh with the same error:
/// errors go with h^order_of_mesh place by place, and their squares add up over the area.
double element_size_of(const BlankSpec& blank) {
  if (blank.mesh != MeshKind::file && !is_graded(blank)) return blank.element_size;
  try {
    const BlankMesh mesh = mesh_blank(blank, 0.0, 0.5 * std::numbers::pi);
    double area = 0.0, sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
      const Vec2 a = mesh.x[t[1]] - mesh.x[t[0]], b = mesh.x[t[2]] - mesh.x[t[0]];
      const double twice = std::abs(a.x() * b.y() - a.y() * b.x());
      area += twice;
      sum += twice * std::pow(twice, order_of_mesh); // h^2 = twice
    }
    return std::pow(sum / area, 0.5 / order_of_mesh);
  } catch (const std::runtime_error&) { // told where the case is checked
    return std::numeric_limits<double>::quiet_NaN();
  }
}

} // namespace

bool has_shear_energy(const Fabric& fabric) {
  return shear_energy_of(fabric) > 0.0;
}

ErrorNumbers error_numbers(const Case& all, double mass_factor) {
  ErrorNumbers n;
  n.max_inertia = most_inertia, n.max_softening = measured_max_softening;
  const Case data = taking_part(all);
  const Strokes strokes = longest_strokes(data);
  const double stroke = strokes.longest(), fast = strokes.at_full_speed;
  if (stroke == 0.0) return n;
  // A ply that is pulled at its edge (bias_extension) vibrates like the outer plies of a stack, and
  // the yarns in the grips bear the whole load.
  const bool pulled = strokes.boundary > strokes.tool;
  constexpr double in_grips = 5.5;
  const int stacked = reach_ahead(data).largest_stack();
  const auto plies = static_cast<double>(stacked);
  const bool cloth = plies > 1.0 && bears_compression(data);
  n.inertia_factor = pulled ? c_stack : cloth ? c_cloth : plies > 1.0 ? c_stack : c_inertia;
  n.clamp_load_factor = pulled ? in_grips : 1.0;
  n.stack_softening_factor = std::pow(plies, p_shared);
  if (stacked > 1) n.max_softening = measured_max_softening_of_stack;
  if (cloth)
    n.cloth_mesh_factor =
        follows_tools(data)
            ? 1.0
            : mesh_of_cloth + mesh_of_further_ply * std::max(plies - few_plies, 0.0);
  else if (plies > 1.0)
    n.few_ply_mesh_factor += c_fewer * std::max(many_plies - plies, 0.0);
  for (const Ply& ply : data.plies) {
    const Fabric& f = data.fabrics[ply.fabric];
    const double mesh = element_size_of(data.blanks[ply.blank]) / stroke;
    if (std::isnan(mesh) || mesh > n.mesh) n.mesh = mesh; // NaN stays
    const double w = shear_energy_of(f);
    if (!(w > 0.0)) continue; // nothing to compare with
    n.inertia = std::max(n.inertia, 0.5 * mass_factor * f.surface_density * fast * fast / w);
    add_families(n, f, w);
  }
  n.max_softening = std::min(n.max_softening, useful_softening(data));
  return n;
}

double assumed_mass_factor(const Case& data) {
  // on a ring of small elements with a ninth of a ply's mass, shares up to a half gave 2.9 times
  // the share at most
  constexpr double each_share = 3.0;
  return 1.0 + each_share * data.solver.element_mass_scaling;
}

double ErrorNumbers::inertia_error(double duration) const {
  return inertia_factor * std::pow(inertia / (duration * duration), p_inertia);
}

double ErrorNumbers::softening_error(double softened) const {
  double worst = 0.0; // S of (E)
  for (const YarnNumbers& f : families)
    worst = std::max(worst, f.softening * std::min(softened, f.most));
  return c_softening * clamp_load_factor * stack_softening_factor * std::pow(worst, p_softening);
}

double ErrorNumbers::mesh_error() const {
  return c_mesh * few_ply_mesh_factor * cloth_mesh_factor * std::pow(mesh, order_of_mesh);
}

double ErrorNumbers::softening_for(double error) const {
  if (!(softening > 0.0)) return max_softening;
  const double most = std::pow(error / (c_softening * clamp_load_factor * stack_softening_factor),
                               1.0 / p_softening);
  return std::clamp(most / softening, 1.0, max_softening);
}

double ErrorNumbers::duration_for(double error) const {
  const double most = std::min(max_inertia, std::pow(error / inertia_factor, 1.0 / p_inertia));
  return std::sqrt(inertia / most);
}

void ErrorNumbers::hold_inertia(double wanted) {
  max_inertia *= std::sqrt(std::min(wanted / most_inertia_at, 1.0));
}

} // namespace plyform
