// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/figures.hpp"

#include "core/results/statistics.hpp"

#include <numeric>
#include <optional>
#include <utility>

namespace plyform {

namespace {

/// Collects figures, of which some may not be known.
class FigureList {
public:
  explicit FigureList(std::vector<FigureValue>& all) : all_(all) {}

  void number(Figure figure, std::optional<double> value) {
    if (value) all_.push_back({std::move(figure), *value});
  }

  void place(const char* name, const char* label, const Vec3& at) {
    all_.push_back({Figure{{name, "", label, "mm", 1, 1e-3, Scale::whole}, false, ""}, at});
  }

private:
  std::vector<FigureValue>& all_;
};

Figure figure(const char* name, const char* label, const char* unit, int digits,
              const char* note = "") {
  return {{name, "", label, unit, digits, 0.0, Scale::from_zero, note}, false, ""};
}

/// Likewise, and lists of runs show it. `verified`: as Figure.
Figure compared(const char* name, const char* label, const char* unit, int digits,
                const char* note = "", const char* verified = "") {
  Figure one = figure(name, label, unit, digits, note);
  one.compared = true, one.verified = verified;
  return one;
}

/// Values of all families of yarns in one list.
std::vector<double> of_all(const PlyFrame& ply, std::vector<double> FamilyFrame::*values) {
  std::vector<double> all;
  for (const FamilyFrame& family : ply.families)
    all.insert(all.end(), (family.*values).begin(), (family.*values).end());
  return all;
}

void fields(const PlyFrame& ply, FigureList& add) {
  const std::vector<double> areas = areas_before(ply);
  const std::vector<double> strains = of_all(ply, &FamilyFrame::strain);
  add.number(compared("max_shear_deg", "largest shear", "deg", 1),
             largest_magnitude(ply.shear_deg));
  add.number(compared("p99_shear_deg", "shear that 99 % have less than", "deg", 1, "of the area"),
             percentile(ply.shear_deg, areas, 0.99));
  add.number(compared("rms_shear_deg", "shear, rms", "deg", 1, "over the area", "shear"),
             root_mean_square(ply.shear_deg, areas));
  add.number(compared("max_fibre_strain", "largest fibre strain", "1", 2), largest(strains));
  add.number(compared("min_fibre_strain", "smallest fibre strain", "1", 2, "negative: shorter"),
             smallest(strains));
  add.number(compared("max_tension_N_per_yarn", "largest tension", "N per yarn", 2),
             largest(of_all(ply, &FamilyFrame::tension)));
  if (ply.temperature.empty()) return;
  add.number(
      compared("mean_temperature_C", "mean temperature", "°C", 1, "over the area before forming"),
      mean_of_nodes(ply, ply.temperature));
  add.number(figure("min_temperature_C", "lowest temperature", "°C", 1), smallest(ply.temperature));
  add.number(figure("max_temperature_C", "highest temperature", "°C", 1), largest(ply.temperature));
}

void pressed(const PressedYarns& yarns, FigureList& add) {
  add.number(compared("max_pressed_strain", "largest compression", "1", 2, "shortening of a yarn",
                      "largest compression"),
             yarns.largest);
  const char* over_2 = "area_share_pressed_over_2_percent";
  add.number(figure(over_2, "area with yarns pressed over 2 %", "1", 1), yarns.share_above_2);
  const char* over_5 = "area_share_pressed_over_5_percent";
  add.number(figure(over_5, "area with yarns pressed over 5 %", "1", 1), yarns.share_above_5);
  add.number(compared("excess_length_mm", "excess length", "mm", 1,
                      "of the worst yarn over the way that the mesh gives it"),
             yarns.excess_mm);
  add.place("excess_length_at_mm", "where that yarn is pressed most", yarns.excess_at);
}

void wrinkles(const Wrinkle& wrinkle, FigureList& add) {
  add.number(compared("wrinkle_height_mm", "highest wrinkle", "mm", 2, "from valley to crest"),
             wrinkle.height);
  add.number(figure("wrinkle_length_mm", "wavelength of the highest wrinkle", "mm", 0,
                    "in the unformed ply"),
             wrinkle.wavelength);
  add.place("wrinkle_at_mm", "the highest wrinkle", wrinkle.at);
}

void bridging(const Bridging& found, FigureList& add) {
  add.number(compared("bridging_height_mm", "bridging height", "mm", 2, "over the tool"),
             found.height);
  add.number(compared("bridging_area_mm2", "bridging area", "mm²", 0), found.area);
  if (found.height > 0.0) add.place("bridging_at_mm", "the largest bridging", found.at);
  if (found.family.empty()) return;
  add.number(figure("bridging_max_tension_N_per_yarn", "largest tension where it bridges",
                    "N per yarn", 2),
             found.largest_tension);
  add.number(
      figure("bridging_mean_tension_N_per_yarn", "mean tension where it bridges", "N per yarn", 2),
      found.mean_tension);
}

void fibre_volume(const FibreVolume& v, FigureList& add) {
  add.number(figure("fibre_volume_mean", "mean fibre volume", "1", 1, "of the ply by itself"),
             v.mean);
  add.number(figure("fibre_volume_min", "least fibre volume", "1", 1, "of the ply by itself"),
             v.least);
  add.place("fibre_volume_min_at_mm", "the least fibre volume", v.least_at);
  add.number(compared("fibre_volume_max", "largest fibre volume", "1", 1, "of the ply by itself"),
             v.largest);
  add.place("fibre_volume_max_at_mm", "the largest fibre volume", v.largest_at);
}

void mould(const MouldFill& fill, FigureList& add) {
  add.number(figure("mould_area_mm2", "area in the mould", "mm²", 0, "of the unformed ply"),
             fill.area);
  add.number(figure("mould_gap_min_mm", "least gap of the mould", "mm", 3), fill.least_gap);
  add.number(figure("mould_gap_mean_mm", "mean gap of the mould", "mm", 3), fill.mean_gap);
  add.number(figure("mould_wider_area_mm2", "area where the mould is wider than the stack", "mm²",
                    0, "by more than a twentieth of its gap"),
             fill.wider);
  add.number(figure("mould_packed_area_mm2", "area at the densest packing", "mm²", 0), fill.packed);
  add.number(compared("max_gap_left_mm", "largest gap left", "mm", 3), fill.widest);
  if (fill.widest > 0.0) add.place("max_gap_left_at_mm", "the largest gap left", fill.widest_at);
}

/// Values beside the limits of fabrics.
void limits(const PlyFrame& ply, const PlyReport& report, FigureList& add) {
  add.number(figure("locking_angle_deg", "locking angle", "deg", 1, "of the fabric"),
             report.locking_angle_deg);
  add.number(compared("area_share_beyond_locking_angle", "area beyond locking", "1", 1),
             report.beyond_locking_share);
  if (report.beyond_locking_share) {
    const std::vector<double> areas = areas_before(ply);
    add.number(figure("area_beyond_locking_angle_mm2", "area beyond the locking angle", "mm²", 0,
                      "of the unformed ply"),
               *report.beyond_locking_share * std::accumulate(areas.begin(), areas.end(), 0.0));
  }
  add.number(figure("max_stretch", "largest stretch", "", 3, "of rubber"), report.max_stretch);
  add.number(figure("stretch_limit", "stretch limit", "", 3, "of the rubber"),
             report.stretch_limit);
  add.number(figure("max_shear_rate_per_s", "largest rate of shear", "1/s", 4, "of the process"),
             report.max_shear_rate);
  add.number(figure("measured_shear_rate_per_s", "highest measured rate of shear", "1/s", 4),
             report.measured_shear_rate);
  add.number(
      figure("area_share_beyond_measured_shear_rate", "area beyond the measured rate", "1", 1),
      report.beyond_rate_share);
  add.number(figure("area_share_beyond_stretch_limit", "area beyond the stretch limit", "1", 1),
             report.beyond_stretch_share);
}

} // namespace

std::vector<FigureValue> figures_of(const PlyFrame& ply, const PlyReport* report) {
  std::vector<FigureValue> all;
  FigureList add(all);
  fields(ply, add);
  if (!report) return all;
  if (report->pressed) pressed(*report->pressed, add);
  wrinkles(report->wrinkle, add);
  if (report->bridging) bridging(*report->bridging, add);
  if (report->fibre_volume) fibre_volume(*report->fibre_volume, add);
  if (report->mould) mould(*report->mould, add);
  limits(ply, *report, add);
  if (const DrawIn& d = report->draw_in; d.unknown.empty()) {
    add.number(compared("draw_in_mm.mean", "draw-in", "mm", 1, "mean of eight walks", "draw-in"),
               d.mean());
    add.number(figure("draw_in_mm.largest", "largest draw-in", "mm", 1, "of eight walks"),
               d.largest());
  }
  return all;
}

const std::vector<Figure>& figures_of_runs() {
  static const std::vector<Figure> all = {
      compared("energy.balance_error", "error of the energy balance", "1", 2),
      compared("kinetic_over_deformation", "kinetic energy over deformation", "1", 1),
      compared("accuracy.promised_shear_error_deg", "predicted error of shear", "deg", 2),
      compared("contact.max_ply_penetration_mm", "penetration between plies", "mm", 3),
      compared("stroke_mm", "stroke", "mm", 2),
      compared("wall_time_s", "time", "s", 1),
      compared("steps", "steps", "", 0),
      compared("elements", "triangles", "", 0)};
  return all;
}

} // namespace plyform
