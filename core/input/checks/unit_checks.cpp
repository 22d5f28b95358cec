// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/checks/unit_checks.hpp"

#include "base/format.hpp"
#include "core/drawing/dxf_outline.hpp"
#include "core/mesh/mesh_ply.hpp"
#include "core/model/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double no_size = std::numeric_limits<double>::quiet_NaN();

struct Body {
  Vec2 sizes = Vec2::Zero();   ///< mm, seen along z
  Vec2 centre = Vec2::Zero();  ///< mm
  bool file = false;           ///< comes from a file, which has its own unit
  bool reaches_centre = false; ///< lies over or under the middle of the forming
  double whole = 1.0; ///< sizes of the whole over these, of a blank with planes of symmetry
  double size() const { return whole * sizes.maxCoeff(); }
};

/// Sizes of a scene. Bodies are numbered: tools, then blanks.
struct SceneSizes {
  const Case& scene;
  std::vector<Body> bodies{};
  std::vector<int> blanks{};   ///< bodies of blanks that are used
  std::vector<int> driven{};   ///< bodies of tools
  std::vector<int> supports{}; ///< bodies of tools that are not driven
  double reach = 0.0;          ///< mm, twice the way from the blank's middle to the grips
  double opening = no_size;    ///< mm, half of what the punch goes through
  int around = -1;             ///< body with the opening
};

/// A ratio, its usual range, and what it usually is.
struct Ratio {
  double value, least, most, usual;
  bool fits() const { return !(value < least) && !(value > most); }
  double miss2() const {
    const double off = std::log(value / usual);
    return std::isfinite(off) ? off * off : 0.0;
  }
};

Body body_of(const Eigen::AlignedBox2d& box, bool file) {
  Body body;
  if (!box.isEmpty()) body = {box.sizes(), box.center(), file};
  return body;
}

/// The blank of a ply where it lies; an empty box if its mesh cannot be had.
Eigen::AlignedBox2d box_of(const Case& scene, const Ply& ply) {
  Eigen::AlignedBox2d box;
  const BlankSpec& blank = scene.blanks[at(ply.blank)];
  const Eigen::Rotation2Dd turn(ply.rotation);
  for (const Vec2& x : blank.outline.boundary)
    box.extend(Vec2(ply.seed + turn * x));
  if (blank.mesh != MeshKind::file) return box;
  try {
    for (const Vec2& x : mesh_ply(scene, ply).x)
      box.extend(x);
  } catch (const std::runtime_error&) {
    // reported when it is meshed
  }
  return box;
}

/// mm, the least way across from p to a wall of the tool all round, or NaN where there are fewer
/// than two walls.
double way_to_walls(const Tool& tool, const Vec3& p, double reach) {
  constexpr int directions = 8;
  double least = std::numeric_limits<double>::infinity();
  int walls = 0;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / directions;
    const Vec3 way(std::cos(angle), std::sin(angle), 0.0);
    double gone = 0.0;
    SurfaceHint hint;
    for (int step = 0; step < 100 && gone < reach; ++step) {
      const double distance = tool_distance(tool, Vec3::Zero(), p + gone * way, hint);
      if (distance < 1e-3 * (gone + 0.01)) break;
      gone += distance;
    }
    if (gone >= reach) continue;
    ++walls;
    least = std::min(least, gone);
  }
  return walls < 2 || !(least > 0.0) ? no_size : least;
}

/// Finds what the first driven tool goes through, a little beyond the plies.
void measure_opening(SceneSizes& sizes, const Vec2& centre, double bottom, double stack) {
  const Tool& punch = sizes.scene.tools[at(sizes.driven.front())];
  if (std::abs(punch.direction.z()) < 0.5) return;
  const double beyond = 2.0 * stack; // clear of what lies under the plies
  const bool down = punch.direction.z() < 0.0;
  const Vec3 p(centre.x(), centre.y(), down ? bottom - beyond : bottom + stack + beyond);
  for (const int t : sizes.supports) {
    const Body& body = sizes.bodies[at(t)];
    if (sizes.scene.tools[at(t)].motion != Motion::fixed || body.size() == 0.0) continue;
    const double way = way_to_walls(sizes.scene.tools[at(t)], p, body.size());
    if (std::isnan(way) || way >= sizes.opening) continue;
    sizes.opening = way;
    sizes.around = t;
  }
}

