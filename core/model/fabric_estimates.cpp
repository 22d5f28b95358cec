// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/fabric_estimates.hpp"

#include "base/text.hpp"
#include "core/model/reach_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <vector>

namespace plyform {
namespace {

constexpr double compression_share = 0.01; // of tension
constexpr double bending_length = 70.0;    // mm
constexpr double zone_in_cells = 2.5;
constexpr double shear_scale_at = 0.5; // rad

/// Laws of warp (0) or weft (1).
TensionLaw& tension_of(Fabric& f, std::size_t family) {
  return family == 0 ? f.warp : f.weft;
}
MomentLaw& moments_of(Fabric& f, std::size_t family) {
  return family == 0 ? f.bending.warp : f.bending.weft;
}

/// Estimates C of a family whose file does not give it.
void estimate_compression(Fabric& f, std::size_t family) {
  ValueSource& source = f.sources[family].compression;
  if (source != ValueSource::missing) return;
  TensionLaw& law = tension_of(f, family);
  law.compression = usual_compression(law);
  source = ValueSource::estimated;
}

void estimate_for_stack(Fabric& f) {
  for (const std::size_t family : {0u, 1u}) {
    estimate_compression(f, family);
    if (tension_of(f, family).compression == 0.0) continue;
    YarnSources& sources = f.sources[family];
    if (sources.bending == ValueSource::missing) {
      moments_of(f, family).stiffness = usual_bending(f);
      sources.bending = ValueSource::estimated;
    }
    if (sources.in_plane_bending == ValueSource::missing && usual_in_plane_bending(f) > 0.0) {
      f.bending.in_plane[family] = usual_in_plane_bending(f);
      sources.in_plane_bending = ValueSource::estimated;
    }
  }
  if (!f.twist_given) f.bending.twist = usual_twist(f.bending);
}

void estimate_for_one_ply(Fabric& f) {
  for (const std::size_t family : {0u, 1u})
    if (moments_of(f, family).largest_slope() > 0.0 ||
        std::isfinite(tension_of(f, family).buckling_force))
      estimate_compression(f, family);
}

/// "460 / 480" of both families, "460 along the warp" if only that is estimated, "" if none is.
std::string both(const std::array<YarnSources, 2>& sources, ValueSource YarnSources::*which,
                 double warp, double weft, const char* unit, const char* format) {
  const bool first = sources[0].*which == ValueSource::estimated,
             second = sources[1].*which == ValueSource::estimated;
  const auto number = [&](double value) { return fmt::format(fmt::runtime(format), value); };
  if (!first && !second) return "";
  if (!second) return fmt::format("{} {} along the warp", number(warp), unit);
  if (!first) return fmt::format("{} {} along the weft", number(weft), unit);
  if (number(warp) == number(weft)) return fmt::format("{} {}", number(warp), unit);
  return fmt::format("{} / {} {}", number(warp), number(weft), unit);
}

std::string estimated_values(const Fabric& f) {
  std::vector<std::string> parts;
  const auto add = [&](const char* what, const std::string& values, const std::string& reason) {
    if (!values.empty()) parts.push_back(fmt::format("{} {} ({})", what, values, reason));
  };
  add("compression",
      both(f.sources, &YarnSources::compression, f.warp.compression, f.weft.compression,
           "N per yarn", "{:.4g}"),
      "1 % of tension");
  add("bending",
      both(f.sources, &YarnSources::bending, f.bending.warp.stiffness, f.bending.weft.stiffness,
           "N mm", "{:.2g}"),
      fmt::format("bending length {:g} mm", bending_length));
  add("in-plane bending",
      both(f.sources, &YarnSources::in_plane_bending, f.bending.in_plane[0], f.bending.in_plane[1],
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

double usual_twist(const BendingLaw& law) {
  return std::sqrt(law.warp.at(0.0).slope * law.weft.at(0.0).slope);
}

double usual_bending(const Fabric& fabric) {
  return fabric.weight() * bending_length * bending_length * bending_length;
}

double usual_zone_width(const Fabric& fabric) {
  return zone_in_cells * 2.0 / std::sqrt(fabric.warp_density * fabric.weft_density);
}

double shear_rigidity(const Fabric& fabric) {
  const double cells =
      fabric.warp_density * fabric.weft_density * std::sin(fabric.fibre_angle); // n_c
  const double start = fabric.shear.at(0.0).slope;
  return cells * (start > 0.0 ? start : fabric.shear.secant(shear_scale_at));
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
    const double warp = effective_softening(f.warp, asked),
                 weft = effective_softening(f.weft, asked);
    if (warp == asked && weft == asked) continue;
    lines.push_back(fmt::format("{}: solver.fibre_softening = {:g} divides the tension of warp and "
                                "weft by {:.3g} and {:.3g} only: they are then as stiff as in "
                                "compression, which is not softened",
                                f.name, asked, warp, weft));
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
