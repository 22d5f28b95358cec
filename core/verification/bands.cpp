// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/verification/bands.hpp"

#include "base/format.hpp"
#include "core/model/mirror.hpp"
#include "core/results/field_difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace plyform {
namespace {

/// Error over difference, by cause.
struct Factors {
  double mesh = 0.0, inertia = 0.0, softening = 0.0;
};

/// field: of a root mean square over a ply, not of a number.
Factors factors_of(const Siblings& made, double of_inertia, bool field) {
  Factors f;
  const double b = std::pow(made.coarsening, made.resolved ? order_of_mesh : order_outside_premise);
  if (b > 1.0) f.mesh = 1.0 / (b - 1.0);
  if (b < 1.0) f.mesh = 1.0 / (1.0 - b);
  if (b < 1.0 && field && made.resolved) f.mesh = std::sqrt(f.mesh / std::hypot(1.0, b));
  f.inertia = of_inertia;
  f.softening = std::abs(made.softening);
  return f;
}

/// Two runs, the second with the larger error: both null if one of them is missing.
struct Compared {
  const RunEnd *one = nullptr, *other = nullptr;
  explicit operator bool() const { return one && other; }
};

Compared compared(Cause cause, const RunEnd& run, const Ends& siblings, const Siblings& made) {
  const auto end = [&](Cause of) {
    const auto found = siblings.find(of);
    return found == siblings.end() ? nullptr : &found->second;
  };
  const bool coarser = made.coarsening > 1.0; // then `faster` has the mesh of `coarser`
  switch (cause) {
  case Cause::mesh:
    return coarser ? Compared{&run, end(Cause::mesh)}
                   : Compared{end(Cause::mesh), end(Cause::inertia)};
  case Cause::inertia:
    return {coarser ? end(Cause::mesh) : &run, end(Cause::inertia)};
  case Cause::softening:
    return made.softening < 0.0 ? Compared{end(cause), end(Cause::inertia)}
                                : Compared{end(Cause::inertia), end(cause)};
  case Cause::chance:
    return {end(Cause::inertia), end(cause)};
  case Cause::late_chance:
  case Cause::later_chance:
    return {&run, end(cause)};
  }
  return {};
}

bool is_pushed(const RunEnd& run, std::size_t tool) {
  return tool < run.motions.size() && run.motions[tool] == Motion::force;
}

/// The largest force of a driven tool; without one, of any that is not pushed. N.
double largest_force(const RunEnd& run) {
  double driven = 0.0, any = 0.0;
  for (std::size_t t = 0; t < run.last.tools.size(); ++t) {
    if (is_pushed(run, t)) continue;
    const double force = std::abs(run.last.tools[t].force_N);
    any = std::max(any, force);
    if (t < run.motions.size() && run.motions[t] == Motion::driven)
      driven = std::max(driven, force);
  }
  return driven > 0.0 ? driven : any;
}

/// Error over difference by (1) of bands.hpp, of the force of which speed has left the least.
double factor_of_forces(const RunEnd& one, const RunEnd& other, double speed) {
  constexpr double counts = 0.05; // of the largest force: smaller ones are jitter
  constexpr double thrown = 1.5;  // of its own: no loss, but plies that are thrown against a tool
  const double largest = largest_force(one);
  double left = 1.0, grown = 1.0;
  for (std::size_t t = 0; t < one.last.tools.size(); ++t)
    if (const double force = one.last.tools[t].force_N;
        !is_pushed(one, t) && std::abs(force) > counts * largest) {
      left = std::min(left, other.last.tools[t].force_N / force);
      grown = std::max(grown, other.last.tools[t].force_N / force);
    }
  const double powers = std::pow(speed, order_of_inertia_of_forces) - 1.0;
  const double most = 1.0 / (std::pow(speed, order_outside_premise) - 1.0);
  if (left <= 0.0 || grown > thrown) return most;
  if (left == 1.0) return 1.0 / powers; // none has become less
  return std::min(std::expm1(-std::log(left) / powers) / (1.0 - left), most);
}

/// Error over difference of inertia.
double factor_of_inertia(const Compared& inertia, double speed, bool force) {
  const bool flies = inertia && (inertia.one->flies || inertia.other->flies);
  if (force && inertia && !flies) return factor_of_forces(*inertia.one, *inertia.other, speed);
  return 1.0 / (std::pow(speed, flies ? order_outside_premise : order_of_inertia) - 1.0);
}

/// Sets the parts of a figure from difference(one, other).
template <class Difference>
void estimate(VerifiedFigure& figure, const RunEnd& run, const Ends& siblings, const Siblings& made,
              const Difference& difference) {
  const bool field = figure.unit == "deg";
  const Factors factors = factors_of(
      made,
      factor_of_inertia(compared(Cause::inertia, run, siblings, made), made.speed, figure.force),
      field);
  const auto of = [&](Cause cause, double factor) -> ErrorPart {
    const Compared c = compared(cause, run, siblings, made);
    if (!c) return std::nullopt;
    const double d = factor * difference(*c.one, *c.other);
    return figure.force ? -d : std::abs(d);
  };
  figure.chance.reset();
  figure.mesh = of(Cause::mesh, factors.mesh);
  figure.inertia = of(Cause::inertia, factors.inertia);
  if (run.flies && !field) figure.inertia.reset(); // two that have lost a force may agree
  for (const Cause twin : {Cause::chance, Cause::late_chance, Cause::later_chance})
    if (const ErrorPart apart = of(twin, 1.0))
      figure.chance = std::max(figure.chance.value_or(0.0), std::abs(*apart));
  figure.softening = of(Cause::softening, factors.softening);
  if (made.softening == 0.0) figure.softening = 0.0; // nothing is softened
  if (made.softening < 0.0 && figure.softening && figure.chance) {
    // it doubles what two runs differ by anyway
    const double all = std::abs(*figure.softening), by_chance = factors.softening * *figure.chance;
    figure.softening = std::copysign(std::sqrt(std::max(all * all - by_chance * by_chance, 0.0)),
                                     *figure.softening);
  }
}

constexpr std::array parts{&VerifiedFigure::mesh, &VerifiedFigure::inertia,
                           &VerifiedFigure::softening, &VerifiedFigure::chance};

/// Replaces each part by its root mean square over figures of one kind, those that may have bands.
void pool(std::vector<VerifiedFigure>& all) {
  std::vector<std::reference_wrapper<VerifiedFigure>> figures;
  for (VerifiedFigure& f : all)
    if (f.no_band.empty()) figures.emplace_back(f);
  for (ErrorPart VerifiedFigure::*part : parts) {
    double sum2 = 0.0;
    for (const VerifiedFigure& f : figures)
      sum2 += (f.*part).value_or(0.0) * (f.*part).value_or(0.0);
    for (VerifiedFigure& f : figures)
      if (f.*part) f.*part = std::sqrt(sum2 / static_cast<double>(figures.size()));
  }
}

/// Replaces the size of each part by the root mean square of it and of that of the other estimate,
/// whose signs are kept beside.
void pool(VerifiedFigure& figure, const VerifiedFigure& other) {
  if (unmeasured(figure).empty() && unmeasured(other).empty())
    for (const VerifiedFigure& one : {std::cref(figure), std::cref(other)})
      figure.estimates.push_back({*one.mesh, *one.inertia, *one.softening});
  for (ErrorPart VerifiedFigure::*part : parts)
    if (figure.*part && other.*part)
      figure.*part = std::copysign(std::sqrt(0.5) * std::hypot(*(figure.*part), *(other.*part)),
                                   *(figure.*part));
}

/// What the parts of a force add up to, the root mean square over its estimates.
double sum_with_signs(const VerifiedFigure& f) {
  if (f.estimates.empty()) return std::abs(*f.mesh + *f.inertia + *f.softening);
  double sum2 = 0.0;
  for (const SignedErrors& one : f.estimates)
    sum2 += one.sum() * one.sum();
  return std::sqrt(sum2 / static_cast<double>(f.estimates.size()));
}

double rms_shear(const Frame& frame) {
  double sum = 0.0, area = 0.0;
  for (const PlyFrame& ply : frame.plies)
    for (std::size_t i = 0; i < ply.triangles.size(); ++i) {
      const Triangle& t = ply.triangles[i];
      const double a = (ply.x0[t[1]] - ply.x0[t[0]]).cross(ply.x0[t[2]] - ply.x0[t[0]]).norm();
      sum += a * ply.shear_deg[i] * ply.shear_deg[i];
      area += a;
    }
  return area > 0.0 ? std::sqrt(sum / area) : 0.0;
}

/// The figure of the shear of these plies; pick: their frame, from one of all.
template <class Pick>
VerifiedFigure figure_of_shear(const std::string& of, const RunEnd& run, const Ends& siblings,
                               const Siblings& made, const PredictedError& predicted,
                               const Pick& pick) {
  VerifiedFigure field;
  field.name = "shear of " + of, field.unit = "deg";
  field.value = rms_shear(pick(run.last));
  estimate(field, run, siblings, made, [&](const RunEnd& a, const RunEnd& b) {
    return shear_error(pick(a.last), pick(b.last)).rms;
  });
  if (!field.mesh && predicted.mesh > 0.0) field.mesh = predicted.mesh; // false for NaN
  if (!field.softening && predicted.softening > 0.0) field.softening = predicted.softening;
  set_band(field);
  return field;
}

} // namespace

