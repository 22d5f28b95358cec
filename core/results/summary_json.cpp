// SPDX-License-Identifier: GPL-3.0-or-later
// summary.json: the few numbers of each ply and tool that a sweep or a report needs.
#include "core/results/result_fields.hpp"
#include "core/results/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace plyform {

namespace {

/// Bytes of the well-formed UTF-8 sequence that begins at text[i]; 0 when there is none
/// (Unicode 15, table 3-7).
std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
  };
  const unsigned first = byte(i), second = byte(i + 1);
  if (first < 0x80) return 1;
  std::size_t length = 0;
  unsigned low = 0x80, high = 0xBF; // of the second byte
  if (first >= 0xC2 && first <= 0xDF) {
    length = 2;
  } else if (first >= 0xE0 && first <= 0xEF) {
    length = 3;
    if (first == 0xE0) low = 0xA0;  // overlong
    if (first == 0xED) high = 0x9F; // surrogates
  } else if (first >= 0xF0 && first <= 0xF4) {
    length = 4;
    if (first == 0xF0) low = 0x90;  // overlong
    if (first == 0xF4) high = 0x8F; // beyond U+10FFFF
  }
  if (length == 0 || second < low || second > high) return 0;
  for (std::size_t k = 2; k < length; ++k)
    if (byte(i + k) < 0x80 || byte(i + k) > 0xBF) return 0;
  return length;
}

std::string json_string(std::string_view text) {
  std::string out = "\"";
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const auto c = static_cast<unsigned char>(text[i]);
    if (length == 0)
      out += "\\ufffd"; // the replacement character: a reader would refuse the byte itself
    else if (c == '"' || c == '\\')
      (out += '\\') += text[i];
    else if (c < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return out + '"';
}

std::string json_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "null";
}

/// Values of both families of yarns in one list.
std::vector<double> of_both(std::vector<double> warp, const std::vector<double>& weft) {
  warp.insert(warp.end(), weft.begin(), weft.end());
  return warp;
}

/// A place, mm.
std::string json_place(const Vec3& x) {
  return fmt::format("[{}, {}, {}]", json_number(x.x()), json_number(x.y()), json_number(x.z()));
}

std::string json_numbers(const std::array<double, 4>& values) {
  return fmt::format("[{}, {}, {}, {}]", json_number(values[0]), json_number(values[1]),
                     json_number(values[2]), json_number(values[3]));
}

/// Four walks of core/results/draw_in.hpp.
std::string walks_json(std::array<double, 4> directions, const std::array<double, 4>& each) {
  double mean = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    mean += each[k] / 4.0;
    directions[k] -= 360.0 * std::floor(directions[k] / 360.0);
  }
  const auto [least, most] = std::minmax_element(each.begin(), each.end());
  return fmt::format("{{\"mean\": {}, \"spread\": {}, \"directions_deg\": {}, \"each\": {}}}",
                     json_number(mean), json_number(*most - *least), json_numbers(directions),
                     json_numbers(each));
}

std::string draw_in_json(const DrawIn& d) {
  if (!d.unknown.empty()) return fmt::format("\"no_draw_in\": {}", json_string(d.unknown));
  return fmt::format("\"draw_in_mm\": {{\"mean\": {}, \"largest\": {}}}, "
                     "\"draw_in_yarns_mm\": {}, \"draw_in_bisectors_mm\": {}",
                     json_number(d.mean()), json_number(d.largest()),
                     walks_json(d.yarns_deg, d.yarns), walks_json(d.bisectors_deg, d.bisectors));
}

/// The keys of a ply's report, each with a comma before it.
std::string report_json(const PlyReport& report) {
  std::string out;
  if (const auto& pressed = report.pressed)
    out += fmt::format(", \"max_pressed_strain\": {}, \"area_share_pressed_over_2_percent\": {}, "
                       "\"area_share_pressed_over_5_percent\": {}, \"excess_length_mm\": {}, "
                       "\"excess_length_at_mm\": {}",
                       json_number(pressed->largest), json_number(pressed->share_above_2),
                       json_number(pressed->share_above_5), json_number(pressed->excess_mm),
                       json_place(pressed->excess_at));
  out += fmt::format(", \"wrinkle_height_mm\": {}, \"wrinkle_length_mm\": {}, "
                     "\"wrinkle_at_mm\": {}",
                     json_number(report.wrinkle.height), json_number(report.wrinkle.wavelength),
                     json_place(report.wrinkle.at));
  if (report.beyond_locking_share)
    out += fmt::format(", \"area_share_beyond_locking_angle\": {}",
                       json_number(*report.beyond_locking_share));
  return out + ", " + draw_in_json(report.draw_in);
}

/// `report`: null where nothing but the fields is known.
std::string ply_json(const PlyFrame& ply, const PlyReport* report) {
  const std::vector<double> areas = areas_before(ply);
  const std::vector<double> strains = of_both(ply.warp_strain, ply.weft_strain);
  const std::vector<double> tensions = of_both(ply.warp_tension, ply.weft_tension);
  return fmt::format(
      "{{\"name\": {}, \"angle_deg\": {}, \"max_shear_deg\": {}, \"p99_shear_deg\": {}, "
      "\"rms_shear_deg\": {}, \"max_fibre_strain\": {}, \"min_fibre_strain\": {}, "
      "\"max_tension_N_per_yarn\": {}{}}}",
      json_string(ply.name), json_number(ply.angle_deg),
      json_number(largest_magnitude(ply.shear_deg)),
      json_number(percentile(ply.shear_deg, areas, 0.99)),
      json_number(root_mean_square(ply.shear_deg, areas)), json_number(largest(strains)),
      json_number(smallest(strains)), json_number(largest(tensions)),
      report ? report_json(*report) : "");
}

