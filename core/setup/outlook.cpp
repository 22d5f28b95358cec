// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/outlook.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/accuracy/error_model.hpp"
#include "core/input/checks/motion_checks.hpp"
#include "core/model/bending_resolution.hpp"
#include "core/model/fabric_estimates.hpp"
#include "core/model/fabric_freedoms.hpp"
#include "core/model/mirror.hpp"
#include "core/model/motion.hpp"
#include "core/run/facet_penetration.hpp"
#include "core/setup/boundaries_ahead.hpp"
#include "core/setup/compaction_ahead.hpp"
#include "core/setup/friction_ahead.hpp"
#include "core/setup/outlook_plies.hpp"
#include "core/setup/size_ahead.hpp"
#include "core/setup/stitch_outlook.hpp"
#include "core/setup/symmetry_ahead.hpp"
#include "core/setup/tool_cuts.hpp"
#include "core/solver/element_mass_scaling.hpp"
#include "core/solver/force_kinds.hpp"
#include "core/solver/stable_time_step.hpp"
#include "core/solver/step.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string>

namespace plyform {
namespace {

/// What the outlines were read from, and what of them is too small for the mesh.
void describe_outlines(const Case& data, Lines& lines) {
  for (const BlankSpec& blank : data.blanks) {
    if (!blank.drawing.empty()) say(lines, "outline from {}", blank.drawing);
    if (!takes_elements(blank)) continue;
    const std::size_t merged = merged_corners(blank.outline, blank.element_size);
    if (merged > 0)
      say(lines,
          "outline: {} {} within {:.2g} mm of the corner before, a fiftieth of an "
          "element, {} left out",
          merged, merged == 1 ? "corner" : "corners", 0.02 * blank.element_size,
          merged == 1 ? "is" : "are");
  }
}

/// What fabrics leave free or lock, and values that were estimated or limited.
void describe_fabrics(const Case& data, Lines& lines) {
  for (const auto& told :
       {describe_freedoms(data), assumptions(data), describe_crimp(data), describe_stitches(data)})
    for (const std::string& line : told)
      say(lines, "fabric {}", line);
}

/// Tells how deep facets may cut into a tool between nodes, if by more than half the ply's
/// thickness, for the ply with the deepest cut. Over an edge, or with elements that are larger than
/// what is round, that is a warning: the ply's shape is then another one. Else it is flattened
/// there, and hardly anything is changed elsewhere: a note.
void describe_cut(const Scene& s, std::size_t tool, Lines& lines) {
  constexpr double round = 0.5; // of the radius
  std::optional<CutAhead> worst;
  const PlyBody* cut_ply = nullptr;
  std::set<std::pair<double, int>> seen;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    if (!seen.emplace(s.plies[p].thickness, s.data.plies[p].blank).second) continue;
    const std::optional<CutAhead> cut = cut_ahead(s, tool, p);
    if (!cut || cut->depth <= 0.5 * s.plies[p].thickness) continue;
    if (!worst || cut->depth > worst->depth) worst = cut, cut_ply = &s.plies[p];
  }
  if (!worst) return;
  const bool sharp = worst->radius <= 0.0;
  // measured by the depth; the tool's own where it is about that
  const Tool& t = s.data.tools[tool];
  if (const double own = radius_near(t.shape, t.rotation.transpose() * (worst->where - t.position));
      !sharp && (std::abs(worst->radius - own) < 0.5 * own ||
                 (std::holds_alternative<MeshShapePtr>(t.shape) && std::isfinite(own))))
    worst->radius = own;
  const bool warns = sharp || worst->depth > round * worst->radius;
  say(lines,
      "    {}: tool {}, {} at ({:.3g}, {:.3g}, {:.3g}): triangles that pass there have sides up to "
      "{:.3g} mm and "
      "touch at nodes only, so that ply {} drawn over it may be cut {:.2g} mm deep between them{}; "
      "sides up to {:.2g} mm keep that below half its thickness",
      warns ? "warning" : "note", s.tools[tool].name,
      sharp ? std::string("sharp edge") : fmt::format("radius {:.3g} mm", worst->radius),
      worst->where.x(), worst->where.y(), worst->where.z(), worst->side, cut_ply->name,
      worst->depth, warns ? ", and that forces over it, of friction above all, are the mesh's" : "",
      worst->good_side);
}

/// "340 x 340 x 5 mm from (-170, -170, -5) to (170, 170, 0)"
std::string extents_text(const Box3& box) {
  const Vec3 size = box.sizes();
  const auto point = [](const Vec3& p) {
    return fmt::format("({:.3g}, {:.3g}, {:.3g})", p.x(), p.y(), p.z());
  };
  return fmt::format("{:.3g} x {:.3g} x {:.3g} mm, from {} to {}", size.x(), size.y(), size.z(),
                     point(box.min()), point(box.max()));
}

/// Depth, mm, at which contact is that much stiffer than at first touch.
double depth_of_stiffness(const ContactLaw& law, double ratio) {
  double low = 0.0, high = law.packed() + 0.999 * law.max_depth;
  for (int i = 0; i < 40; ++i) {
    const double depth = 0.5 * (low + high);
    (law.tangent(depth) < ratio * law.stiffness ? low : high) = depth;
  }
  return low;
}

/// Warns of a force that drives contact, where the tool first lies on a ply, so deep that it is
/// much stiffer than the elements (contact/forces/contact_law.hpp): steps shrink with it, and where
/// a few nodes bear more than the mean the run ends as squeezed.
void describe_pressure(const Scene& s, std::size_t tool, const ToolWay& way, Lines& lines) {
  constexpr double stiff = 25.0; // times the first touch: 2.5 times the stiffest element
  const Tool& t = s.data.tools[tool];
  const PlyBody& ply = s.plies[way.first];
  if (t.motion != Motion::force || t.force == 0.0) return;
  double area = 0.0;
  SurfaceHint hint;
  for (std::size_t n = 0; n < ply.x0.size(); ++n)
    if (tool_distance(t, way.travel * t.direction, ply.x0[n], hint) < 1.5 * ply.thickness)
      area += ply.membrane.node_area[n];
  const ContactLaw& law = s.tools[tool].contacts[way.first].law;
  const double most = area * law.pressure(depth_of_stiffness(law, stiff));
  if (area == 0.0 || t.force <= most) return;
  say(lines,
      "    warning: {:g} N on {:.3g} mm2 of ply {} are more than contact bears without getting "
      "much stiffer than the elements, {:.2g} N: the steps shrink, and the run may stop as "
      "squeezed, "
      "which no stroke or speed avoids; less force, or a larger contact.stiffness",
      t.force, area, ply.name, most);
}

/// Where a tool stands and what it meets first.
void describe_way(const Scene& s, std::size_t tool, const std::vector<FlatPly>& plies, double reach,
                  Lines& lines) {
  const Tool& t = s.data.tools[tool];
  const ToolWay way = way_of(t, tool_surface(t, element_size(s.plies[0]), reach), plies);
  const std::string& closest = s.plies[way.closest].name;
  std::string text = way.gap < 0.005 ? fmt::format("touches ply {}", closest)
                                     : fmt::format("{:.3g} mm from ply {}", way.gap, closest);
  if (t.motion != Motion::fixed && way.gap >= 0.005 && std::isfinite(way.travel))
    text += fmt::format(", first contact with ply {} after {:.4g} mm", s.plies[way.first].name,
                        way.travel);
  if (bounded_tool(t)) text += "; " + extents_text(way.extents);
  lines.push_back("    " + text);
  if (std::isfinite(way.travel)) describe_pressure(s, tool, way, lines);
}

/// parts: of the whole that is shown.
std::string motion_text(const Tool& t, std::size_t parts) {
  if (t.motion == Motion::fixed) return "fixed";
  const bool driven = t.motion == Motion::driven;
  std::string text = driven ? fmt::format("driven {:g} mm", t.stroke)
                            : fmt::format("pushed by {:g} N", static_cast<double>(parts) * t.force);
  if (!t.programme.empty())
    text += fmt::format(" at most, in {} {}", t.programme.size(),
                        t.programme.size() == 1 ? "stage" : "stages");
  return text;
}

void describe_tools(const Scene& s, const std::vector<BlankMesh>& meshes, bool mesh_to_come,
                    Lines& lines) {
  std::vector<FlatPly> plies;
  double reach = 0.0;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    plies.push_back(make_flat_ply(meshes[p], s.data.plies[p].z, s.plies[p].thickness));
    for (const Vec3& x : s.plies[p].x0)
      reach = std::max(reach, x.norm());
  }
  for (std::size_t i = 0; i < s.tools.size(); ++i) {
    const ToolState& t = s.tools[i];
    const double radius = smallest_radius(t.body.shape);
    say(lines, "tool {}: {}{}", t.name, motion_text(s.data.tools[i], parts_of(s.data)),
        std::isfinite(radius) ? fmt::format(", smallest radius {:.4g} mm", radius) : std::string());
    describe_way(s, i, plies, reach + s.data.tools[i].position.norm(), lines);
    if (!mesh_to_come) describe_cut(s, i, lines);
  }
}

