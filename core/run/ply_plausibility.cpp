// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/ply_plausibility.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/model/motion.hpp"
#include "core/results/statistics.hpp"
#include "core/run/measured_limits.hpp"
#include "core/run/ply_motion.hpp"
#include "core/run/temperature_doubts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace plyform {
namespace {

/// mm, of the lines of (1): about a yarn, and finer than the mesh.
double line_spacing(const std::vector<double>& areas) {
  double whole = 0.0;
  for (const double area : areas)
    whole += area;
  return std::min(2.0, std::sqrt(whole / static_cast<double>(areas.size())));
}

Vec3 formed_centroid(const PlyFrame& ply, std::size_t t) {
  const Triangle& n = ply.triangles[t];
  return (ply.x[at(n[0])] + ply.x[at(n[1])] + ply.x[at(n[2])]) / 3.0;
}

/// A straight line along one yarn.
struct YarnLine {
  double excess = 0.0;      ///< mm
  double most = 0.0;        ///< largest compressive strain
  std::size_t triangle = 0; ///< where that is
};

/// Adds the compression of one triangle (`pressed`, strain) to (1) of the lines that cross it.
/// across: coordinates of its corners normal to the lines, from line 0, in units of the spacing,
/// mm; area: mm^2.
void add_chords(std::array<double, 3> across, double spacing, double area, double pressed,
                std::size_t triangle, std::vector<YarnLine>& lines) {
  std::sort(across.begin(), across.end());
  const auto [low, middle, high] = across;
  if (!(high > low)) return;
  // The chord through the corner with the middle coordinate is the longest; from it the length of
  // chords decreases linearly to both sides.
  const double longest = 2.0 * area / ((high - low) * spacing);
  for (auto k = static_cast<std::size_t>(std::ceil(std::max(low, 0.0)));
       static_cast<double>(k) < high && k < lines.size(); ++k) {
    const auto v = static_cast<double>(k);
    const double share = v < middle ? (v - low) / (middle - low) : (high - v) / (high - middle);
    YarnLine& line = lines[k];
    line.excess += longest * share * pressed;
    if (pressed > line.most) line.most = pressed, line.triangle = triangle;
  }
}

/// The line of one family that has the largest (1). angle: rad, of the yarns before forming.
YarnLine worst_line(const PlyFrame& ply, const std::vector<double>& strain,
                    const std::vector<double>& areas, double angle) {
  const Vec3 across(-std::sin(angle), std::cos(angle), 0.0);
  double low = 0.0, high = 0.0;
  for (const Vec3& x : ply.x0) {
    const double v = across.dot(x - ply.x0.front());
    low = std::min(low, v), high = std::max(high, v);
  }
  const double spacing = line_spacing(areas);
  // The first line lies half a spacing inside, so that none lies on the edge of the ply.
  const Vec3 start = ply.x0.front() + (low + 0.5 * spacing) * across;
  std::vector<YarnLine> lines(1 + static_cast<std::size_t>((high - low) / spacing));
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    if (!(strain[t] < 0.0)) continue;
    std::array<double, 3> v{};
    for (std::size_t k = 0; k < 3; ++k)
      v[k] = across.dot(ply.x0[at(ply.triangles[t][k])] - start) / spacing;
    add_chords(v, spacing, areas[t], -strain[t], t, lines);
  }
  return *std::max_element(lines.begin(), lines.end(), [](const YarnLine& a, const YarnLine& b) {
    return a.excess < b.excess;
  });
}

/// Strain of each family where it is negative and crimp does not explain it; else it is 0 or more.
std::vector<std::vector<double>> strains_beyond_crimp(const PlyFrame& ply,
                                                      const std::vector<Crossing>& crossings) {
  std::vector<std::vector<double>> strain;
  for (const FamilyFrame& family : ply.families)
    strain.push_back(family.strain);
  for (const Crossing& c : crossings) {
    if (!c.crimp) continue;
    const std::vector<double>&first = ply.families[c.first].strain,
          &second = ply.families[c.second].strain;
    for (std::size_t t = 0; t < first.size(); ++t) {
      strain[c.first][t] -= c.crimp->shortest(0, second[t]);
      strain[c.second][t] -= c.crimp->shortest(1, first[t]);
    }
  }
  return strain;
}