std::string tool_json(const ToolFrame& tool) {
  return fmt::format("{{\"name\": {}, \"force_N\": {}, \"displacement_mm\": {}}}",
                     json_string(tool.name), json_number(tool.force_N),
                     json_number(tool.stroke_mm));
}

std::string boundary_json(const BoundaryFrame& boundary) {
  return fmt::format("{{\"name\": {}, \"force_N\": {}, \"displacement_mm\": {}}}",
                     json_string(boundary.name), json_number(boundary.force_N),
                     json_number(boundary.stroke_mm));
}

template <class Item, class Text>
std::string json_list(const std::vector<Item>& items, Text text) {
  std::string out = "[";
  for (const Item& item : items)
    out += (out.size() > 1 ? ",\n    " : "\n    ") + text(item);
  return out + (items.empty() ? "]" : "\n  ]");
}

std::string energy_json(const Energies& e) {
  std::string out = "{";
  for (const EnergyTerm& term : energy_terms)
    out += fmt::format("\"{}\": {}, ", term.name, json_number(e.*term.value));
  return out + fmt::format("\"balance_error\": {}}}", json_number(e.balance_error()));
}

std::string pair_json(const PairReport& pair) {
  return fmt::format(
      "{{\"a\": {}, \"b\": {}, \"time_share\": {:.4f}, \"deepest_mm\": {}, \"slip_mm\": {}, "
      "\"friction_coefficient\": {}, \"friction_mJ\": {}}}",
      json_string(pair.a), json_string(pair.b), pair.time_share, json_number(pair.deepest_mm),
      json_number(pair.slip_mm), json_number(pair.friction_coefficient),
      json_number(pair.friction_mJ));
}

std::string time_json(const WorkReport& w) {
  return fmt::format("{{\"elements\": {:.4f}, \"contact\": {:.4f}, \"search\": {:.4f}}}",
                     w.elements_share, w.contact_share, w.search_share);
}

std::string contact_json(const ContactReport& c) {
  return fmt::format("{{\"max_tool_penetration_mm\": {}, "
                     "\"max_tool_penetration_between_nodes_mm\": {}, "
                     "\"max_ply_penetration_mm\": {}, "
                     "\"intersections_between_plies\": {}, \"intersections_within_plies\": {}}}",
                     json_number(c.max_tool_penetration_mm),
                     json_number(c.max_tool_penetration_between_nodes_mm),
                     json_number(c.max_ply_penetration_mm), c.intersections_between_plies,
                     c.intersections_within_plies);
}

} // namespace

std::string accuracy_json(const AccuracyReport& a) {
  return fmt::format("{{\"promised_shear_error_deg\": {}, \"inertia_deg\": {}, "
                     "\"softening_deg\": {}, \"mesh_deg\": {}, \"element_size_factor\": {}}}",
                     json_number(a.promised_deg), json_number(a.inertia_deg),
                     json_number(a.softening_deg), json_number(a.mesh_deg),
                     json_number(a.coarsening));
}

std::string summary_json(const Frame& last, const Summary& summary) {
  std::size_t elements = 0, nodes = 0;
  for (const PlyFrame& ply : last.plies) {
    elements += ply.triangles.size();
    nodes += ply.x0.size();
  }
  std::string out = "{\n";
  const auto entry = [&](const char* key, const std::string& value) {
    out += fmt::format("{}  \"{}\": {}", out.size() > 2 ? ",\n" : "", key, value);
  };
  entry("title", json_string(summary.title));
  entry("version", json_string(summary.version));
  entry("status", json_string(summary.status));
  entry("message", json_string(summary.message));
  entry("time_s", json_number(last.time));
  entry("stroke_mm", json_number(last.stroke_mm));
  entry("wall_time_s", json_number(summary.wall_time_s));
  entry("steps", fmt::to_string(summary.steps));
  entry("time_step_s", fmt::format("{{\"min\": {}, \"max\": {}}}", json_number(summary.min_step_s),
                                   json_number(summary.max_step_s)));
  entry("threads", fmt::to_string(summary.threads));
  entry("elements", fmt::to_string(elements));
  entry("nodes", fmt::to_string(nodes));
  entry("plies", json_list(last.plies, [&](const PlyFrame& ply) {
          const auto index = static_cast<std::size_t>(&ply - last.plies.data());
          return ply_json(ply, summary.plies.empty() ? nullptr : &summary.plies.at(index));
        }));
  entry("tools", json_list(last.tools, tool_json));
  entry("boundaries", json_list(last.boundaries, boundary_json));
  entry("energy", energy_json(last.energy));
  entry("accuracy", accuracy_json(summary.accuracy));
  entry("contact", contact_json(summary.contact));
  entry("searches", fmt::to_string(summary.work.searches));
  entry("time_shares", time_json(summary.work));
  entry("pairs", json_list(summary.work.pairs, pair_json));
  entry("assumed", json_list(summary.assumed, json_string));
  entry("could_be_left_out", json_list(summary.work.could_be_left_out, json_string));
  entry("missing", json_list(summary.work.missing, json_string));
  return out + "\n}\n";
}

} // namespace plyform