/// Steps of a run over those of the step at its start: steps get shorter as cloth is sheared, as
/// plies press each other, and where tools come so fast that a step may not let contact close.
/// Fitted to drafts of the shipped cases (docs/users/accuracy.md, what check foresees).
double steps_over_first(const Scene& s) {
  constexpr double sheared = 1.05, each_ply = 0.06, closing = 1.5;
  const Strokes strokes = longest_strokes(s.data);
  const double speed =
      strokes.tool > 0.0 ? peak_speed_ratio * strokes.at_full_speed / s.data.solver.duration : 0.0;
  double thinnest = std::numeric_limits<double>::max();
  for (const PlyBody& ply : s.plies)
    thinnest = std::min(thinnest, ply.thickness);
  const double way = speed * s.next_dt / (0.5 * thinnest); // a step's, over the contact distance
  return sheared + each_ply * static_cast<double>(s.plies.size() - 1) +
         closing * std::min(way, 1.0);
}

std::string memory_text(const Scene& s) {
  double triangles = 0.0;
  for (const PlyBody& ply : s.plies)
    triangles += static_cast<double>(ply.membrane.triangles.size());
  return fmt::format("{:.0f} triangles, about {:.0f} MB of memory", triangles,
                     std::ceil(bytes_for(s.data, triangles) / 1e6));
}