PressedYarns pressed_yarns(const PlyFrame& ply, const std::vector<Crossing>& crossings,
                           const std::vector<double>& areas) {
  PressedYarns result;
  const std::vector<std::vector<double>> strains = strains_beyond_crimp(ply, crossings);
  // compressive strain of the family that is compressed most
  std::vector<double> pressed(ply.triangles.size());
  for (std::size_t t = 0; t < pressed.size(); ++t) {
    for (const std::vector<double>& strain : strains)
      if (!std::isnan(pressed[t]) && !(strain[t] >= -pressed[t])) pressed[t] = -strain[t];
    result.largest = std::isnan(result.largest) || std::isnan(pressed[t])
                         ? std::numeric_limits<double>::quiet_NaN()
                         : std::max(result.largest, pressed[t]);
  }
  result.share_above_2 = area_share_above(pressed, 0.02, areas);
  result.share_above_5 = area_share_above(pressed, 0.05, areas);
  for (std::size_t a = 0; a < strains.size(); ++a) {
    const YarnLine line = worst_line(ply, strains[a], areas, ply.families[a].angle_deg * degree);
    if (!(line.excess > result.excess_mm)) continue;
    result.excess_mm = line.excess;
    result.excess_at = formed_centroid(ply, line.triangle);
  }
  return result;
}

/// The openings of families that have the column. limits: of families, or empty.
std::vector<Opening> openings_of(const PlyFrame& ply,
                                 const std::vector<std::optional<double>>& limits,
                                 const std::vector<double>& areas) {
  std::vector<Opening> found;
  for (std::size_t a = 0; a < ply.families.size(); ++a) {
    const std::vector<double>& values = ply.families[a].opening;
    if (values.empty()) continue;
    Opening& opening = found.emplace_back();
    opening.family = ply.families[a].name;
    const auto widest = std::max_element(values.begin(), values.end());
    opening.largest = *widest;
    opening.at = formed_centroid(ply, static_cast<std::size_t>(widest - values.begin()));
    if (a >= limits.size() || !limits[a]) continue;
    opening.limit = limits[a];
    opening.beyond_share = area_share_above(values, *limits[a], areas);
    opening.beyond_mm2 = opening.beyond_share * std::accumulate(areas.begin(), areas.end(), 0.0);
  }
  return found;
}

/// What the excess length of compressed yarns would be in reality, and what to do about it.
std::string remedy(const Fabric& fabric) {
  if (!bears_compression(fabric))
    return "this fabric's yarns carry tension only: give it compression_stiffness, and bending "
           "that "
           "makes wrinkles of it";
  std::string result;
  if (std::any_of(fabric.families.begin(), fabric.families.end(), [](const YarnFamily& family) {
        return std::isfinite(family.tension.buckling_force);
      }))
    result = "they gave way at buckling_force, in wrinkles that the mesh does not show, and whose "
             "place it does not know; ";
  return result +
         "less friction or a wider gap below the blank-holder presses them less, a finer mesh "
         "can show them as wrinkles";
}

/// Factor by which elements must be smaller for a penetration between nodes of at most a thickness:
/// by (1) and (2) of core/run/facet_penetration.hpp it grows with the square of a side on curved
/// surfaces, and linearly on sharp edges, which mesh tools may have.
double refinement(const ToolState& tool, const ToolCut& cut) {
  const double radius = smallest_radius(tool.body.shape), excess = cut.depth / cut.thickness;
  const bool curved = std::isfinite(radius) && radius > cut.thickness;
  constexpr double margin = 1.2; // without it, hemisphere_0 at 3.9 for 6.8 mm has 0.64 for 0.6 mm
  return margin * (curved ? std::sqrt(excess) : excess);
}

/// Plies with the same remedy share a sentence.
std::vector<std::string> doubts_of_yarns(const Scene& s, const Frame& last,
                                         const std::vector<PlyReport>& plies) {
  struct Group {
    std::vector<std::string> names;
    double least_share = 1.0, most_share = 0.0, largest = 0.0;
  };
  std::map<std::string, Group> groups; // by remedy
  for (std::size_t p = 0; p < plies.size(); ++p) {
    const std::optional<PressedYarns>& pressed = plies[p].pressed;
    if (!pressed || !(pressed->share_above_5 > doubtful_pressed_share)) continue;
    const auto fabric = static_cast<std::size_t>(s.data.plies[p].fabric);
    Group& group = groups[remedy(s.data.fabrics[fabric])];
    group.names.push_back(last.plies[p].name);
    group.least_share = std::min(group.least_share, pressed->share_above_5);
    group.most_share = std::max(group.most_share, pressed->share_above_5);
    group.largest = std::max(group.largest, pressed->largest);
  }
  std::vector<std::string> found;
  for (const auto& [what_to_do, group] : groups) {
    const bool one = group.names.size() == 1;
    found.push_back(fmt::format(
        "do not trust the shape, shear and draw-in of {}: yarns are pressed by more than 5 % on "
        "{}{:.2g} % of the area, by {:.2g} % at most, and yarns of cloth buckle before that; {}",
        joined(group.names), one ? "" : fmt::format("{:.2g} to ", 100.0 * group.least_share),
        100.0 * group.most_share, 100.0 * group.largest, what_to_do));
  }
  return found;
}

} // namespace

