// SPDX-License-Identifier: GPL-3.0-or-later
// summary.json: the main numbers of each ply and tool, for sweeps and reports. Keys are written in
// the order in which they appear here and in figures.hpp; docs/users/results.md describes them.
#include "core/results/figures.hpp"
#include "core/results/pair_json.hpp"
#include "core/results/result_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plyform {

namespace {

template <class Item>
Json list_of(const std::vector<Item>& items, Json (*object)(const Item&)) {
  Json list = Json::array();
  for (const Item& item : items)
    list.push_back(object(item));
  return list;
}

/// A position, mm.
Json place(const Vec3& x) {
  return Json::array({rounded(x.x()), rounded(x.y()), rounded(x.z())});
}

// Plies.

Json four_numbers(const std::array<double, 4>& values) {
  return Json::array(
      {rounded(values[0]), rounded(values[1]), rounded(values[2]), rounded(values[3])});
}

/// Four walks of core/results/draw_in.hpp.
Json four_walks(std::array<double, 4> directions, const std::array<double, 4>& each) {
  double mean = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    mean += each[k] / 4.0;
    directions[k] -= 360.0 * std::floor(directions[k] / 360.0);
  }
  const auto [least, most] = std::minmax_element(each.begin(), each.end());
  return {{"mean", rounded(mean)},
          {"spread", rounded(*most - *least)},
          {"directions_deg", four_numbers(directions)},
          {"each", four_numbers(each)}};
}

/// Beside the figures.
Json draw_in_keys(const DrawIn& d) {
  if (!d.unknown.empty()) return {{"no_draw_in", d.unknown}};
  return {{"draw_in_yarns_mm", four_walks(d.yarns_deg, d.yarns)},
          {"draw_in_bisectors_mm", four_walks(d.bisectors_deg, d.bisectors)}};
}

Json opening_object(const Opening& opening) {
  Json object{{"family", opening.family},
              {"largest", rounded(opening.largest)},
              {"at_mm", place(opening.at)}};
  if (opening.limit)
    object.update({{"limit", rounded(*opening.limit)},
                   {"area_mm2_beyond_limit", rounded(opening.beyond_mm2)},
                   {"area_share_beyond_limit", rounded(opening.beyond_share)}});
  return object;
}

Json stitch_keys(const std::vector<BrokenStitches>& stitches) {
  Json list = Json::array();
  for (const BrokenStitches& s : stitches) {
    Json one{{"name", s.name},
             {"broken_length_share", rounded(s.share)},
             {"broken_area_mm2", rounded(s.area)}};
    if (s.area > 0.0)
      one.update({{"largest_broken_patch_mm2", rounded(s.patch_area)},
                  {"largest_broken_patch_at_mm", place(s.patch_at)}});
    list.push_back(one);
  }
  return {{"stitches", list}};
}

/// What a name leads to: its last part, within the parts before.
Json& at_path(Json& object, std::string_view name) {
  Json* at = &object;
  for (std::size_t dot; (dot = name.find('.')) != name.npos; name.remove_prefix(dot + 1))
    at = &(*at)[std::string(name.substr(0, dot))];
  return (*at)[std::string(name)];
}

using Figures = std::vector<FigureValue>; // of a ply

Json figures_object(const PlyFrame& ply, const Figures& figures) {
  Json object{{"name", ply.name}, {"angle_deg", rounded(ply.angle_deg)}};
  for (const FigureValue& one : figures) {
    const double* number = std::get_if<double>(&one.value);
    at_path(object, one.figure.name) =
        number ? Json(rounded(*number)) : place(std::get<Vec3>(one.value));
  }
  return object;
}

/// Of what is no figure.
Json report_keys(const PlyReport& report) {
  Json keys = draw_in_keys(report.draw_in);
  if (report.bridging && !report.bridging->family.empty())
    keys["bridging_family"] = report.bridging->family;
  if (!report.openings.empty()) keys["openings"] = list_of(report.openings, opening_object);
  if (!report.stitches.empty()) keys.update(stitch_keys(report.stitches));
  return keys;
}

/// `reports`: one per ply, or empty if only the fields are known.
std::vector<Figures> figures_of(const std::vector<PlyFrame>& plies,
                                const std::vector<PlyReport>& reports) {
  std::vector<Figures> all;
  for (std::size_t i = 0; i < plies.size(); ++i)
    all.push_back(figures_of(plies[i], reports.empty() ? nullptr : &reports.at(i)));
  return all;
}