ErrorPart width_of_band(const VerifiedFigure& f) {
  if (!unmeasured(f).empty()) return std::nullopt;
  const double squares = std::sqrt(*f.mesh * *f.mesh + *f.inertia * *f.inertia +
                                   *f.softening * *f.softening + *f.chance * *f.chance);
  double error = squares;
  if (f.force) error = std::max(squares, sum_with_signs(f));
  return std::max({safety * error, safety_of_jitter * f.jitter, safety_of_chance * *f.chance});
}

void set_band(VerifiedFigure& f) {
  f.band = width_of_band(f);
  f.no_band.clear();
  if (!f.band || *f.band <= std::abs(f.value)) return;
  f.no_band = std::isfinite(*f.band)
                  ? fmt::format("its error may be {:.2g} {}, more than all of it", *f.band, f.unit)
                  : "its error is not known";
  f.band.reset();
}

double force_jitter(const Case& data, const Frame& last) {
  double most = 0.0;
  for (std::size_t t = 0; t < data.tools.size(); ++t) {
    const Tool& tool = data.tools[t];
    if (tool.motion != Motion::force) continue;
    const double pushed = tool.programme.empty() ? tool.force : tool.programme.back().value;
    const auto parts = static_cast<double>(parts_of(data)); // shown is the whole
    most = std::max(most, std::abs(last.tools[t].force_N - parts * pushed));
  }
  return most;
}