void measure_tools(SceneSizes& sizes) {
  const Case& scene = sizes.scene;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const Tool& tool = scene.tools[t];
    const bool bounded = !std::holds_alternative<Plane>(tool.shape);
    Eigen::AlignedBox2d box;
    if (bounded)
      for (const Vec3& x : tool_surface(tool, std::numeric_limits<double>::infinity(), 0.0).x)
        box.extend(Vec2(x.head<2>()));
    sizes.bodies.push_back(body_of(box, std::holds_alternative<MeshShapePtr>(tool.shape)));
    if (!bounded || box.isEmpty()) continue;
    (tool.motion == Motion::driven ? sizes.driven : sizes.supports).push_back(static_cast<int>(t));
  }
}

SceneSizes measure(const Case& scene) {
  SceneSizes sizes{scene};
  measure_tools(sizes);
  std::vector<Eigen::AlignedBox2d> boxes(scene.blanks.size());
  double bottom = std::numeric_limits<double>::infinity(), stack = 0.0;
  for (const Ply& ply : scene.plies) {
    boxes[at(ply.blank)].extend(box_of(scene, ply));
    const double thickness = scene.fabrics[at(ply.fabric)].thickness;
    bottom = std::min(bottom, ply.z - 0.5 * thickness);
    stack += thickness;
  }
  Eigen::AlignedBox2d all;
  const bool part = std::any_of(scene.boundaries.begin(), scene.boundaries.end(),
                                [](const Boundary& b) { return b.is<SymmetryPlane>(); });
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const BlankSpec& blank = scene.blanks[b];
    sizes.bodies.push_back(
        body_of(boxes[b], blank.mesh == MeshKind::file || !blank.drawing.empty()));
    sizes.bodies.back().whole = part ? 2.0 : 1.0;
    if (boxes[b].isEmpty()) continue;
    sizes.blanks.push_back(static_cast<int>(scene.tools.size() + b));
    all.extend(boxes[b]);
  }
  if (all.isEmpty()) return sizes;
  Vec2 centre = all.center();
  if (!sizes.driven.empty()) centre = sizes.bodies[at(sizes.driven.front())].centre;
  for (Body& body : sizes.bodies)
    body.reaches_centre =
        ((body.centre - centre).cwiseAbs() - 0.5 * body.sizes).maxCoeff() < 0.1 * body.size();
  for (const Boundary& b : scene.boundaries) {
    const auto reach = [&](std::span<const Vec2> places) {
      for (const Vec2& x : places)
        sizes.reach = std::max(sizes.reach, 2.0 * (x - all.center()).norm());
    };
    if (const auto* frame = std::get_if<HingedFrame>(&b.kind)) reach(frame->hinges);
    if (const HeldPlace* place = place_of(b)) reach(place->ends);
  }
  if (!sizes.driven.empty()) measure_opening(sizes, centre, bottom, stack);
  return sizes;
}

/// Sizes with one body's multiplied by a factor.
struct Scaled {
  const SceneSizes& sizes;
  int body = -1;
  double factor = 1.0;
  double of(int b) const { return sizes.bodies[at(b)].size() * (b == body ? factor : 1.0); }
  double half(int b) const {
    return 0.5 * sizes.bodies[at(b)].sizes.minCoeff() * (b == body ? factor : 1.0);
  }
};

/// All ratios of a scene. Ranges are those of forming and drape tests with room to both sides: the
/// shipped cases have blanks of 0.4 to 2 supports and punches of 0.3 to 0.5 blanks that fill 0.88
/// to 0.94 of their openings.
std::vector<Ratio> ratios_of(const Scaled& s, bool broken) {
  constexpr double any = std::numeric_limits<double>::infinity();
  const SceneSizes& sizes = s.sizes;
  std::vector<Ratio> ratios;
  double widest = 0.0;
  for (const int t : sizes.supports)
    widest = std::max(widest, s.of(t));
  for (const int b : sizes.blanks) {
    if (widest > 0.0) ratios.push_back({s.of(b) / widest, 0.06, 5.0, 0.7});
    if (sizes.reach > 0.0) ratios.push_back({s.of(b) / sizes.reach, 0.4, broken ? 6.0 : any, 1.0});
    for (const int t : sizes.driven)
      ratios.push_back({s.of(t) / s.of(b), 0.03, 6.0, 0.45});
    for (const int t : sizes.supports)
      if (sizes.bodies[at(t)].reaches_centre) ratios.push_back({s.of(t) / s.of(b), 0.1, any, 1.5});
  }
  if (std::isnan(sizes.opening)) return ratios;
  const double opening = sizes.opening * (sizes.around == s.body ? s.factor : 1.0);
  ratios.push_back({s.half(sizes.driven.front()) / opening, 0.12, broken ? 3.0 : any, 0.93});
  return ratios;
}

bool all_fit(const std::vector<Ratio>& ratios) {
  return std::all_of(ratios.begin(), ratios.end(), [](const Ratio& r) { return r.fits(); });
}