/// `figures`: those of each ply.
Json plies_list(const std::vector<PlyFrame>& plies, const std::vector<Figures>& figures,
                const std::vector<PlyReport>& reports) {
  Json list = Json::array();
  for (std::size_t i = 0; i < plies.size(); ++i) {
    list.push_back(figures_object(plies[i], figures[i]));
    if (!reports.empty()) list.back().update(report_keys(reports[i]));
  }
  return list;
}

Json description_object(const Figure& figure) {
  Json object{{"label", figure.label}, {"unit", figure.unit}, {"digits", figure.digits}};
  if (!figure.note.empty()) object["note"] = figure.note;
  if (!figure.verified.empty()) object["verified"] = figure.verified;
  object["compared"] = figure.compared;
  return object;
}

/// What the figures are that the plies have, and those of the run.
Json descriptions(const std::vector<Figures>& figures) {
  Json of_plies = Json::object(), of_run = Json::object();
  for (const Figures& of_ply : figures)
    for (const FigureValue& one : of_ply)
      if (std::holds_alternative<double>(one.value))
        of_plies[one.figure.name] = description_object(one.figure);
  for (const Figure& figure : figures_of_runs())
    of_run[figure.name] = description_object(figure);
  return {{"plies", of_plies}, {"run", of_run}};
}

// Tools, boundaries, pairs.

Json tool_object(const ToolFrame& tool) {
  return {{"name", tool.name},
          {"force_N", rounded(tool.force_N)},
          {"force_raw_N", rounded(tool.force_raw_N)},
          {"displacement_mm", rounded(tool.stroke_mm)}};
}

/// The tools, with what is known of their forces and of how they came to rest.
Json tools_list(const std::vector<ToolFrame>& tools, const std::vector<KnownForce>& known,
                const std::vector<PushedTool>& pushed) {
  Json list = list_of(tools, tool_object);
  for (Json& tool : list)
    for (const PushedTool& one : pushed)
      if (tool["name"] == one.name)
        tool.update({{"speed_mm_s", rounded(one.speed_mm_s)}, {"at_rest", one.at_rest}});
  for (std::size_t t = 0; t < std::min(known.size(), list.size()); ++t) {
    list[t]["force_known"] = known[t].to_end();
    if (known[t].to_end()) continue;
    list[t]["force_known_to_mm"] = rounded(known[t].stroke_mm);
    list[t]["force_known_to_s"] = rounded(known[t].time_s);
  }
  return list;
}

Json boundary_object(const BoundaryFrame& boundary) {
  return {{"name", boundary.name},
          {"force_N", rounded(boundary.force_N)},
          {"displacement_mm", rounded(boundary.stroke_mm)}};
}

// The run as a whole.

Json energy_object(const Energies& e) {
  Json energy;
  for (const EnergyTerm& term : energy_terms)
    energy[term.name] = rounded(e.*term.value);
  energy["balance_error"] = rounded(e.balance_error());
  return energy;
}

Json accuracy_object(const AccuracyReport& a) {
  Json object = {{"promised_shear_error_deg", rounded(a.promised_deg)},
                 {"inertia_deg", rounded(a.inertia_deg)},
                 {"softening_deg", rounded(a.softening_deg)},
                 {"mesh_deg", rounded(a.mesh_deg)},
                 {"element_size_factor", rounded(a.coarsening)}};
  if (!a.unknown.empty()) object["unknown"] = a.unknown;
  return object;
}

/// null of what was not measured.
Json part(const ErrorPart& value) {
  return value ? Json(rounded(*value)) : Json(nullptr);
}

Json figure_object(const VerifiedFigure& f) {
  Json object = {{"name", f.name},
                 {"unit", f.unit},
                 {"value", rounded(f.value)},
                 {"band", part(f.band)},
                 {"mesh", part(f.mesh)},
                 {"inertia", part(f.inertia)},
                 {"softening", part(f.softening)},
                 {"chance", part(f.chance)}};
  if (!f.no_band.empty()) object["no_band"] = f.no_band;
  if (const std::vector<std::string> missing = unmeasured(f); !missing.empty())
    object["unmeasured"] = missing;
  return object;
}

Json parting_object(const Parting& p) {
  return {{"ply", p.ply},
          {"time_s", rounded(p.time_s)},
          {"stroke_mm", rounded(p.stroke_mm)},
          {"at_mm", place(p.at_mm)},
          {"apart_mm", rounded(p.apart_mm)},
          {"shear_deg", rounded(p.shear_deg)}};
}