std::vector<double> forces_by_balance(const Case& data, const Frame& last) {
  const std::vector<Push> pushed = pushes(data);
  if (!data.boundaries.empty() ||
      std::any_of(pushed.begin(), pushed.end(), [](const Push& push) { return !push.measured; }))
    return {};
  Vec3 all = Vec3::Zero();
  for (const ToolFrame& tool : last.tools)
    all += tool.force;
  std::vector<double> forces;
  for (std::size_t t = 0; t < data.tools.size(); ++t) {
    const ToolFrame& tool = last.tools[t];
    forces.push_back(data.tools[t].motion == Motion::force
                         ? tool.force_N
                         : (all - tool.force).dot(data.tools[t].direction));
  }
  return forces;
}

VerifiedFigure verified_shear(const RunEnd& run, const Ends& siblings, const Siblings& made,
                              const PredictedError& predicted) {
  return figure_of_shear("all plies", run, siblings, made, predicted,
                         [](const Frame& frame) -> const Frame& { return frame; });
}

namespace {

/// What siblings agree on there is no error of it.
void leave_out(VerifiedFigure& f, const std::string& why) {
  for (ErrorPart VerifiedFigure::*part : parts)
    (f.*part).reset();
  f.no_band = why;
}

/// Why the figure of this number has no band, if it is known to have none.
std::string why_none(const std::vector<std::string>& of, std::size_t number) {
  return number < of.size() ? of[number] : "";
}

std::string why_no_force(const RunEnd& run, std::size_t tool) {
  if (tool < run.known_forces.size() && !run.known_forces[tool].to_end())
    return "not known: it is contact's stiffness, not the cloth's";
  return why_none(run.no_band.force, tool);
}

/// Takes the parts from a force that both runs compared have lost: that they agree shows nothing.
void leave_out_lost(VerifiedFigure& f, std::size_t tool, const RunEnd& run, const Ends& siblings,
                    const Siblings& made) {
  constexpr double lost = 0.05; // of the run's force
  const auto has_lost = [&](const RunEnd& end) {
    return std::abs(end.last.tools[tool].force_N) < lost * std::abs(f.value);
  };
  for (const auto& [cause, part] : {std::pair(Cause::mesh, &VerifiedFigure::mesh),
                                    std::pair(Cause::softening, &VerifiedFigure::softening)}) {
    const Compared c = compared(cause, run, siblings, made);
    if (c && has_lost(*c.one) && has_lost(*c.other)) (f.*part).reset();
  }
}

/// Forces of all tools, still without bands.
std::vector<VerifiedFigure> verified_forces(const RunEnd& run, const Ends& siblings,
                                            const Siblings& made) {
  std::vector<VerifiedFigure> force;
  for (std::size_t t = 0; t < run.last.tools.size(); ++t) {
    VerifiedFigure& f = force.emplace_back();
    f.name = "force of " + run.last.tools[t].name, f.unit = "N", f.force = true;
    f.jitter = run.jitter_N;
    f.value = run.last.tools[t].force_N;
    if (const std::string why = why_no_force(run, t); !why.empty()) {
      leave_out(f, why);
      continue;
    }
    estimate(f, run, siblings, made, [t](const RunEnd& a, const RunEnd& b) {
      return a.last.tools[t].force_N - b.last.tools[t].force_N;
    });
    if (run.balance_N.empty()) {
      leave_out_lost(f, t, run, siblings, made);
      continue;
    }
    f.jitter = std::max(f.jitter, std::abs(f.value - run.balance_N[t]));
    VerifiedFigure by_balance = f;
    estimate(by_balance, run, siblings, made,
             [t](const RunEnd& a, const RunEnd& b) { return a.balance_N[t] - b.balance_N[t]; });
    pool(f, by_balance);
  }
  return force;
}

} // namespace

