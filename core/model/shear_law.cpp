// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/shear_law.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double small = 1e-9; // rad: below it Cs(g) / g equals the slope at 0 to rounding

} // namespace

LawPoint ShearLaw::at(double g) const {
  if (tabulated()) return curve().at(g);
  const std::vector<double>& of = std::signbit(g) && !negative_k.empty() ? negative_k : k;
  LawPoint r{0.0, 0.0, 0.0};
  const double g2 = g * g;
  double power = 1.0; // g^(2i)
  for (std::size_t i = 0; i < of.size(); ++i) {
    const double order = 2.0 * static_cast<double>(i) + 1.0; // exponent of g
    r.value += of[i] * power * g;
    r.slope += of[i] * order * power;
    r.energy += of[i] * power * g2 / (order + 1.0);
    power *= g2;
  }
  return r;
}

double ShearLaw::secant(double g) const {
  const LawPoint law = at(g);
  return std::abs(g) > small ? law.value / g : law.slope;
}

LawPoint ShearLaw::odd_part(double g) const {
  const LawPoint plus = at(g);
  if (odd()) return plus;
  const LawPoint minus = at(-g);
  return {0.5 * (plus.value - minus.value), 0.5 * (plus.slope + minus.slope),
          0.5 * (plus.energy + minus.energy)};
}

ShearResponse ShearLaw::respond(double gamma, double deviation2) const {
  const double measure = std::sqrt(gamma * gamma + deviation2);
  if (odd()) {
    const LawPoint law = at(measure);
    const double secant = measure > small ? law.value / measure : law.slope;
    return {secant * gamma, secant, law.energy};
  }
  const double g = std::max(small, measure);
  const LawPoint plus = at(g), minus = at(-g);
  const double odd_secant = 0.5 * (plus.value - minus.value) / g,
               even_secant = 0.5 * (plus.value + minus.value) / g,
               even_energy = 0.5 * (plus.energy - minus.energy);
  const double u = gamma / g, b = side_cubic;
  const double phi = u * (1.0 + b - b * (u * u)), rise = 1.0 + b - 3.0 * b * (u * u); // phi'
  const double turn = rise * (even_energy / (g * g));
  const double secant = odd_secant + phi * even_secant - u * turn;
  return {gamma * secant + measure * turn, secant,
          0.5 * (plus.energy + minus.energy) + phi * even_energy};
}

} // namespace plyform