Json asked_object(const AskedAccuracy& a) {
  Json object = {{"wanted_shear_deg", rounded(a.wanted_deg)},
                 {"measured_shear_deg", rounded(a.measured_deg)},
                 {"outcome", a.kept()      ? "kept"
                             : a.corrected ? "corrected"
                                           : "missed"}};
  if (a.kept()) return object;
  if (!a.corrected) {
    object["why_not_corrected"] = a.why_not;
    return object;
  }
  object.update({{"element_size_factor", rounded(a.element_size)},
                 {"duration_factor", rounded(a.duration)},
                 {"fibre_softening_factor", rounded(a.softening)},
                 {"corrected_shear_deg", rounded(a.expected_deg)},
                 {"moved_shear_deg", rounded(a.moved_deg)},
                 {"first_run", a.first_run}});
  return object;
}

Json whole_object(const WholeRun& w) {
  return {{"moved_mm", rounded(w.moved_mm)},
          {"shear_deg", rounded(w.shear_deg)},
          {"ply", w.ply},
          {"wrinkle_mm", rounded(w.wrinkle_mm)},
          {"shown_wrinkle_mm", rounded(w.shown_wrinkle_mm)},
          {"breaks_symmetry", w.breaks}};
}

Json verification_object(const Verification& v) {
  Json object = {{"cost", rounded(v.cost)},
                 {"work", rounded(v.work)},
                 {"figures", list_of(v.figures, figure_object)},
                 {"shear_of_all_plies", figure_object(v.shear)}};
  if (v.asked) object["asked"] = asked_object(*v.asked);
  if (v.whole) object["whole"] = whole_object(*v.whole);
  object["left_out"] = v.left_out;
  object["partings"] = list_of(v.partings, parting_object);
  return object;
}

/// Keys that are given twice cannot be: the case would have been refused.
Json case_object(const Summary& summary) {
  Json object = Json::object();
  for (const auto& [key, value] : summary.given)
    object[key] = value;
  return object;
}

Json contact_object(const ContactReport& c) {
  return {
      {"max_tool_penetration_mm", rounded(c.max_tool_penetration_mm)},
      {"max_tool_penetration_between_nodes_mm", rounded(c.max_tool_penetration_between_nodes_mm)},
      {"max_ply_penetration_mm", rounded(c.max_ply_penetration_mm)},
      {"intersections_between_plies", c.intersections_between_plies},
      {"intersections_within_plies", c.intersections_within_plies}};
}

Json time_step_object(const Summary& summary) {
  return {{"min", rounded(summary.min_step_s)}, {"max", rounded(summary.max_step_s)}};
}

Json time_shares_object(const WorkReport& w) {
  return {{"elements", rounded_share(w.elements_share)},
          {"contact", rounded_share(w.contact_share)},
          {"search", rounded_share(w.search_share)}};
}

} // namespace

std::string summary_json(const Frame& last, const Summary& summary) {
  std::size_t elements = 0, nodes = 0;
  for (const PlyFrame& ply : last.plies) {
    elements += ply.triangles.size();
    nodes += ply.x0.size();
  }
  const std::vector<Figures> figures = figures_of(last.plies, summary.plies);
  Json all = {{"title", summary.title},
              {"version", summary.version},
              {"status", summary.status},
              {"message", summary.message},
              {"time_s", rounded(last.time)},
              {"stroke_mm", rounded(last.stroke_mm)},
              {"wall_time_s", rounded(summary.wall_time_s)},
              {"steps", summary.steps},
              {"time_step_s", time_step_object(summary)},
              {"largest_added_mass", rounded(summary.largest_added_mass)},
              {"element_added_mass", rounded(summary.element_added_mass)},
              {"threads", summary.threads},
              {"elements", elements},
              {"nodes", nodes},
              {"plies", plies_list(last.plies, figures, summary.plies)},
              {"tools", tools_list(last.tools, summary.known_forces, summary.pushed)},
              {"boundaries", list_of(last.boundaries, boundary_object)},
              {"energy", energy_object(last.energy)},
              {"kinetic_over_deformation", rounded(summary.motion_share)},
              {"accuracy", accuracy_object(summary.accuracy)},
              {"contact", contact_object(summary.contact)},
              {"searches", summary.work.searches},
              {"time_shares", time_shares_object(summary.work)},
              {"pairs", list_of(summary.work.pairs, pair_object)},
              {"assumed", summary.assumed},
              {"could_be_left_out", summary.work.could_be_left_out},
              {"missing", summary.work.missing},
              {"doubts", summary.doubts},
              {"advice", advice_of(summary)},
              {"case", case_object(summary)},
              {"figures", descriptions(figures)}};
  if (!summary.verification.figures.empty())
    all["verification"] = verification_object(summary.verification);
  // Names and messages may contain any bytes: those that are not UTF-8 become U+FFFD.
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace plyform