std::vector<VerifiedFigure> verified_figures(const RunEnd& run, const Ends& siblings,
                                             const Siblings& made,
                                             const PredictedError& predicted) {
  std::vector<VerifiedFigure> shear, draw_in, pressed, all;
  std::vector<VerifiedFigure> force = verified_forces(run, siblings, made);
  for (std::size_t p = 0; p < run.last.plies.size(); ++p) {
    const std::string& name = run.last.plies[p].name;
    shear.push_back(figure_of_shear(name, run, siblings, made, predicted,
                                    [p](const Frame& frame) { return only_ply(frame, p); }));
    if (run.plies[p].draw_in.unknown.empty()) {
      VerifiedFigure& f = draw_in.emplace_back();
      f.name = "draw-in of " + name, f.unit = "mm";
      f.value = run.plies[p].draw_in.mean();
      estimate(f, run, siblings, made, [p](const RunEnd& a, const RunEnd& b) {
        return a.plies[p].draw_in.mean() - b.plies[p].draw_in.mean();
      });
      if (const std::string why = why_none(run.no_band.draw_in, p); !why.empty()) leave_out(f, why);
    }
    if (run.plies[p].pressed) {
      const auto largest = [p](const RunEnd& r) {
        return r.plies[p].pressed ? 100.0 * r.plies[p].pressed->largest : 0.0;
      };
      VerifiedFigure& f = pressed.emplace_back();
      f.name = "largest compression of " + name, f.unit = "%";
      f.value = largest(run);
      estimate(f, run, siblings, made,
               [&](const RunEnd& a, const RunEnd& b) { return largest(a) - largest(b); });
      if (const std::string why = why_none(run.no_band.pressed, p); !why.empty()) leave_out(f, why);
    }
  }
  pool(draw_in);
  pool(pressed);
  for (std::vector<VerifiedFigure>* kind : {&draw_in, &pressed, &force})
    for (VerifiedFigure& f : *kind)
      if (f.no_band.empty()) set_band(f);
  for (const std::vector<VerifiedFigure>* kind : {&shear, &draw_in, &pressed, &force})
    all.insert(all.end(), kind->begin(), kind->end());
  return all;
}

} // namespace plyform
