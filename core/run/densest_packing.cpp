// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/densest_packing.hpp"

#include "base/format.hpp"
#include "base/node_normals.hpp"
#include "core/model/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace plyform {
namespace {

constexpr double last_digit = 1e-3; // of V_d, that a column has

/// (1).
double densest_of(const Fabric& fabric) {
  const double circles = std::numbers::pi / (2.0 * std::sqrt(3.0));
  const auto& c = fabric.compaction;
  if (!c) return circles;
  const double fibres = fabric.surface_density / *fabric.fibre_density;
  return std::min(circles, fibres / std::max(c->densest() - c->nesting, 1e-3 * c->densest()));
}

/// r of a triangle; 1 of plies that are as thick as before.
double ratio_of(const PlyBody& ply, std::size_t e) {
  if (ply.thickness_ratio.empty()) return 1.0;
  double ratio = 0.0;
  for (const std::int32_t n : ply.membrane.triangles[e])
    ratio += ply.thickness_ratio[at(n)] / 3.0;
  return ratio;
}

/// V of a triangle and V_d, of the ply or of the stack there, whichever is further beyond.
struct Packing {
  double volume = 0.0, densest = 0.0;
};

Packing packing_of(const PlyFrame& frame, std::size_t e, double densest, double of_stack) {
  const Packing ply{frame.fibre_volume[e], densest};
  if (frame.mould.fibre_volume.empty()) return ply;
  const Packing stack{frame.mould.fibre_volume[e], of_stack};
  return stack.volume * ply.densest > ply.volume * stack.densest ? stack : ply;
}

/// What is beyond in one frame. of_stack: the largest V_d of all plies.
Overpacked beyond_in(const PlyBody& ply, const PlyFrame& frame, double of_stack) {
  Overpacked found;
  const double densest = densest_of(ply.membrane.fabric);
  double beyond = 0.0, all = 0.0;
  for (std::size_t e = 0; e < frame.fibre_volume.size(); ++e) {
    const Packing now = packing_of(frame, e, densest, of_stack);
    const double before = ply.membrane.area[e];
    all += before;
    if (!(now.volume > (1.0 + last_digit) * now.densest)) continue;
    beyond += before;
    if (!(now.volume > found.fibre_volume)) continue;
    const Triangle& t = frame.triangles[e];
    found.fibre_volume = now.volume, found.densest = now.densest;
    found.at = (frame.x[at(t[0])] + frame.x[at(t[1])] + frame.x[at(t[2])]) / 3.0;
    const double flat = triangle_area(frame.x, t) / before;
    found.crushed = now.volume * flat * ratio_of(ply, e) < now.densest ? flat : 0.0;
  }
  found.share = all > 0.0 ? beyond / all : 0.0;
  return found;
}

/// (3) of a ply; 0 where nothing presses it, or its yarns have waves to give, or are of one family.
double outgrown(const PlyBody& ply, const PlyFrame& frame) {
  constexpr double pressed = 0.99; // of the thickness with nothing on it
  const Membrane& m = ply.membrane;
  if (!m.fabric.compaction || m.crossings.empty() || m.crossings[0].crimp) return 0.0;
  const std::vector<double>&first = frame.families[m.crossings[0].first].strain,
        &second = frame.families[m.crossings[0].second].strain;
  double grown = 0.0, all = 0.0;
  for (std::size_t e = 0; e < frame.fibre_volume.size(); ++e) {
    if (frame.thickness[e] > pressed * ratio_of(ply, e) * ply.thickness) continue;
    all += m.area[e];
    grown += m.area[e] * ((1.0 + first[e]) * (1.0 + second[e]) - 1.0);
  }
  return all > 0.0 ? grown / all : 0.0;
}

std::string place(const Vec3& at) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", at.x(), at.y(), at.z());
}

std::string doubt_of_beyond(const Scene& s, const std::string& name, const Overpacked& ply) {
  const std::string when = whole_stroke(s.data) != 0.0 ? fmt::format("{:.4g} mm", ply.stroke_mm)
                                                       : fmt::format("{:.4g} s", ply.time_s);
  const std::string cause =
      ply.crushed > 0.0
          ? fmt::format(
                "its triangles are crushed in their plane, there to {:.2g} % of their area: "
                "a finer mesh, or less that pushes the ply together, avoids it",
                100.0 * ply.crushed)
          : std::string("it is pressed beyond what its compaction says: leave it more room, or "
                        "press with less force");
  return fmt::format(
      "do not trust the fibre volume and thickness of {}: {:.1f} % at {} after {} is "
      "beyond its densest packing of {:.1f} %, as {:.3g} % of its area was then; {}",
      name, 100.0 * ply.fibre_volume, place(ply.at), when, 100.0 * ply.densest, 100.0 * ply.share,
      cause);
}

} // namespace

bool finite_of_each(const std::vector<Overpacked>& found, std::size_t plies) {
  return (found.empty() || found.size() == plies) &&
         std::all_of(found.begin(), found.end(), [](const Overpacked& ply) {
           return std::isfinite(ply.fibre_volume + ply.densest + ply.share + ply.stroke_mm +
                                ply.time_s + ply.crushed) &&
                  ply.at.allFinite();
         });
}

void follow_packing(const Scene& s, const Frame& frame, std::vector<Overpacked>& plies) {
  plies.resize(s.plies.size());
  double of_stack = 0.0;
  for (const PlyBody& ply : s.plies)
    if (ply.membrane.fabric.fibre_density)
      of_stack = std::max(of_stack, densest_of(ply.membrane.fabric));
  for (std::size_t p = 0; p < plies.size(); ++p) {
    if (frame.plies[p].fibre_volume.empty()) continue;
    Overpacked now = beyond_in(s.plies[p], frame.plies[p], of_stack);
    if (!(now.fibre_volume > plies[p].fibre_volume)) continue;
    now.stroke_mm = frame.stroke_mm, now.time_s = frame.time;
    plies[p] = now;
  }
}

std::vector<std::string> doubts_of_packing(const Scene& s, const Frame& last,
                                           const std::vector<Overpacked>& plies) {
  std::vector<std::string> found;
  for (std::size_t p = 0; p < plies.size(); ++p)
    if (plies[p].fibre_volume > 0.0) found.push_back(doubt_of_beyond(s, s.plies[p].name, plies[p]));
  for (std::size_t p = 0; p < last.plies.size(); ++p) {
    if (last.plies[p].fibre_volume.empty()) continue;
    const double grown = outgrown(s.plies[p], last.plies[p]);
    if (!(std::abs(grown) > doubtful_volume_balance)) continue;
    found.push_back(fmt::format(
        "do not trust the fibre volume and thickness of {}: its volume balance is off by {:.2g} %, "
        "as its yarns are {} where it is pressed, and yarns of cloth keep their length; a "
        "smaller solver.fibre_softening or more room in the mould makes it less",
        s.plies[p].name, 100.0 * std::abs(grown), grown > 0.0 ? "stretched" : "shortened"));
  }
  return found;
}

} // namespace plyform
