// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/fabric_estimates.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/model/reach_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace plyform {
namespace {

constexpr double compression_share = 0.01; // of tension
constexpr double bending_length = 70.0;    // mm
constexpr double length_across = 20.0;     // mm, of the sheet across yarns in one direction
constexpr double zone_in_cells = 2.5;
constexpr double shear_scale_at = 0.5; // rad

/// Estimates C of a family whose file does not give it.
void estimate_compression(YarnFamily& family) {
  ValueSource& source = family.sources.compression;
  if (source != ValueSource::missing) return;
  family.tension.compression = usual_compression(family.tension);
  source = ValueSource::estimated;
}

void estimate_for_stack(Fabric& f) {
  for (YarnFamily& family : f.families) {
    estimate_compression(family);
    if (family.tension.compression == 0.0) continue;
    YarnSources& sources = family.sources;
    if (sources.bending == ValueSource::missing) {
      family.bending.stiffness = usual_bending(f, family);
      sources.bending = ValueSource::estimated;
    }
    if (sources.in_plane_bending == ValueSource::missing && usual_in_plane_bending(f) > 0.0) {
      family.in_plane_bending = usual_in_plane_bending(f);
      sources.in_plane_bending = ValueSource::estimated;
    }
  }
  if (f.plate_source == ValueSource::missing && yarn_directions(f) == 1 && bears_compression(f)) {
    f.plate = usual_bending_across(f);
    f.plate_source = ValueSource::estimated;
  }
  if (!f.twist_given) f.twist = usual_twist(f);
}

void estimate_for_one_ply(Fabric& f) {
  for (YarnFamily& family : f.families)
    if (family.bending.largest_slope() > 0.0 || std::isfinite(family.tension.buckling_force))
      estimate_compression(family);
}

/// "460 / 480 N mm" of all families, "460 N mm along the warp" of those that are estimated if not
/// all are, "" if none is.
template <class ValueOf>
std::string of_families(const Fabric& f, ValueSource YarnSources::*which, const ValueOf& value_of,
                        const char* unit, const char* format) {
  std::vector<std::string> numbers, along;
  for (const YarnFamily& family : f.families) {
    if (family.sources.*which != ValueSource::estimated) continue;
    numbers.push_back(fmt::format(fmt::runtime(format), value_of(family)));
    along.push_back(fmt::format("{} {} along the {}", numbers.back(), unit, family.name));
  }
  if (numbers.empty()) return "";
  if (numbers.size() < f.families.size()) return joined(along);
  const bool same = std::all_of(numbers.begin(), numbers.end(),
                                [&](const std::string& n) { return n == numbers[0]; });
  return fmt::format("{} {}", same ? numbers[0] : joined(numbers, " / "), unit);
}

std::string estimated_values(const Fabric& f) {
  std::vector<std::string> parts;
  const auto add = [&](const char* what, const std::string& values, const std::string& reason) {
    if (!values.empty()) parts.push_back(fmt::format("{} {} ({})", what, values, reason));
  };
  add("compression",
      of_families(
          f, &YarnSources::compression, [](const YarnFamily& y) { return y.tension.compression; },
          "N per yarn", "{:.4g}"),
      "1 % of tension");
  add("bending",
      of_families(
          f, &YarnSources::bending, [](const YarnFamily& y) { return y.bending.stiffness; }, "N mm",
          "{:.2g}"),
      fmt::format("{}bending length {:g} mm",
                  is_weave(f) ? "" : "as of a weave with as many fibres along them, ",
                  bending_length));
  if (f.plate_source == ValueSource::estimated)
    add("bending across", fmt::format("{:.2g} N mm", f.plate),
        fmt::format("bending length {:g} mm, as of limp cloth", length_across));
  add("in-plane bending",
      of_families(
          f, &YarnSources::in_plane_bending, [](const YarnFamily& y) { return y.in_plane_bending; },
          "N mm", "{:.2g}"),
      fmt::format("zones of {:.3g} mm", usual_zone_width(f)));
  return joined(parts);
}

/// That a tool with a mass switches solver.mass_scaling off (core/solver/mass_scaling.hpp); empty
/// if none does.
std::string describe_mass_scaling(const Case& data) {
  if (data.solver.mass_scaling == 0.0) return {};
  for (const Tool& tool : taking_part(data).tools)
    if (tool.mass > 0.0)
      return fmt::format("no mass is added at stiff contacts (solver.mass_scaling), since tool {} "
                         "has a mass and swings on them",
                         tool.name);
  return {};
}

} // namespace

double usual_compression(const TensionLaw& law) {
  return compression_share * law.largest_slope();
}

double usual_twist(const Fabric& fabric) {
  const std::size_t families = fabric.families.size();
  if (families == 0 || families > 2) return 0.0;
  const double second = families == 2 ? fabric.families[1].bending.at(0.0).slope : 0.0;
  return std::sqrt((fabric.families[0].bending.at(0.0).slope + fabric.plate) *
                   (second + fabric.plate));
}

