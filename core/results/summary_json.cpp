// SPDX-License-Identifier: GPL-3.0-or-later
// summary.json: the main numbers of each ply and tool, for sweeps and reports. Keys are written in
// the order in which they appear here; docs/users/results.md describes them.
#include "base/format.hpp"
#include "core/results/pair_json.hpp"
#include "core/results/result_fields.hpp"
#include "core/results/statistics.hpp"

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

Json draw_in_keys(const DrawIn& d) {
  if (!d.unknown.empty()) return {{"no_draw_in", d.unknown}};
  return {{"draw_in_mm", {{"mean", rounded(d.mean())}, {"largest", rounded(d.largest())}}},
          {"draw_in_yarns_mm", four_walks(d.yarns_deg, d.yarns)},
          {"draw_in_bisectors_mm", four_walks(d.bisectors_deg, d.bisectors)}};
}

Json pressed_keys(const PressedYarns& pressed) {
  return {{"max_pressed_strain", rounded(pressed.largest)},
          {"area_share_pressed_over_2_percent", rounded(pressed.share_above_2)},
          {"area_share_pressed_over_5_percent", rounded(pressed.share_above_5)},
          {"excess_length_mm", rounded(pressed.excess_mm)},
          {"excess_length_at_mm", place(pressed.excess_at)}};
}

Json wrinkle_keys(const Wrinkle& wrinkle) {
  return {{"wrinkle_height_mm", rounded(wrinkle.height)},
          {"wrinkle_length_mm", rounded(wrinkle.wavelength)},
          {"wrinkle_at_mm", place(wrinkle.at)}};
}

Json bridging_keys(const Bridging& bridging) {
  Json keys{{"bridging_height_mm", rounded(bridging.height)},
            {"bridging_area_mm2", rounded(bridging.area)}};
  if (bridging.height > 0.0) keys["bridging_at_mm"] = place(bridging.at);
  if (!bridging.family.empty())
    keys.update({{"bridging_family", bridging.family},
                 {"bridging_max_tension_N_per_yarn", rounded(bridging.largest_tension)},
                 {"bridging_mean_tension_N_per_yarn", rounded(bridging.mean_tension)}});
  return keys;
}

Json fibre_volume_keys(const FibreVolume& v) {
  return {{"fibre_volume_mean", rounded(v.mean)},
          {"fibre_volume_min", rounded(v.least)},
          {"fibre_volume_min_at_mm", place(v.least_at)},
          {"fibre_volume_max", rounded(v.largest)},
          {"fibre_volume_max_at_mm", place(v.largest_at)}};
}

Json mould_keys(const MouldFill& mould) {
  Json keys{{"mould_area_mm2", rounded(mould.area)},
            {"mould_gap_min_mm", rounded(mould.least_gap)},
            {"mould_gap_mean_mm", rounded(mould.mean_gap)},
            {"mould_wider_area_mm2", rounded(mould.wider)},
            {"mould_packed_area_mm2", rounded(mould.packed)},
            {"max_gap_left_mm", rounded(mould.widest)}};
  if (mould.widest > 0.0) keys["max_gap_left_at_mm"] = place(mould.widest_at);
  return keys;
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

/// The keys of a ply that its report adds to those of its fields.
Json report_keys(const PlyReport& report) {
  Json keys = Json::object();
  if (report.pressed) keys.update(pressed_keys(*report.pressed));
  keys.update(wrinkle_keys(report.wrinkle));
  if (report.bridging) keys.update(bridging_keys(*report.bridging));
  if (report.fibre_volume) keys.update(fibre_volume_keys(*report.fibre_volume));
  if (report.mould) keys.update(mould_keys(*report.mould));
  if (report.locking_angle_deg) keys["locking_angle_deg"] = rounded(*report.locking_angle_deg);
  if (report.beyond_locking_share)
    keys["area_share_beyond_locking_angle"] = rounded(*report.beyond_locking_share);
  if (report.max_stretch) keys["max_stretch"] = rounded(*report.max_stretch);
  if (report.stretch_limit) keys["stretch_limit"] = rounded(*report.stretch_limit);
  if (report.max_shear_rate) keys["max_shear_rate_per_s"] = rounded(*report.max_shear_rate);
  if (report.measured_shear_rate)
    keys["measured_shear_rate_per_s"] = rounded(*report.measured_shear_rate);
  if (report.beyond_rate_share)
    keys["area_share_beyond_measured_shear_rate"] = rounded(*report.beyond_rate_share);
  if (report.beyond_stretch_share)
    keys["area_share_beyond_stretch_limit"] = rounded(*report.beyond_stretch_share);
  if (!report.openings.empty()) keys["openings"] = list_of(report.openings, opening_object);
  keys.update(draw_in_keys(report.draw_in));
  if (!report.stitches.empty()) keys.update(stitch_keys(report.stitches));
  return keys;
}

/// Values of all families of yarns in one list.
std::vector<double> of_all(const PlyFrame& ply, std::vector<double> FamilyFrame::*values) {
  std::vector<double> all;
  for (const FamilyFrame& family : ply.families)
    all.insert(all.end(), (family.*values).begin(), (family.*values).end());
  return all;
}

Json ply_object(const PlyFrame& ply) {
  const std::vector<double> areas = areas_before(ply);
  const std::vector<double> strains = of_all(ply, &FamilyFrame::strain);
  const std::vector<double> tensions = of_all(ply, &FamilyFrame::tension);
  Json object{{"name", ply.name},
              {"angle_deg", rounded(ply.angle_deg)},
              {"max_shear_deg", rounded(largest_magnitude(ply.shear_deg))},
              {"p99_shear_deg", rounded(percentile(ply.shear_deg, areas, 0.99))},
              {"rms_shear_deg", rounded(root_mean_square(ply.shear_deg, areas))},
              {"max_fibre_strain", rounded(largest(strains))},
              {"min_fibre_strain", rounded(smallest(strains))},
              {"max_tension_N_per_yarn", rounded(largest(tensions))}};
  if (!ply.temperature.empty())
    object.update({{"mean_temperature_C", rounded(mean_of_nodes(ply, ply.temperature))},
                   {"min_temperature_C", rounded(smallest(ply.temperature))},
                   {"max_temperature_C", rounded(largest(ply.temperature))}});
  return object;
}

/// `reports`: one per ply, or empty if only the fields are known.
Json plies_list(const std::vector<PlyFrame>& plies, const std::vector<PlyReport>& reports) {
  Json list = list_of(plies, ply_object);
  if (!reports.empty())
    for (std::size_t i = 0; i < plies.size(); ++i)
      list[i].update(report_keys(reports.at(i)));
  return list;
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

Json verification_object(const Verification& v) {
  Json object = {{"cost", rounded(v.cost)},
                 {"work", rounded(v.work)},
                 {"figures", list_of(v.figures, figure_object)},
                 {"shear_of_all_plies", figure_object(v.shear)}};
  if (v.asked) object["asked"] = asked_object(*v.asked);
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
              {"plies", plies_list(last.plies, summary.plies)},
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
              {"case", case_object(summary)}};
  if (!summary.verification.figures.empty())
    all["verification"] = verification_object(summary.verification);
  // Names and messages may contain any bytes: those that are not UTF-8 become U+FFFD.
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace plyform
