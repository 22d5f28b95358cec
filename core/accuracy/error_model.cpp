// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/error_model.hpp"

#include "core/mesh/mesh_blank.hpp"
#include "core/mesh/size_field.hpp"
#include "core/model/motion.hpp"
#include "core/model/reach_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace plyform {
namespace {

// Coefficients (degrees) and exponents of (E), fitted to the hemispheres of one (at 0 degrees),
// two, three and five plies and to bias_extension (docs/users/accuracy.md). Stacks of real cloth,
// whose yarns bear compression, slide on each other as one sheet: a fast stroke costs them little
// more than one ply.
constexpr double c_inertia = 0.52, c_stack = 33.7, c_cloth = 1.2, p_inertia = 1.5;
constexpr double c_softening = 1580.0, p_softening = 0.84, p_shared = -0.25;
constexpr double c_mesh = 40.0, p_mesh = 1.6, c_fewer = 0.6, many_plies = 5.0;
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

double degrees(double radians) {
  return radians * 180.0 / M_PI;
}

/// A family of yarns: S of (E) for softening 1, and its largest effective softening.
struct Family {
  double softening, most;
};

/// Numbers of (E) for duration 1 s, softening 1.
struct Numbers {
  double inertia = 0.0, softening = 0.0, mesh = 0.0;
  std::vector<Family> families{};      ///< S of each; `softening` above is the largest of them
  double max_inertia = most_inertia;   ///< I at most
  double inertia_factor = 0.0;         ///< c_inertia, c_stack or c_cloth; 0: nothing has a stroke
  double stack_softening_factor = 1.0; ///< n^u of (E): plies support each other's softened yarns
  double max_softening = measured_max_softening; ///< softening at most
  /// Factor of c_M, above 1 in a stack of few plies: which of them slide or stick depends on the
  /// mesh.
  double few_ply_mesh_factor = 1.0;
  double cloth_mesh_factor = 1.0; ///< likewise in a stack of real cloth
  double clamp_load_factor = 1.0; ///< load of softened yarns in grips over that under tools
};

/// w: energy of shear per area, N/mm.
void add_families(Numbers& n, const Fabric& f, double w) {
  constexpr double any = std::numeric_limits<double>::infinity();
  for (const auto& [law, density] :
       {std::pair(&f.warp, f.warp_density), std::pair(&f.weft, f.weft_density)}) {
    const double stiffness = density * law->largest_slope();
    if (!(stiffness > 0.0)) continue;
    n.families.push_back({w / stiffness, effective_softening(*law, any)});
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
    for (const auto& [law, density] :
         {std::pair(&f.warp, f.warp_density), std::pair(&f.weft, f.weft_density)}) {
      tension = std::max(tension, density * law->largest_slope() / f.surface_density);
      compression = std::max(compression, density * law->compression / f.surface_density);
    }
  }
  return compression > 0.0 ? tension / compression : std::numeric_limits<double>::infinity();
}

/// Whether the yarns of all plies bear compression.
bool bears_compression(const Case& data) {
  return std::all_of(data.plies.begin(), data.plies.end(), [&](const Ply& ply) {
    const Fabric& f = data.fabrics[ply.fabric];
    return f.warp.compression > 0.0 && f.weft.compression > 0.0;
  });
}

/// Whether all plies have meshes from the scene.
bool follows_tools(const Case& data) {
  return std::all_of(data.plies.begin(), data.plies.end(),
                     [&](const Ply& ply) { return data.blanks[ply.blank].sizes.has_value(); });
}

/// Element size of a blank, mm: side of a square of two triangles. Of a mesh that may have
/// different ones, from a file, by zones or sizes, that of the uniform mesh with the same error:
/// errors go with h^p_mesh place by place, and their squares add up over the area.
double element_size_of(const BlankSpec& blank) {
  if (blank.mesh != MeshKind::file && !is_graded(blank)) return blank.element_size;
  try {
    const BlankMesh mesh = mesh_blank(blank, 0.0, 0.5 * std::numbers::pi);
    double area = 0.0, sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
      const Vec2 a = mesh.x[t[1]] - mesh.x[t[0]], b = mesh.x[t[2]] - mesh.x[t[0]];
      const double twice = std::abs(a.x() * b.y() - a.y() * b.x());
      area += twice;
      sum += twice * std::pow(twice, p_mesh); // h^2 = twice
    }
    return std::pow(sum / area, 0.5 / p_mesh);
  } catch (const std::runtime_error&) { // told where the case is checked
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// mass_factor: of the mass that counts in I, by element mass scaling.
Numbers numbers_of(const Case& all, double mass_factor) {
  Numbers n;
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
    const double w =
        f.warp_density * f.weft_density * std::sin(f.fibre_angle) * f.shear.at(half_radian).energy;
    if (!(w > 0.0)) continue; // no shear stiffness: nothing to compare with
    n.inertia = std::max(n.inertia, 0.5 * mass_factor * f.surface_density * fast * fast / w);
    add_families(n, f, w);
  }
  n.max_softening = std::min(n.max_softening, useful_softening(data));
  return n;
}

/// mass_factor of predicted_error before there is a mesh: on a ring of small elements with a ninth
/// of a ply's mass, shares up to a half gave 2.9 times the share at most.
double assumed_mass_factor(const Case& data) {
  constexpr double each_share = 3.0;
  return 1.0 + each_share * data.solver.element_mass_scaling;
}

double inertia_error(const Numbers& n, double duration) {
  return n.inertia_factor * std::pow(n.inertia / (duration * duration), p_inertia);
}

double softening_error(const Numbers& n, double softening) {
  double worst = 0.0; // S of (E)
  for (const Family& f : n.families)
    worst = std::max(worst, f.softening * std::min(softening, f.most));
  return c_softening * n.clamp_load_factor * n.stack_softening_factor *
         std::pow(worst, p_softening);
}

double mesh_error(const Numbers& n) {
  return c_mesh * n.few_ply_mesh_factor * n.cloth_mesh_factor * std::pow(n.mesh, p_mesh);
}

} // namespace