namespace {

/// Tools that press the plies between them.
std::vector<std::string> doubts_of_pressed(const Scene& s, const std::vector<KnownForce>& known) {
  std::vector<std::string> names;
  KnownForce first;
  for (std::size_t t = 0; t < known.size(); ++t) {
    if (known[t].to_end()) continue;
    names.push_back(s.tools[t].name);
    if (known[t].time_s < first.time_s) first = known[t];
  }
  if (names.empty()) return {};
  return {fmt::format(
      "do not trust the force of {} after {}: they press the plies between them "
      "with less room than {}, and nothing gives way but contact, whose stiffness "
      "is a number of the solver; {}, or push one by a force",
      joined(names),
      whole_stroke(s.data) != 0.0 ? fmt::format("{:.4g} mm", first.stroke_mm)
                                  : fmt::format("{:.4g} s", first.time_s),
      s.any_thickness_acts ? "the densest packing of their fabrics" : "the plies are thick",
      s.any_thickness_acts
          ? "leave them room for that"
          : "give their fabrics a compaction, leave them the thickness of the stack")};
}

/// Mean element size (mm) of the plies that have touched a tool, the largest.
double element_on(const Scene& s, const ToolState& tool) {
  double size = 0.0;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    if (tool.contacts[p].sums.deepest == 0.0) continue;
    double area = 0.0;
    for (const double a : s.plies[p].membrane.node_area)
      area += a;
    const auto triangles = static_cast<double>(s.plies[p].membrane.triangles.size());
    size = std::max(size, std::sqrt(2.0 * area / triangles));
  }
  return size;
}

/// Tools over whose edges the mesh does not follow.
std::vector<std::string> doubts_of_edges(const Scene& s, const std::vector<AstrayForce>& astray) {
  std::vector<std::string> found;
  for (std::size_t t = 0; t < astray.size(); ++t) {
    if (!(astray_share(astray[t]) > doubtful_astray_share)) continue;
    const ToolState& tool = s.tools[t];
    const double radius = smallest_radius(tool.body.shape), size = element_on(s, tool);
    const std::string edge = std::isfinite(radius)
                                 ? fmt::format("its smallest radius is {:g} mm", radius)
                                 : std::string("its edges are sharper than that");
    found.push_back(fmt::format(
        "do not trust forces and draw-in over the edges of {}: elements of {:.3g} mm do not follow "
        "them ({}), and contact at their nodes holds and pushes the plies by {:.2g} % of the load "
        "that draws them: friction there is the mesh's; elements of half the radius, or a rounder "
        "edge, avoid it",
        tool.name, size, edge, 100.0 * astray_share(astray[t])));
  }
  return found;
}

/// Plies that touched, though they were taken to be out of reach of each other.
std::vector<std::string> doubts_of_reach(const Scene& s) {
  std::vector<std::string> found;
  each_pass(s, [&](const PlyContact& c) {
    const PlyBody &a = s.plies[c.slave], &b = s.plies[c.master];
    if (c.slave > c.master || a.stack == b.stack || !(c.contact.sums.deepest > 0.0)) return;
    found.push_back(
        fmt::format("do not trust {} and {} where they press each other: they began too "
                    "far apart to be taken for a stack, for which compression and "
                    "bending of yarns are estimated; let them begin nearer, or give "
                    "their fabrics these keys",
                    a.name, b.name));
  });
  return found;
}

} // namespace

std::vector<std::string> doubts_of_forces(const Scene& s, const std::vector<KnownForce>& known,
                                          const std::vector<AstrayForce>& astray) {
  std::vector<std::string> found = doubts_of_pressed(s, known);
  for (const auto& more : {doubts_of_edges(s, astray), doubts_of_reach(s)})
    found.insert(found.end(), more.begin(), more.end());
  return found;
}

