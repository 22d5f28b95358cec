// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/parts/crimp_file.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plyform {
namespace {

constexpr const char* ratio_key = "ratio";
constexpr const char* height_key = "height";

using OfTwo = std::array<double, 2>;

struct CrimpReader {
  const TableView& section;
  const Fabric& fabric;
  const Crossing& crossing;
  Diagnostics& diagnostics;
  OfTwo crimp{}, spacing{}; ///< c_a; mm, distance along a family of the yarns that it crosses

  const std::string& name(std::size_t a) const {
    return fabric.families[a == 0 ? crossing.first : crossing.second].name;
  }
  /// Height of a wave over its length.
  double slope(std::size_t a) const { return std::sqrt(crimp[a] * (2.0 + crimp[a])); }
  void fail(const char* key, const std::string& rule, const std::string& remedy) const {
    value_error(section, key, rule, remedy, diagnostics);
  }

  bool waves_have_length(const OfTwo& height) const;
  double floats(const OfTwo& height) const;
  void check_room(const CrimpedCell& cell) const;
};

/// Reports a height without crimp, or the other way round.
bool CrimpReader::waves_have_length(const OfTwo& height) const {
  for (std::size_t a = 0; a < 2; ++a) {
    if ((crimp[a] > 0.0) == (height[a] > 0.0)) continue;
    fail(height_key,
         fmt::format("has {:g} mm for {}, whose crimp is {:g}: both are 0 of a straight "
                     "yarn, and none of another",
                     height[a], name(a), crimp[a]),
         fmt::format("give {} a height of {:.3g}, that of a plain weave, or change its {}", name(a),
                     slope(a) * spacing[a], ratio_key));
    return false;
  }
  return true;
}

/// Spacings in half a wave, by heights and crimps; NaN if they cannot be.
double CrimpReader::floats(const OfTwo& height) const {
  constexpr double rounding = 0.05; // of numbers from a microscope
  if (!waves_have_length(height)) return not_given;
  OfTwo each{};
  for (std::size_t a = 0; a < 2; ++a)
    each[a] = crimp[a] > 0.0 ? height[a] / (slope(a) * spacing[a]) : 0.0;
  const bool both = each[0] > 0.0 && each[1] > 0.0;
  const double mean = both ? 0.5 * (each[0] + each[1]) : std::max(each[0], each[1]);
  if (both && std::abs(each[0] - each[1]) > 2.0 * rounding * mean) {
    fail(height_key,
         fmt::format("makes half a wave of {} {:.3g} spacings of the yarns that it crosses long, "
                     "and of {} {:.3g}: yarns that cross have equally many waves",
                     name(0), each[0], name(1), each[1]),
         fmt::format("with {:g} mm of {} the wave of {} is {:.3g} mm high; or change {}, or the "
                     "densities",
                     height[0], name(0), name(1), each[0] * slope(1) * spacing[1], ratio_key));
    return not_given;
  }
  if (mean < 1.0 - rounding) {
    fail(height_key,
         fmt::format("makes half a wave {:.3g} spacings of the yarns that it crosses long, and a "
                     "yarn can go up and down at each of them at most",
                     mean),
         fmt::format("give [{:.3g}, {:.3g}], those of a plain weave, or less {}",
                     slope(0) * spacing[0], slope(1) * spacing[1], ratio_key));
    return not_given;
  }
  return std::max(mean, 1.0);
}

/// Reports waves that a yarn is too short for, and warns of those that the fabric is too thin for.
void CrimpReader::check_room(const CrimpedCell& cell) const {
  for (std::size_t a = 0; a < 2; ++a)
    if (cell.heights() >= cell.length(a))
      return fail(ratio_key,
                  fmt::format("makes waves of {:.3g} and {:.3g} mm, and {} has only {:.3g} mm of "
                              "yarn between two crossings: it could not take both heights",
                              cell.height(0), cell.height(1), name(a), cell.length(a)),
                  "give less");
  constexpr double over = 1.5; // yarns bend and flatten; percentages for shares give ten times
  const TomlNode* given_ratio = given(section, ratio_key);
  if (!given_ratio || !(cell.heights() > over * fabric.thickness)) return;
  diagnostics.warning(
      given_ratio->at,
      fmt::format("{}: makes waves of {:.3g} and {:.3g} mm, and together they are about as high as "
                  "a fabric is thick, here {:g} mm: crimps are shares of 1, no percentages",
                  item_of(section, ratio_key), cell.height(0), cell.height(1), fabric.thickness));
}

} // namespace

void read_crimp(const TableView& section, const Fabric& fabric, Crossing& crossing,
                Diagnostics& diagnostics) {
  if (!section.entry) return;
  const std::vector<double> ratio = numbers(section, ratio_key),
                            heights = numbers(section, height_key);
  CrimpReader reader{section, fabric, crossing, diagnostics, {}, {}};
  reader.spacing = crossing_spacing(fabric, crossing);
  if (ratio.size() != 2 || !(reader.spacing[0] + reader.spacing[1] > 0.0)) return;
  reader.crimp = {ratio[0], ratio[1]};
  if (ratio[0] == 0.0 && ratio[1] == 0.0)
    return reader.fail(ratio_key, "says that neither yarn has any crimp",
                       "take the table out, or give at least one of them more than 0");
  for (const std::size_t a : {crossing.first, crossing.second})
    if (fabric.families[a].relaxation)
      return reader.fail(ratio_key, "is of yarns that relax, and a cell knows elastic yarns only",
                         "take the table out, or the relaxation of " + fabric.families[a].name);
  const double floats = heights.size() == 2 ? reader.floats({heights[0], heights[1]}) : 1.0;
  if (!(floats >= 1.0)) return;
  const CrimpedCell cell{{floats * reader.spacing[0], floats * reader.spacing[1]}, reader.crimp};
  reader.check_room(cell);
  crossing.crimp = cell;
}

} // namespace plyform