double mesh_share(double error) {
  constexpr double share = 0.75; // of the squares, where the mesh costs the most
  return std::sqrt(share) * error;
}

bool awaits_scene(const Case& data) {
  return std::any_of(data.plies.begin(), data.plies.end(), [&](const Ply& ply) {
    const BlankSpec& blank = data.blanks[ply.blank];
    return !blank.mesh_from.empty() && !blank.sizes;
  });
}

double PredictedError::total() const {
  return std::sqrt(inertia * inertia + softening * softening + mesh * mesh);
}

double PredictedError::promised(const Case& data) const {
  const double predicted = total(); // NaN stays
  return predicted < degrees(data.accuracy.shear_error) ? degrees(data.accuracy.shear_error)
                                                        : predicted;
}

PredictedError predicted_error(const Case& data) {
  return predicted_error(data, assumed_mass_factor(data));
}

PredictedError predicted_error(const Case& data, double mass_factor) {
  const Numbers n = numbers_of(data, mass_factor);
  if (n.inertia_factor == 0.0) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return {unknown, unknown, unknown};
  }
  return {inertia_error(n, data.solver.duration), softening_error(n, data.solver.fibre_softening),
          mesh_error(n)};
}

std::string PredictedError::unknown(const Case& data) const {
  if (!std::isnan(total())) return {};
  return longest_strokes(data).longest() == 0.0
             ? "nothing has a stroke"
             : "the size of the elements of a mesh file is not known";
}

std::string describe_accuracy(const PredictedError& error, double promised, double coarsening,
                              const std::string& unknown) {
  if (std::isnan(promised)) return "accuracy is not predicted: " + unknown;
  constexpr double sense = 45.0; // degrees: as much as parts are sheared
  if (promised > sense)
    return "accuracy is not predicted: inertia, softened fibres or the mesh are far beyond what it "
           "was measured for";
  std::string mesh = fmt::format("mesh {:.2g}", error.mesh);
  if (coarsening != 1.0)
    mesh += fmt::format(", of elements {:g} times as large as the case's", coarsening);
  return fmt::format(
      "shear angles to {:.2g} deg rms, as predicted: inertia {:.2g}, softened fibres "
      "{:.2g}, {}",
      promised, error.inertia, error.softening, mesh);
}