double cost_of(const std::vector<Ratio>& ratios) {
  double cost = 0.0;
  for (const Ratio& ratio : ratios)
    cost += ratio.miss2();
  return cost;
}

struct Candidate {
  int body = -1;
  double factor = 1.0, cost = 0.0;
};

Candidate best_candidate(const SceneSizes& sizes, bool broken) {
  constexpr double rare = 0.7, no_file = 3.0; // costs: of centimetres, of numbers in the case file
  constexpr double least_gain = 2.0; // of cost: a ratio that is off by a factor of 4 comes right
  Candidate best;
  best.cost = cost_of(ratios_of({sizes}, broken)) - least_gain;
  for (std::size_t b = 0; b < sizes.bodies.size(); ++b)
    for (const double unit : {25.4, 10.0, 1000.0})
      for (const double factor : {unit, 1.0 / unit}) {
        const std::vector<Ratio> ratios = ratios_of({sizes, static_cast<int>(b), factor}, broken);
        if (sizes.bodies[b].size() == 0.0 || !all_fit(ratios)) continue;
        const double cost =
            cost_of(ratios) + (unit == 10.0 ? rare : 0.0) + (sizes.bodies[b].file ? 0.0 : no_file);
        if (cost < best.cost) best = {static_cast<int>(b), factor, cost};
      }
  return best;
}

const char* reason(double factor) {
  if (factor == 25.4) return "as if in inches";
  if (factor == 10.0) return "as if in centimetres";
  if (factor == 1000.0) return "as if in metres";
  return factor > 1.0 / 11.0   ? "as mm that were taken for centimetres"
         : factor > 1.0 / 26.0 ? "as mm that were taken for inches"
                               : "as mm that were taken for metres";
}

std::string remedy_of(const SourceLocation& at, const Body& body, double scale, bool has_scale,
                      double factor) {
  if (!body.file)
    return fmt::format("give all its lengths in mm: {:.4g} times those that it has", factor);
  if (!has_scale) return fmt::format("write its file in mm, {:.4g} times as large", factor);
  if (at.scale_given)
    return fmt::format("set scale = {:.5g} in place of {:g}, if that is so", scale * factor, scale);
  return fmt::format("set scale = {:.5g}, the mm per unit of its file; or scale = {:g} if it is "
                     "right as it is",
                     scale * factor, scale);
}

} // namespace

std::optional<UnitSuspicion> suspect_unit(const Case& scene, const CaseParts& parts, bool broken) {
  const SceneSizes sizes = measure(scene);
  if (sizes.blanks.empty() || all_fit(ratios_of({sizes}, broken))) return std::nullopt;
  const auto [number, factor, cost] = best_candidate(sizes, broken);
  if (number < 0) return std::nullopt;
  const auto index = static_cast<std::size_t>(number);
  const bool tool = index < scene.tools.size();
  const Body& body = sizes.bodies[index];
  const SourceLocation& at = tool ? parts.tools[index] : parts.blanks[index - scene.tools.size()];
  std::string others;
  for (const int b : sizes.blanks)
    if (tool && others.empty())
      others = fmt::format("plies of {:.4g} x {:.4g} mm", sizes.bodies[plyform::at(b)].sizes.x(),
                           sizes.bodies[plyform::at(b)].sizes.y());
  for (const int t : tool                     ? std::vector<int>{}
                     : sizes.supports.empty() ? sizes.driven
                                              : sizes.supports)
    if (others.empty() || sizes.bodies[plyform::at(t)].size() > 0.0)
      others = fmt::format("tool {} of {:.4g} x {:.4g} mm", scene.tools[plyform::at(t)].name,
                           sizes.bodies[plyform::at(t)].sizes.x(),
                           sizes.bodies[plyform::at(t)].sizes.y());
  if (others.empty()) others = "what holds it";
  UnitSuspicion found{at, tool ? scene.tools[index].name : "", "", ""};
  found.rule = fmt::format("is {:.4g} x {:.4g} mm in plan beside {}; {:.4g} times as large, {}, it "
                           "would be {:.4g} x {:.4g} mm and fit all others",
                           body.sizes.x(), body.sizes.y(), others, factor, reason(factor),
                           factor * body.sizes.x(), factor * body.sizes.y());
  const BlankSpec* blank = tool ? nullptr : &scene.blanks[index - scene.tools.size()];
  const bool drawn = blank && !blank->drawing.empty();
  const double scale = at.scale_given || !drawn ? at.scale : unit_named_in(blank->drawing);
  found.remedy = remedy_of(at, body, scale, tool || drawn, factor);
  found.is_drawing = drawn && !at.scale_given;
  found.from_file = body.file;
  return found;
}

} // namespace plyform
