// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/fabric_freedoms.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/model/fabric_estimates.hpp"

#include <algorithm>

namespace plyform {
namespace {

std::vector<std::string> names_of(const Fabric& f) {
  std::vector<std::string> names;
  for (const YarnFamily& family : f.families)
    names.push_back(family.name);
  return names;
}

/// Names of the families that carry tension only.
std::vector<std::string> limp_families(const Fabric& f) {
  std::vector<std::string> names;
  for (const YarnFamily& family : f.families)
    if (family.tension.compression == 0.0) names.push_back(family.name);
  return names;
}

/// What holds yarns in one direction together.
std::string of_one_direction(const Fabric& f) {
  if (!f.sheet) return "across " + f.families[0].name + " stitches alone hold it together";
  return fmt::format("across {} and in shear {} together, by {:.3g} N/mm for its strain and {:.3g} "
                     "N/mm for the angle",
                     f.families[0].name,
                     f.stitches.empty() ? "the sheet alone holds it"
                                        : "the sheet, and stitches where they are taut, hold it",
                     std::visit([](const auto& law) { return law.plane_stiffness(); }, *f.sheet),
                     shear_rigidity(f));
}

std::string of_two_directions(const Fabric& f) {
  const double rigidity = shear_rigidity(f);
  const std::string between = joined(names_of(f), " and ");
  if (!(rigidity > 0.0) && !f.stitches.empty())
    return fmt::format("shear between {} is resisted by stitches alone, where they are taut",
                       between);
  if (!(rigidity > 0.0))
    return fmt::format("nothing resists shear between {}: it is free in its plane; give a "
                       "[[crossing]] or a [sheet]",
                       between);
  if (f.crossings.empty())
    return fmt::format(
        "shear between {} is resisted by the sheet{}, {:.3g} N/mm for the angle", between,
        f.stitches.empty() ? " alone" : ", and by stitches where they are taut", rigidity);
  return "";
}

/// Three families fix all three strains of the surface.
std::string of_three_directions(const Fabric& f) {
  return fmt::format("{} families of yarns: the sheet cannot shear; it drapes only what develops, "
                     "and is pressed along its yarns, or wrinkles, where a surface does not",
                     f.families.size() == 3 ? "three" : "more than two");
}

} // namespace

std::vector<std::string> describe_freedoms(const Fabric& f) {
  std::vector<std::string> lines;
  const auto say = [&](const std::string& line) {
    if (!line.empty()) lines.push_back(line);
  };
  if (!f.has_yarns()) return lines;
  const int directions = yarn_directions(f);
  say(directions == 1   ? of_one_direction(f)
      : directions == 2 ? of_two_directions(f)
                        : of_three_directions(f));
  if (is_weave(f)) return lines;
  if (const std::vector<std::string> limp = limp_families(f); !limp.empty())
    say(fmt::format("yarns of {} carry tension only: pressed along them {}", joined(limp, " and "),
                    f.sheet ? "the sheet alone resists" : "it gives way without force"));
  const bool bends = std::any_of(f.families.begin(), f.families.end(), [](const YarnFamily& y) {
    return y.bending.largest_slope() > 0.0;
  });
  if (directions == 1 && bends && f.plate == 0.0)
    say(fmt::format("across {} nothing resists bending: give sheet.bending_stiffness",
                    f.families[0].name));
  return lines;
}

std::vector<std::string> describe_freedoms(const Case& data) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < data.fabrics.size(); ++i)
    if (std::any_of(data.plies.begin(), data.plies.end(),
                    [&](const Ply& ply) { return at(ply.fabric) == i; }))
      for (const std::string& line : describe_freedoms(data.fabrics[i]))
        lines.push_back(fmt::format("{}: {}", data.fabrics[i].name, line));
  return lines;
}

} // namespace plyform
