// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/error_model.hpp"

#include "base/format.hpp"
#include "core/accuracy/error_numbers.hpp"
#include "core/model/motion.hpp"
#include "core/model/reach_ahead.hpp"
#include "core/model/yarn_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {

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
  return predicted < data.accuracy.shear_error / degree ? data.accuracy.shear_error / degree
                                                        : predicted;
}

std::string not_measured(const Case& all) {
  const Case data = taking_part(all);
  for (const Ply& ply : data.plies) {
    const Fabric& f = data.fabrics[at(ply.fabric)];
    const char* odd = !f.has_yarns()                ? "is a sheet without yarns"
                      : !f.stitches.empty()         ? "has stitches"
                      : !is_weave(f)                ? "is no weave of two families"
                      : f.crossings[0].crimp        ? "has crimp"
                      : !f.crossings[0].shear.odd() ? "has a law of shear that differs by its sign"
                      : has_rates(f)                ? "has laws that depend on rates"
                      : !has_shear_energy(f)        ? "has no stiffness in shear"
                                                    : nullptr;
    if (odd) return fmt::format("not measured: {} {}", f.name, odd);
  }
  for (const int law : all.friction.law)
    if (law >= 0 && all.friction_laws[at(law)]->has_rates())
      return fmt::format("not measured: friction.{} depends on the slip speed",
                         all.friction_laws[at(law)]->spec().name);
  for (const Push& push : pushes(data))
    if (!push.measured)
      return fmt::format("not measured: {} acts on ply {}", push.name, data.plies[push.ply].name);
  return {};
}

PredictedError predicted_error(const Case& data) {
  return predicted_error(data, assumed_mass_factor(data));
}

PredictedError predicted_error(const Case& data, double mass_factor) {
  const ErrorNumbers n = error_numbers(data, mass_factor);
  if (n.inertia_factor == 0.0 || !not_measured(data).empty()) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return {unknown, unknown, unknown};
  }
  return {n.inertia_error(data.solver.duration), n.softening_error(data.solver.fibre_softening),
          n.mesh_error()};
}

std::string PredictedError::unknown(const Case& data) const {
  if (!std::isnan(total())) return {};
  if (longest_strokes(data).longest() == 0.0)
    return data.loads.empty() ? "nothing has a stroke"
                              : "not measured: pressures form the plies, and nothing has a stroke";
  const std::string odd = not_measured(data);
  return odd.empty() ? "the size of the elements of a mesh file is not known" : odd;
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
    mesh += fmt::format(", of elements {:.3g} times as large as the case's", coarsening);
  return fmt::format(
      "shear angles to {:.2g} deg rms, as predicted: inertia {:.2g}, softened fibres "
      "{:.2g}, {}",
      promised, error.inertia, error.softening, mesh);
}

std::string missed_accuracy(const Case& data) {
  const PredictedError error = predicted_error(data);
  const double wanted = data.accuracy.shear_error / degree, promised = error.promised(data);
  constexpr double rounding = 1.01; // of what is printed with two digits
  if (!(wanted > 0.0) || !(promised > rounding * wanted) || std::isinf(promised)) return {};
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
                    std::pow(left / error.mesh, 1.0 / order_of_mesh),
                    std::pow(error.mesh / left, 2.7 / order_of_mesh)); // cost of h^-2.7
  return text;
}

double preset_error(const std::string& word) {
  return word == "draft" ? 3.0 : word == "standard" ? 1.0 : word == "reference" ? 0.3 : 0.0;
}

} // namespace plyform