std::string missed_accuracy(const Case& data) {
  const PredictedError error = predicted_error(data);
  const double wanted = degrees(data.accuracy.shear_error), promised = error.promised(data);
  constexpr double rounding = 1.01; // of what is printed with two digits
  if (!(wanted > 0.0) || !(promised > rounding * wanted)) return {};
  std::string text =
      fmt::format("accuracy asked for: shear angles to {:.2g} deg rms are out of reach, {:.2g} deg "
                  "is what this "
                  "run can promise: inertia {:.2g}, softened fibres {:.2g}, mesh {:.2g}",
                  wanted, promised, error.inertia, error.softening, error.mesh);
  const double left = mesh_share(wanted);
  if (error.mesh > left)
    text +=
        fmt::format("; elements {:.2g} times as large would keep it, and take some {:.2g} times "
                    "the time",
                    std::pow(left / error.mesh, 1.0 / p_mesh),
                    std::pow(error.mesh / left, 2.7 / p_mesh)); // cost of h^-2.7
  return text;
}

double preset_error(const std::string& word) {
  return word == "draft" ? 3.0 : word == "standard" ? 1.0 : word == "reference" ? 0.3 : 0.0;
}

namespace {

/// Parameters, and what they cost: CPU time over that of the case's own mesh for 1 s and
/// softening 1.
struct CostParameters {
  double coarsening = 1.0, duration = 0.0, softening = 1.0;
  double cost = std::numeric_limits<double>::max();
  double excess = std::numeric_limits<double>::max(); ///< degrees, error beyond the requested one
};

/// The largest softening whose error is `error` at most.
double softening_for(const Numbers& n, double error) {
  if (!(n.softening > 0.0)) return n.max_softening;
  const double most = std::pow(
      error / (c_softening * n.clamp_load_factor * n.stack_softening_factor), 1.0 / p_softening);
  return std::clamp(most / n.softening, 1.0, n.max_softening);
}

/// s, the shortest duration whose error is `error` at most.
double duration_for(const Numbers& n, double error) {
  const double inertia =
      std::min(n.max_inertia, std::pow(error / n.inertia_factor, 1.0 / p_inertia));
  return std::sqrt(n.inertia / inertia);
}

/// The cheapest duration and softening whose squared errors sum to `left2` (degrees^2) at most.
CostParameters cheapest(const Numbers& n, double left2) {
  CostParameters best;
  constexpr int shares = 200; // values tried for the share of softening; inertia gets the rest
  for (int i = 1; i < shares; ++i) {
    const double share = static_cast<double>(i) / shares;
    const double softening = softening_for(n, std::sqrt(share * left2));
    const double of_softening = softening_error(n, softening);
    const double rest2 = left2 - of_softening * of_softening;
    if (!(rest2 > 0.0)) continue;
    const double duration = duration_for(n, std::sqrt(rest2));
    const double steps = duration / std::sqrt(softening);
    if (steps < best.cost) best = {1.0, duration, softening, steps, 0.0};
  }
  return best;
}

/// The same if one of the two, or both, are fixed at the case's values.
CostParameters cheapest(const Numbers& n, double left2, const SolverOptions& now,
                        const FixedParameters& fixed) {
  if (!fixed.duration && !fixed.softening) return cheapest(n, left2);
  const auto left_by = [&](double error) {
    return std::sqrt(std::max(left2 - error * error, 0.25 * left2));
  };
  CostParameters parameters{1.0, now.duration, now.fibre_softening, 0.0, 0.0};
  if (!fixed.duration)
    parameters.duration = duration_for(n, left_by(softening_error(n, parameters.softening)));
  if (!fixed.softening)
    parameters.softening = softening_for(n, left_by(inertia_error(n, parameters.duration)));
  parameters.cost = parameters.duration / std::sqrt(parameters.softening);
  return parameters;
}

} // namespace

