// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/verification/bands.hpp"

#include "core/results/field_difference.hpp"

#include <cmath>

namespace plyform {
namespace {

constexpr double order_of_mesh = 1.6; // core/accuracy/error_model.hpp
constexpr double safety_of_fields = 1.25, safety_of_figures = 2.0, safety_of_chance = 2.0;

/// Error over difference, by cause.
struct Factors {
  double mesh = 0.0, inertia = 0.0;
};

Factors factors_of(const Siblings& made, std::size_t plies) {
  const double ratio = std::pow(made.coarsening, order_of_mesh);
  Factors f;
  if (made.coarsening > 1.0)
    f.mesh = plies == 1 ? 1.0 / (ratio - 1.0) : 1.0 / std::sqrt(1.0 + ratio * ratio);
  f.inertia = 1.0 / (made.speed * made.speed - 1.0);
  return f;
}

/// The runs that a cause compares: both null if one of them is missing.
struct Compared {
  const RunEnd *one = nullptr, *other = nullptr;
  explicit operator bool() const { return one && other; }
};

Compared compared(Cause cause, const RunEnd& run, const std::map<Cause, RunEnd>& siblings) {
  const auto end = [&](Cause of) {
    const auto found = siblings.find(of);
    return found == siblings.end() ? nullptr : &found->second;
  };
  switch (cause) {
  case Cause::mesh:
    return {&run, end(Cause::mesh)};
  case Cause::inertia: // `faster` has the mesh of `coarser`, or the run's if there is none
    return {end(Cause::mesh) ? end(Cause::mesh) : &run, end(Cause::inertia)};
  case Cause::softening:
  case Cause::chance:
    return {end(Cause::inertia), end(cause)};
  }
  return {};
}

/// Sets the parts of a figure from difference(one, other), and its band.
template <class Difference>
void estimate(VerifiedFigure& figure, const RunEnd& run, const std::map<Cause, RunEnd>& siblings,
              const Factors& factors, const Difference& difference) {
  const auto of = [&](Cause cause, double factor) {
    const Compared c = compared(cause, run, siblings);
    return c ? factor * std::abs(difference(*c.one, *c.other)) : 0.0;
  };
  figure.mesh = of(Cause::mesh, factors.mesh);
  figure.inertia = of(Cause::inertia, factors.inertia);
  figure.softening = of(Cause::softening, 1.0);
  figure.chance = of(Cause::chance, 1.0);
}

void set_band(VerifiedFigure& f, double safety) {
  const double all = std::sqrt(f.mesh * f.mesh + f.inertia * f.inertia + f.softening * f.softening +
                               f.chance * f.chance);
  f.band = std::max(safety * all, safety_of_chance * f.chance);
}

/// Replaces each part by its root mean square over figures of one kind.
void pool(std::vector<VerifiedFigure>& figures) {
  for (double VerifiedFigure::*part : {&VerifiedFigure::mesh, &VerifiedFigure::inertia,
                                       &VerifiedFigure::softening, &VerifiedFigure::chance}) {
    double sum2 = 0.0;
    for (const VerifiedFigure& f : figures)
      sum2 += f.*part * f.*part;
    for (VerifiedFigure& f : figures)
      f.*part = std::sqrt(sum2 / static_cast<double>(figures.size()));
  }
}

Frame only_ply(const Frame& frame, std::size_t ply) {
  Frame one;
  one.plies = {frame.plies[ply]};
  return one;
}

double rms_shear(const PlyFrame& ply) {
  double sum = 0.0, area = 0.0;
  for (std::size_t i = 0; i < ply.triangles.size(); ++i) {
    const Triangle& t = ply.triangles[i];
    const double a = (ply.x0[t[1]] - ply.x0[t[0]]).cross(ply.x0[t[2]] - ply.x0[t[0]]).norm();
    sum += a * ply.shear_deg[i] * ply.shear_deg[i];
    area += a;
  }
  return area > 0.0 ? std::sqrt(sum / area) : 0.0;
}

} // namespace

std::vector<VerifiedFigure> verified_figures(const RunEnd& run,
                                             const std::map<Cause, RunEnd>& siblings,
                                             const Siblings& made, double predicted_mesh_deg) {
  const Factors factors = factors_of(made, run.last.plies.size());
  std::vector<VerifiedFigure> shear, draw_in, pressed, all;
  for (std::size_t p = 0; p < run.last.plies.size(); ++p) {
    const std::string& name = run.last.plies[p].name;
    VerifiedFigure& field = shear.emplace_back();
    field.name = "shear of " + name, field.unit = "deg";
    field.value = rms_shear(run.last.plies[p]);
    estimate(field, run, siblings, factors, [p](const RunEnd& a, const RunEnd& b) {
      return shear_error(only_ply(a.last, p), only_ply(b.last, p)).rms;
    });
    if (made.coarsening == 1.0) field.mesh = predicted_mesh_deg;
    if (run.plies[p].draw_in.unknown.empty()) {
      VerifiedFigure& f = draw_in.emplace_back();
      f.name = "draw-in of " + name, f.unit = "mm";
      f.value = run.plies[p].draw_in.mean();
      estimate(f, run, siblings, factors, [p](const RunEnd& a, const RunEnd& b) {
        return a.plies[p].draw_in.mean() - b.plies[p].draw_in.mean();
      });
    }
    if (run.plies[p].pressed) {
      const auto largest = [p](const RunEnd& r) {
        return r.plies[p].pressed ? 100.0 * r.plies[p].pressed->largest : 0.0;
      };
      VerifiedFigure& f = pressed.emplace_back();
      f.name = "largest compression of " + name, f.unit = "%";
      f.value = largest(run);
      estimate(f, run, siblings, factors,
               [&](const RunEnd& a, const RunEnd& b) { return largest(a) - largest(b); });
    }
  }
  std::vector<VerifiedFigure> force;
  for (std::size_t t = 0; t < run.last.tools.size(); ++t) {
    VerifiedFigure& f = force.emplace_back();
    f.name = "force of " + run.last.tools[t].name, f.unit = "N";
    f.value = run.last.tools[t].force_N;
    estimate(f, run, siblings, factors, [t](const RunEnd& a, const RunEnd& b) {
      return a.last.tools[t].force_N - b.last.tools[t].force_N;
    });
  }
  pool(draw_in);
  pool(pressed);
  for (VerifiedFigure& f : shear)
    set_band(f, safety_of_fields);
  for (std::vector<VerifiedFigure>* kind : {&draw_in, &pressed, &force})
    for (VerifiedFigure& f : *kind)
      set_band(f, safety_of_figures);
  for (const std::vector<VerifiedFigure>* kind : {&shear, &draw_in, &pressed, &force})
    all.insert(all.end(), kind->begin(), kind->end());
  return all;
}

} // namespace plyform