double usual_bending(const Fabric& fabric, const YarnFamily& family) {
  double weight = fabric.weight();
  if (!is_weave(fabric)) {
    const auto fibres = [](const YarnFamily& f) { return f.density * f.tension.largest_slope(); };
    double all = 0.0;
    for (const YarnFamily& other : fabric.families)
      all += fibres(other);
    weight *= 2.0 * fibres(family) / all;
  }
  return weight * bending_length * bending_length * bending_length;
}

double usual_bending_across(const Fabric& fabric) {
  return fabric.weight() * length_across * length_across * length_across;
}

double usual_zone_width(const Fabric& fabric) {
  if (fabric.families.empty()) return 0.0;
  if (fabric.crossings.empty()) {
    double mean = 0.0; // of the logarithms of densities
    for (const YarnFamily& family : fabric.families)
      mean += std::log(family.density) / static_cast<double>(fabric.families.size());
    return zone_in_cells * 2.0 / std::exp(mean);
  }
  const Crossing& c = fabric.crossings[0];
  return zone_in_cells * 2.0 /
         std::sqrt(fabric.families[c.first].density * fabric.families[c.second].density);
}

double shear_rigidity(const Fabric& fabric) {
  double rigidity = 0.0;
  for (const Crossing& c : fabric.crossings) {
    const double start = c.shear.odd_part(0.0).slope;
    const double secant = c.shear.odd_part(shear_scale_at).value / shear_scale_at;
    rigidity += cells_per_area(fabric, c) * (start > 0.0 ? start : secant);
  }
  if (fabric.sheet)
    rigidity += std::visit([](const auto& law) { return law.shear_stiffness(); }, *fabric.sheet);
  return rigidity;
}

double usual_in_plane_bending(const Fabric& fabric) {
  const double l = usual_zone_width(fabric);
  return shear_rigidity(fabric) * l * l;
}

void estimate_missing(Case& data) {
  const ReachAhead ahead = reach_ahead(data);
  std::array<std::map<int, std::vector<std::size_t>>, 2> plies_of; // by fabric; [1]: in stacks
  for (std::size_t p = 0; p < data.plies.size(); ++p)
    plies_of[ahead.plies_in_stack(p) > 1 ? 1 : 0][data.plies[p].fabric].push_back(p);
  for (const auto& [index, alone] : plies_of[0]) {
    if (!data.fabrics[index].has_yarns()) continue;
    int own = index;
    if (plies_of[1].contains(index)) { // plies that lie alone are not of the stack's yarns
      own = static_cast<int>(data.fabrics.size());
      data.fabrics.push_back(Fabric(data.fabrics[index]));
      for (const std::size_t p : alone)
        data.plies[p].fabric = own;
    }
    estimate_for_one_ply(data.fabrics[own]);
  }
  for (const auto& [index, stacked] : plies_of[1])
    if (data.fabrics[index].has_yarns()) estimate_for_stack(data.fabrics[index]);
}

std::vector<std::string> describe_estimates(const Case& data) {
  const ReachAhead ahead = reach_ahead(data);
  std::vector<char> stacked(data.fabrics.size(), 0);
  for (std::size_t p = 0; p < data.plies.size(); ++p)
    if (ahead.plies_in_stack(p) > 1) stacked[at(data.plies[p].fabric)] = 1;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < data.fabrics.size(); ++i) {
    const Fabric& f = data.fabrics[i];
    const std::string values = estimated_values(f);
    if (values.empty()) continue;
    const char* why = stacked[i] ? "since a stack of plies presses its yarns"
                                 : "since yarns that bend or buckle need it";
    lines.push_back(
        fmt::format("{}: {}: estimated, {}; give the keys, or compression_stiffness = 0 "
                    "for yarns that carry tension only",
                    f.name, values, why));
  }
  return lines;
}

std::vector<std::string> describe_softening(const Case& data) {
  const double asked = data.solver.fibre_softening;
  std::vector<std::string> lines;
  for (const Fabric& f : data.fabrics) {
    std::vector<std::string> names, factors;
    bool limited = false;
    for (const YarnFamily& family : f.families) {
      const double factor = effective_softening(family.tension, asked);
      limited = limited || factor != asked;
      names.push_back(family.name);
      factors.push_back(fmt::format("{:.3g}", factor));
    }
    if (!limited) continue;
    lines.push_back(fmt::format("{}: solver.fibre_softening = {:g} divides the tension of {} by {} "
                                "only: they are then as stiff as in compression, which is not "
                                "softened",
                                f.name, asked, joined(names, " and "), joined(factors, " and ")));
  }
  return lines;
}

std::vector<std::string> assumptions(const Case& data) {
  std::vector<std::string> lines = describe_estimates(data);
  for (std::string& line : describe_softening(data))
    lines.push_back(std::move(line));
  if (std::string line = describe_mass_scaling(data); !line.empty()) lines.push_back(line);
  return lines;
}

} // namespace plyform
