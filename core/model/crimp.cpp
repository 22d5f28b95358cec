// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/crimp.hpp"

#include "base/format.hpp"
#include "core/model/case.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// A yarn of a cell at one strain, whatever its height.
struct HalfWave {
  const TensionLaw& law;
  double span;   ///< p_a (1 + eps_a), mm
  double length; ///< L_a0, mm

  /// mm, the height up to which it is slack.
  double slack_height() const {
    return span < length ? std::sqrt((length - span) * (length + span)) : 0.0;
  }
};

/// It at one height.
struct AtHeight {
  double sine, cosine; ///< of its inclination
  double tension;      ///< T_a, N
  double stored;       ///< w_a / L_a0, N mm/mm
  /// N/mm: d2w by span and height: k c^2 + t s^2, k c s - t c s, k s^2 + t c^2
  double along, mixed, upwards;
};

AtHeight at_height(const HalfWave& yarn, double height) {
  const double length = std::sqrt(yarn.span * yarn.span + height * height);
  const double sine = height / length, cosine = yarn.span / length;
  const double elongation = length / yarn.length - 1.0;
  if (!(elongation > 0.0)) return {sine, cosine, 0.0, 0.0, 0.0, 0.0, 0.0};
  const LawPoint law = yarn.law.at(elongation);
  const double k = law.slope / yarn.length, t = law.value / length;
  return {sine,
          cosine,
          law.value,
          law.energy,
          k * cosine * cosine + t * sine * sine,
          (k - t) * cosine * sine,
          k * sine * sine + t * cosine * cosine};
}

/// (C2) by Newton's method, halving where it leaves the bracket. Both yarns are taut within.
double balanced_height(const HalfWave& first, const HalfWave& second, double heights, double low,
                       double high) {
  constexpr int most = 100;       // halving alone ends after 60
  constexpr double small = 1e-12; // of the heights: the step after leaves its square
  double h = std::clamp(0.5 * heights, low, high);
  for (int i = 0; i < most && low < high; ++i) {
    const AtHeight a = at_height(first, h), b = at_height(second, heights - h);
    const double force = a.tension * a.sine - b.tension * b.sine, slope = a.upwards + b.upwards;
    const double step = slope > 0.0 ? -force / slope : heights;
    if (std::abs(step) <= small * heights) return std::clamp(h + step, low, high);
    (force > 0.0 ? high : low) = h;
    h = h + step > low && h + step < high ? h + step : 0.5 * (low + high);
  }
  return h;
}

} // namespace

double CrimpedCell::height(std::size_t a) const {
  return half_wave[a] * std::sqrt(crimp[a] * (2.0 + crimp[a]));
}

double CrimpedCell::shortest(std::size_t a, double other) const {
  const std::size_t b = 1 - a;
  const double given = std::min(half_wave[b] * (1.0 + std::max(0.0, other)), length(b));
  const double left = std::sqrt((length(b) - given) * (length(b) + given)); // of the other's height
  const double taken = std::min(heights() - left, length(a));
  return std::sqrt((length(a) - taken) * (length(a) + taken)) / half_wave[a] - 1.0;
}

CellAnswer answer_of(const CrimpedCell& cell, const std::array<double, 2>& strain,
                     const TensionLaw& first, const TensionLaw& second) {
  const double heights = cell.heights();
  const std::array<HalfWave, 2> yarn{
      {{first, cell.half_wave[0] * (1.0 + strain[0]), cell.length(0)},
       {second, cell.half_wave[1] * (1.0 + strain[1]), cell.length(1)}}};
  const double low = std::min(yarn[0].slack_height(), heights);
  const double high = heights - std::min(yarn[1].slack_height(), heights);
  CellAnswer answer;
  answer.height = low;
  const bool slack =
      low >= high && yarn[0].span <= yarn[0].length && yarn[1].span <= yarn[1].length;
  if (slack) return answer;
  answer.height = low < high ? balanced_height(yarn[0], yarn[1], heights, low, high) : low;
  const AtHeight a = at_height(yarn[0], answer.height),
                 b = at_height(yarn[1], heights - answer.height);
  answer.pull = {a.tension * a.cosine, b.tension * b.cosine};
  answer.stored = {a.stored * (1.0 + cell.crimp[0]), b.stored * (1.0 + cell.crimp[1])};
  const bool at_end = answer.height <= 0.0 || answer.height >= heights;
  const double upwards = at_end ? 0.0 : a.upwards + b.upwards;
  const double give = upwards > 0.0 ? 1.0 / upwards : 0.0;
  answer.slope = {cell.half_wave[0] * (a.along - a.mixed * a.mixed * give),
                  cell.half_wave[1] * (b.along - b.mixed * b.mixed * give)};
  answer.cross = cell.half_wave[0] * cell.half_wave[1] * a.mixed * b.mixed * give;
  return answer;
}

std::vector<std::string> describe_crimp(const Case& data) {
  std::vector<std::string> lines;
  for (const Fabric& fabric : data.fabrics)
    for (const Crossing& c : fabric.crossings) {
      if (!c.crimp) continue;
      const CrimpedCell& cell = *c.crimp;
      lines.push_back(fmt::format(
          "{}: {} and {} in waves of {:.3g} and {:.3g} mm over {:.3g} and {:.3g} mm; with the "
          "other family free they are straight, and taut, from strains of {:.3g} and {:.3g} % on",
          fabric.name, fabric.families[c.first].name, fabric.families[c.second].name,
          cell.height(0), cell.height(1), cell.half_wave[0], cell.half_wave[1], 100.0 * cell.toe(0),
          100.0 * cell.toe(1)));
    }
  return lines;
}

} // namespace plyform
