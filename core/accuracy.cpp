// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

// (E): degrees, and exponents. Set on hemisphere_0 and hemisphere_five_ply (docs/accuracy.md).
constexpr double c_inertia = 4.0, p_inertia = 0.5;
constexpr double c_softening = 400.0, p_softening = 0.75;
constexpr double c_mesh = 6.0, p_mesh = 1.0;

constexpr double half_radian = 0.5;
constexpr double most_softening = 1000.0;

double degrees(double radians) {
  return radians * 180.0 / M_PI;
}

/// Numbers of (E) for duration 1 s, softening 1.
struct Numbers {
  double inertia = 0.0, softening = 0.0, mesh = 0.0;
};

double whole_stroke_of(const Case& data) {
  double stroke = 0.0;
  for (const Tool& t : data.tools)
    if (t.motion == Motion::driven) stroke = std::max(stroke, std::abs(t.stroke));
  for (const Boundary& b : data.boundaries)
    stroke = std::max(stroke, b.stroke);
  return stroke;
}

Numbers numbers_of(const Case& data) {
  Numbers n;
  const double stroke = whole_stroke_of(data);
  if (stroke == 0.0) return n;
  for (const Ply& ply : data.plies) {
    const Fabric& f = data.fabrics[static_cast<std::size_t>(ply.fabric)];
    const double size = data.blanks[static_cast<std::size_t>(ply.blank)].element_size;
    n.mesh = std::max(n.mesh, size / stroke);
    const double w =
        f.warp_density * f.weft_density * std::sin(f.fibre_angle) * f.shear.at(half_radian).energy;
    if (!(w > 0.0)) continue; // no shear stiffness: nothing to compare with
    n.inertia = std::max(n.inertia, 0.5 * f.surface_density * stroke * stroke / w);
    const double stiffness =
        std::min(f.warp_density * f.warp.largest_slope(), f.weft_density * f.weft.largest_slope());
    if (stiffness > 0.0) n.softening = std::max(n.softening, w / stiffness);
  }
  return n;
}

double inertia_error(const Numbers& n, double duration) {
  return c_inertia * std::pow(n.inertia / (duration * duration), p_inertia);
}

double softening_error(const Numbers& n, double softening) {
  return c_softening * std::pow(n.softening * softening, p_softening);
}

double mesh_error(const Numbers& n) {
  return c_mesh * std::pow(n.mesh, p_mesh);
}

} // namespace

double PredictedError::total() const {
  return std::sqrt(inertia * inertia + softening * softening + mesh * mesh);
}

double PredictedError::promised(const Case& data) const {
  return std::max(total(), degrees(data.accuracy.shear_error));
}

PredictedError predicted_error(const Case& data) {
  const Numbers n = numbers_of(data);
  return {inertia_error(n, data.solver.duration), softening_error(n, data.solver.fibre_softening),
          mesh_error(n)};
}

double preset_error(const std::string& word) {
  return word == "draft" ? 3.0 : word == "standard" ? 1.0 : word == "reference" ? 0.3 : 0.0;
}

void pick_dials(Case& data) {
  const Numbers n = numbers_of(data);
  const double wanted = degrees(data.accuracy.shear_error);
  if (!(wanted > 0.0) || n.inertia == 0.0) return;
  const double mesh = mesh_error(n);
  const double left2 = std::max(wanted * wanted - mesh * mesh, 0.25 * wanted * wanted);
  // the share of softening is walked through; inertia takes the rest
  double fewest = std::numeric_limits<double>::max();
  constexpr int shares = 200;
  for (int i = 1; i < shares; ++i) {
    const double share = static_cast<double>(i) / shares;
    double softening = most_softening;
    if (n.softening > 0.0)
      softening = std::clamp(std::pow(std::sqrt(share * left2) / c_softening, 1.0 / p_softening) /
                                 n.softening,
                             1.0, most_softening);
    const double of_softening = softening_error(n, softening);
    const double rest2 = left2 - of_softening * of_softening;
    if (!(rest2 > 0.0)) continue;
    const double duration =
        std::sqrt(n.inertia / std::pow(std::sqrt(rest2) / c_inertia, 1.0 / p_inertia));
    const double steps = duration / std::sqrt(softening);
    if (steps >= fewest) continue;
    fewest = steps;
    data.solver.duration = duration;
    data.solver.fibre_softening = softening;
  }
}

} // namespace plyform