PlyReport report_ply(const PlyFrame& ply, const PlyNature& nature,
                     const std::vector<const ToolBody*>& tools) {
  PlyReport result;
  const std::vector<double> areas = areas_before(ply);
  if (nature.has_yarns) result.pressed = pressed_yarns(ply, nature.crossings, areas);
  result.wrinkle = wrinkles_of(ply, tools).highest;
  if (!ply.bridging_height.empty()) {
    result.bridging = bridging_of(ply);
    if (!nature.has_yarns) result.bridging->family.clear();
  }
  result.fibre_volume = fibre_volume_of(ply);
  result.mould = mould_fill_of(ply);
  if (nature.locking_angle_deg) {
    std::vector<double> shear = ply.shear_deg;
    for (double& angle : shear)
      angle = std::abs(angle);
    result.locking_angle_deg = nature.locking_angle_deg;
    result.beyond_locking_share = area_share_above(shear, *nature.locking_angle_deg, areas);
  }
  if (const std::vector<double>& stretch = ply.stretch[0]; !stretch.empty()) {
    result.max_stretch = *std::max_element(stretch.begin(), stretch.end());
    result.stretch_limit = nature.stretch_limit;
    if (nature.stretch_limit)
      result.beyond_stretch_share = area_share_above(stretch, *nature.stretch_limit, areas);
  }
  if (!ply.largest_rate.empty()) {
    result.max_shear_rate = *std::max_element(ply.largest_rate.begin(), ply.largest_rate.end());
    result.measured_shear_rate = nature.measured_rate;
    if (nature.measured_rate)
      result.beyond_rate_share = area_share_above(ply.largest_rate, *nature.measured_rate, areas);
  }
  result.openings = openings_of(ply, nature.opening_limits, areas);
  result.draw_in = draw_in(ply);
  result.stitches = broken_stitches(ply);
  return result;
}

std::vector<PlyReport> report_plies(const Scene& s, const Frame& last) {
  std::vector<const ToolBody*> tools;
  for (const ToolState& tool : s.tools)
    tools.push_back(&tool.body);
  std::vector<PlyReport> result;
  for (std::size_t p = 0; p < last.plies.size(); ++p) {
    const Fabric& fabric = s.data.fabrics[s.data.plies[p].fabric];
    PlyNature nature{fabric.has_yarns(), std::nullopt, {}, fabric.crossings};
    for (const YarnFamily& family : fabric.families)
      nature.opening_limits.push_back(family.opening_limit);
    nature.stretch_limit = fabric.stretch_limit;
    nature.measured_rate = highest_measured_rate(fabric);
    if (fabric.locking_angle) nature.locking_angle_deg = *fabric.locking_angle / degree;
    result.push_back(report_ply(last.plies[p], nature, tools));
  }
  return result;
}

std::vector<std::string> doubts(const Scene& s, const Frame& last,
                                const std::vector<PlyReport>& plies,
                                const std::vector<ToolCut>& cuts) {
  std::vector<std::string> found = doubts_of_yarns(s, last, plies);
  if (const double error = last.energy.balance_error();
      !(std::abs(error) <= doubtful_balance_error))
    found.push_back(fmt::format("do not trust forces: the energy balance is off by {:.2g} %, "
                                "energy that comes from nowhere "
                                "or goes nowhere; a smaller solver.step_factor makes it less",
                                100.0 * error));
  for (auto&& of :
       {doubts_of_motion(s, last), doubts_of_limits(last, plies), doubts_of_temperature(s, last)})
    found.insert(found.end(), of.begin(), of.end());
  for (const ToolState& tool : s.tools) {
    std::vector<std::string> names;
    ToolCut worst;
    for (const ToolCut& cut : cuts) {
      if (cut.tool != tool.name || !(cut.depth > cut.thickness)) continue;
      names.push_back(cut.ply);
      if (cut.depth > worst.depth) worst = cut;
    }
    if (!names.empty())
      found.push_back(fmt::format(
          "do not trust {} where {} cuts into it between nodes, by {:.2g} mm at most, more than "
          "the "
          "thickness of {:g} mm: nodes are too far apart to follow the tool; elements {:.1f} times "
          "smaller or a rounder tool avoid it",
          joined(names), tool.name, worst.depth, worst.thickness, refinement(tool, worst)));
  }
  return found;
}

} // namespace plyform