bool may_coarsen(const Case& data, double by) {
  constexpr double most_thicknesses = 16.0;
  double longest = std::numeric_limits<double>::max();
  for (const Tool& t : data.tools)
    if (const double radius = smallest_rounding(t.shape); radius > 0.0)
      longest = std::min(longest, radius);
  for (const Ply& ply : data.plies) {
    const double thickness = data.fabrics[ply.fabric].thickness;
    BlankSpec blank = data.blanks[ply.blank];
    if (blank.mesh == MeshKind::file) return false;
    scale_elements(blank, by);
    // what goes round a tool are the smallest
    if (smallest_wanted(blank) > std::min(longest, most_thicknesses * thickness)) return false;
    if (!takes_elements(blank)) return false;
  }
  return data.boundaries.empty(); // the nodes that they prescribe depend on the mesh
}

bool may_refine(const Case& data, double by) {
  return data.boundaries.empty() &&
         std::all_of(data.plies.begin(), data.plies.end(), [&](const Ply& ply) {
           BlankSpec blank = data.blanks[ply.blank];
           scale_elements(blank, by);
           return blank.mesh != MeshKind::file && takes_elements(blank);
         });
}

bool largest_elements_suffice(const Case& data) {
  const double wanted = degrees(data.accuracy.shear_error);
  const Numbers n = numbers_of(data, 1.0);
  constexpr double most = 0.95; // at their limits inertia and softening leave less than the rest
  return wanted > 0.0 && n.inertia_factor > 0.0 && mesh_error(n) <= most * wanted; // NaN: no
}

double pick_cost_parameters(Case& data, const FixedParameters& fixed) {
  if (!fixed.element_size && largest_elements_suffice(data))
    for (BlankSpec& blank : data.blanks)
      if (blank.mesh_from == mesh_from_scene_word) blank.mesh_from.clear();
  Numbers n = numbers_of(data, assumed_mass_factor(data));
  const double wanted = degrees(data.accuracy.shear_error);
  n.max_inertia *= std::sqrt(std::min(wanted / most_inertia_at, 1.0));
  const bool from_scene = awaits_scene(data);
  if (!(wanted > 0.0) || n.inertia == 0.0) return 1.0;
  CostParameters best;
  for (const double by : {1.0, 1.1, 1.2, 1.3, 1.4, 0.95, 0.9}) { // (E) was not measured beyond
    const bool keep = fixed.element_size || n.few_ply_mesh_factor > 1.0 || from_scene;
    if (by > 1.0 && (keep || !may_coarsen(data, by))) continue;
    // smaller ones only for an error that is out of reach without
    if (by < 1.0 && (keep || best.excess == 0.0 || !may_refine(data, by))) continue;
    double mesh = std::isnan(n.mesh) ? 0.0 : mesh_error(n) * std::pow(by, p_mesh);
    if (from_scene) mesh = std::min(mesh, mesh_share(wanted));
    double left2 = wanted * wanted - mesh * mesh;
    const double least2 = 0.25 * wanted * wanted;
    if (left2 < least2 && by > 1.0) continue;
    left2 = std::max(left2, least2);
    CostParameters parameters = cheapest(n, left2, data.solver, fixed);
    parameters.coarsening = by;
    // Number of elements, and time step: that grows less than h, as contacts keep their stiffness.
    parameters.cost /= by * by * std::pow(by, 0.7);
    parameters.excess = std::max(std::hypot(mesh, inertia_error(n, parameters.duration),
                                            softening_error(n, parameters.softening)) -
                                     wanted * (1.0 + 1e-9),
                                 0.0);
    // a smaller error has priority over a lower cost
    if (parameters.excess != best.excess ? parameters.excess < best.excess
                                         : parameters.cost < best.cost)
      best = parameters;
  }
  data.solver.duration = best.duration;
  data.solver.fibre_softening = best.softening;
  for (BlankSpec& blank : data.blanks)
    scale_elements(blank, best.coarsening);
  return best.coarsening;
}

} // namespace plyform