/// Measures the wall time of a step, s, over a few steps, fewer of a large scene: their mean
/// without the slowest tenth, in which another program has the processor or all is done for the
/// first time. Returns a Stop if the simulation fails.
std::optional<Stop> time_a_step(Scene& s, ThreadPool& pool, const OutlookProgress& progress,
                                double& seconds) {
  using Clock = std::chrono::steady_clock;
  constexpr int most = 60, least = 5;
  constexpr double long_enough = 0.2; // s, of them all
  std::vector<double> times;
  double sum = 0.0;
  for (int i = 0; i < most && (i < least || sum < long_enough); ++i) {
    if (progress) progress("times some steps", 0.5 + 0.5 * i / most);
    const auto begin = Clock::now();
    if (auto stop = compute_forces(s, pool)) return stop;
    move_plies(s, pool);
    times.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    sum += times.back();
  }
  std::sort(times.begin(), times.end());
  const auto kept =
      static_cast<std::ptrdiff_t>(times.size() - std::max(times.size() / 10, std::size_t{1}));
  seconds = std::accumulate(times.begin(), times.begin() + kept, 0.0) / static_cast<double>(kept);
  return std::nullopt;
}

/// Of a case so large that its scene alone would take longer than a check should: what it takes.
std::optional<Outlook> only_size(const PreparedCase& prepared, int threads) {
  constexpr double most_triangles = 1e6; // some twenty seconds
  double triangles = 0.0;
  for (const BlankMesh& mesh : prepared.meshes)
    triangles += static_cast<double>(mesh.triangles.size());
  if (triangles <= most_triangles) return std::nullopt;
  const SizeAhead size = size_of_meshes(*prepared.value, prepared.meshes, threads);
  Outlook outlook;
  outlook.steps = size.steps;
  outlook.seconds = size.seconds;
  outlook.lines.push_back(prepared.value->title);
  describe_fabrics(*prepared.value, outlook.lines);
  describe_outlines(*prepared.value, outlook.lines);
  outlook.lines.insert(outlook.lines.end(), prepared.notes.begin(), prepared.notes.end());
  say(outlook.lines,
      "    warning: {:.0f} triangles, about {:.2g} GB of memory{}: no step of so many was tried, "
      "and "
      "nothing is said of how plies and tools meet; larger elements would tell",
      triangles, size.bytes / 1e9,
      size.seconds > 0.0 ? fmt::format(" and {:.2g} s", size.seconds) : std::string());
  return outlook;
}

} // namespace

