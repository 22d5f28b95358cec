// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/parts/viscous_file.hpp"

#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plyform {
namespace {

/// Reports a viscosity that falls below 0 before a right angle.
void check_viscosity(const TableView& shear, const ViscousShear& law, Diagnostics& diagnostics) {
  for (int degrees = 0; degrees < 90; ++degrees)
    if (!law.c.empty() && law.torque(degrees * std::numbers::pi / 180.0, 1.0) < 0.0)
      return value_error(
          shear, "viscosity",
          fmt::format("must be at least 0 at any angle, and is not at {} degrees", degrees),
          "give coefficients of an even polynomial that does not fall below 0", diagnostics);
}

RateCurve read_rate_curve(const TableView& section, Diagnostics& diagnostics) {
  RateCurve curve;
  read_members(section, curve);
  const std::vector<Vec2> points = pairs(section, "table");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double angle = points[i].x();
    if (i == 0 ? angle != 0.0 : !(angle > points[i - 1].x())) {
      row_error(section, "table", i,
                i == 0 ? "must be of 0 degrees"
                       : "must have a first number above that of the row before",
                "put the rows in ascending order from [0.0, torque] on", diagnostics);
      return curve;
    }
    curve.angle.push_back(angle), curve.torque.push_back(points[i].y());
  }
  return curve;
}

/// Whether a curve has at least the torque of one of a lower rate, at all angles.
bool is_above(const RateCurve& curve, const RateCurve& lower) {
  const auto holds = [&](double angle) { return curve.at(angle) >= lower.at(angle); };
  return std::all_of(curve.angle.begin(), curve.angle.end(), holds) &&
         std::all_of(lower.angle.begin(), lower.angle.end(), holds);
}

void read_rate_curves(const TableView& shear, ViscousShear& law, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errors.size();
  for (const TableView& section : subsections(shear, "viscous")) {
    RateCurve curve = read_rate_curve(section, diagnostics);
    if (diagnostics.errors.size() != before || curve.angle.empty()) return;
    if (!law.curves.empty() && !(curve.rate > law.curves.back().rate))
      return value_error(section, "rate", "must be above that of the table before",
                         "put the tables in ascending order of their rates", diagnostics);
    if (!law.curves.empty() && !is_above(curve, law.curves.back()))
      return value_error(
          section, "table", "must have at least the torque of the lower rate before, at all angles",
          "take out what falls: a torque that falls with the rate is not modelled", diagnostics);
    law.curves.push_back(std::move(curve));
  }
}

} // namespace

std::optional<ViscousShear> read_viscous_shear(const TableView& shear, Diagnostics& diagnostics) {
  ViscousShear law;
  law.c = numbers(shear, "viscosity");
  check_viscosity(shear, law, diagnostics);
  read_rate_curves(shear, law, diagnostics);
  for (const Vec2& branch : pairs(shear, "relaxation"))
    law.branches.push_back({branch.x(), branch.y()});
  if (const std::vector<double> rates = numbers(shear, "measured_rates"); rates.size() == 2) {
    if (!(rates[0] <= rates[1]))
      value_error(shear, "measured_rates", "must be the lower rate and the higher one",
                  "put the lower one first", diagnostics);
    law.measured_rates = {rates[0], rates[1]};
  }
  const bool any = law.has_dashpot() || !law.branches.empty();
  if (!any && law.measured_rates)
    value_error(shear, "measured_rates", "is of a law with rates, and there is none",
                "give viscosity, viscous or relaxation, or take it out", diagnostics);
  if (!any) return std::nullopt;
  return law;
}

} // namespace plyform
