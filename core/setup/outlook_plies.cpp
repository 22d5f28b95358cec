// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/outlook_plies.hpp"

#include "base/text.hpp"
#include "core/model/bending_resolution.hpp"
#include "core/model/fabric_estimates.hpp"
#include "core/model/mirror.hpp"
#include "core/model/motion.hpp"
#include "core/run/facet_penetration.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace plyform {
namespace {

/// The bending stiffness of a ply as text, or "no bending".
std::string bending_text(const PlyBody& ply) {
  if (!ply.bending) return "no bending";
  const Fabric& fabric = ply.membrane.fabric;
  const BendingLaw& law = ply.bending->law;
  if (!fabric.has_yarns()) return fmt::format("bends as a plate, {:.3g} N mm", fabric.plate);
  const auto along = [](const MomentLaw& moments) {
    return moments.curvature.empty() ? fmt::format("{:.3g}", moments.stiffness)
                                     : fmt::format("{:.3g} by table", moments.at(0.0).slope);
  };
  const auto force = [](const TensionLaw& yarn) {
    return yarn.buckles() ? fmt::format("{:.3g} N", yarn.buckling_force) : std::string("no force");
  };
  std::vector<std::string> bent, in_plane, compressed, buckling;
  bool buckles = false;
  for (const YarnFamily& f : fabric.families) {
    bent.push_back(
        fmt::format("{}{} along {}", along(f.bending), bent.empty() ? " N mm" : "", f.name));
    in_plane.push_back(fmt::format("{:.3g}", f.in_plane_bending));
    compressed.push_back(fmt::format("{:.3g}", f.tension.compression));
    buckling.push_back(force(f.tension));
    buckles = buckles || f.tension.buckles();
  }
  std::string text = fmt::format(
      "bending {}, {:.3g} in twist, {} in their plane, yarns compressed by {} N per strain",
      joined(bent, ", "), law.twist, joined(in_plane, " and "), joined(compressed, " and "));
  if (fabric.plate > 0.0) text += fmt::format(", the sheet by {:.2g} N mm", fabric.plate);
  if (buckles) text += fmt::format(", buckling at {}", joined(buckling, " and "));
  return text;
}

/// The element of a ply as text, and the reason for it.
std::string element_text(const Membrane& m, ElementKind asked) {
  const int triangles = static_cast<int>(m.triangles.size()), pairs = triangles - m.groups();
  const char* name = pairs == 0 ? "plain element" : "averaged element";
  if (asked != ElementKind::automatic) return fmt::format("{}: as solver.element says", name);
  constexpr double few = 0.01; // fraction of a band along the edge, or of single triangles
  const double plain = static_cast<double>(triangles - 2 * pairs) / triangles;
  if (plain > 1.0 - few) return "plain element: sides run along the fibres";
  if (plain < few)
    return "averaged element: sides do not run along the fibres, the plain element would "
           "lock";
  return fmt::format("plain element where sides run along the fibres ({:.0f} % of the "
                     "triangles), averaged element elsewhere, where it would lock",
                     100.0 * plain);
}

} // namespace

void describe_plies(const Scene& s, Lines& lines) {
  for (const PlyBody& ply : s.plies) {
    const Membrane& m = ply.membrane;
    Box3 box;
    for (const Vec3& x : ply.x0)
      box.extend(x);
    const std::string size = fmt::format("{:.4g} x {:.4g} mm at z = {:.4g}", box.sizes().x(),
                                         box.sizes().y(), box.center().z());
    if (!m.fabric.has_yarns()) {
      say(lines, "ply {}: {}, {} nodes, {} triangles, sheet without yarns; {}", ply.name, size,
          ply.x.size(), m.triangles.size(), bending_text(ply));
      continue;
    }
    say(lines, "ply {}: {}, {} nodes, {} triangles, {} at {:.10g} degrees; {}; {}", ply.name, size,
        ply.x.size(), m.triangles.size(), m.fabric.families[0].name,
        (ply.angle + m.fabric.families[0].angle) / degree, element_text(m, s.data.solver.element),
        bending_text(ply));
  }
}

void describe_locking(const Scene& s, Lines& lines) {
  constexpr double enough = 20.0; // elements across: load of the bias test at most 5 % too high
  std::set<std::pair<int, int>> seen;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const Membrane& m = s.plies[p].membrane;
    const bool averaged = m.groups() < static_cast<int>(m.triangles.size());
    const bool push = bears_compression(m.fabric);
    const Ply& ply = s.data.plies[p];
    if (!averaged || !push || !seen.emplace(ply.fabric, ply.blank).second) continue;
    Eigen::AlignedBox3d box;
    for (const Mirror& mirror : images_at(s.plies[p].planes))
      for (const Vec3& x : s.plies[p].x0)
        box.extend(mirror.place(x));
    const double width = box.sizes().head<2>().minCoeff();
    const double h = element_size(s.plies[p]);
    if (width >= enough * h) continue;
    say(lines,
        "    warning: ply {} has {:.3g} elements across and yarns that bear compression: its "
        "shear forces may come out too high, by 10 % or so with ten; elements of {:.2g} mm "
        "keep that below 5 %",
        ply.name, width / h, width / enough);
  }
}

void describe_limp(const Scene& s, Lines& lines) {
  constexpr double limp = 2e-7; // of the yarns' stiffness: a tenth of what glass weaves have
  std::set<std::pair<int, int>> seen;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const Membrane& m = s.plies[p].membrane;
    const Fabric& f = m.fabric;
    const auto triangles = static_cast<double>(m.triangles.size());
    const double averaged = 2.0 * (triangles - m.groups()) / triangles;
    constexpr double few = 0.05; // along an edge
    const Ply& ply = s.data.plies[p];
    if (f.crossings.empty() || averaged < few || !seen.emplace(ply.fabric, ply.blank).second)
      continue;
    const Fabric& whole = s.data.fabrics[ply.fabric]; // not softened
    double yarns = std::numeric_limits<double>::infinity();
    for (const YarnFamily& family : whole.families)
      yarns = std::min(yarns, family.density * family.tension.largest_slope());
    const double ratio = shear_rigidity(whole) / yarns;
    if (ratio > limp) continue;
    say(lines,
        "    warning: ply {} hardly resists shear, by {:.2g} of its yarns' stiffness, and {:.0f} % "
        "of its triangles are askew to the yarns: over a tip its shear may be off by 2 deg rms and "
        "20 deg at places, or it stops; mesh = \"fibres\" has sides along both families",
        ply.name, ratio, 100.0 * averaged);
  }
}

void describe_wrinkles(const Scene& s, Lines& lines) {
  double force = 0.0; // N, of the tool that is pushed hardest
  for (const Tool& tool : s.data.tools)
    if (tool.motion == Motion::force) force = std::max(force, tool.force);
  std::set<std::pair<int, int>> seen;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const Ply& ply = s.data.plies[p];
    if (!seen.emplace(ply.fabric, ply.blank).second) continue;
    const auto parts = static_cast<double>(parts_of(s.data));
    const double area = area_of(s.plies[p]), h = element_size(s.plies[p]);
    const auto wave = bending_lengths(s.plies[p].membrane.fabric, force / area).upwards;
    if (!wave || *wave >= elements_in_wave * h) continue;
    say(lines,
        "    note: under {:g} N of a tool the yarns of ply {} would wrinkle in waves of "
        "{:.3g} mm, {:.2g} elements: the mesh shows how much length is too much, not the "
        "wrinkles; they would take elements of {:.2g} mm",
        parts * force, ply.name, *wave, *wave / h, *wave / elements_in_wave);
  }
}

} // namespace plyform