Outlook look_ahead(const PreparedCase& prepared, int threads, const OutlookProgress& progress,
                   bool mesh_to_come) {
  const auto tell = [&](const char* words, double fraction) {
    if (progress) progress(words, fraction);
  };
  const Case& data = *prepared.value;
  if (std::optional<Outlook> size = only_size(prepared, threads)) return *size;
  ThreadPool pool(threads);
  tell("makes the scene", 0.0);
  Scene s = make_scene(data, prepared.meshes);
  tell("looks for contact", 0.1);
  start(s, pool);
  tell("looks at plies", 0.2);
  Outlook outlook;
  Lines& lines = outlook.lines;
  lines.push_back(data.title);
  describe_fabrics(s.data, lines);
  describe_outlines(data, lines);
  describe_plies(s, lines);
  describe_locking(s, lines);
  describe_limp(s, lines);
  describe_wrinkles(s, lines);
  tell("looks at tools", 0.3);
  describe_tools(s, prepared.meshes, mesh_to_come, lines);
  describe_compaction(s, pool, lines);
  tell("looks at boundaries and steps", 0.45);
  for (std::string& line : boundaries_ahead(s))
    lines.push_back(std::move(line));
  for (std::string& line : symmetry_ahead(data, prepared.meshes))
    lines.push_back(std::move(line));
  for (std::string& line : friction_ahead(data))
    lines.push_back(std::move(line));
  each_kind(s, [&](const auto& kind) { kind.describe(s, lines); });
  const StepBound bound = stable_step(s, contact_rows(s, pool));
  outlook.stable_step = bound.dt;
  outlook.step = s.next_dt;
  outlook.steps = steps_over_first(s) * data.solver.duration / s.next_dt; // without a dwell
  say(lines, "contact: {} directed ply pairs searched, tools against every ply; skin {:g} mm",
      s.pass_order.size(), s.skin);
  say(lines, "stable step {:.3g} s, set by ply {}, triangle {}; used {:.3g} s", bound.dt,
      s.plies[bound.ply].name, bound.triangle, s.next_dt);
  if (data.solver.element_mass_scaling > 0.0)
    say(lines, "small elements: {:.2g} % of a ply's mass added at most",
        100.0 * largest_added_element_mass(s));
  const PredictedError error = predicted_error(data, effective_mass_factor(s));
  lines.push_back(
      describe_accuracy(error, error.promised(data), prepared.coarsening, error.unknown(data)));
  lines.insert(lines.end(), prepared.notes.begin(), prepared.notes.end());
  say(lines, "fibre stiffness divided by {:g}, {:g} s simulated: about {:.0f} steps",
      data.solver.fibre_softening, data.solver.duration, outlook.steps);
  double seconds = 0.0;
  if (const auto stop = time_a_step(s, pool, progress, seconds)) {
    outlook.stop = stop->message;
    return outlook;
  }
  outlook.seconds = outlook.steps * seconds;
  say(lines, "estimated time {:.0f} s; {}", outlook.seconds, memory_text(s));
  return outlook;
}

} // namespace plyform
