// SPDX-License-Identifier: GPL-3.0-or-later
// The state of one ply at one time, as it is output. Units: mm, N, degrees, N per yarn.
#pragma once

#include "base/geometry.hpp"
#include "core/model/description.hpp"

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace plyform {

/// One family of yarns of a ply of m triangles.
struct FamilyFrame {
  std::string name;            ///< begins the names of its columns: warp
  double angle_deg = 0;        ///< from x to its fibres before forming
  std::vector<Vec3> direction; ///< m, unit vectors of the fibres now
  std::vector<double> strain;  ///< m
  std::vector<double> tension; ///< m, N per yarn
  /// m, of the distance between neighbouring yarns; empty: not told (shows_opening of
  /// core/model/fabric.hpp)
  std::vector<double> opening = {};
};

/// Stitches of one direction of a ply of m triangles; tension in N per stitch.
struct StitchFrame : FamilyFrame {
  std::vector<double> broken; ///< m, 1 where they are broken, else 0
};

/// A crossing of two families that is not the first of its fabric.
struct CrossingFrame {
  std::string suffix;            ///< of both families, "A_B": ends the name of its column
  std::vector<double> shear_deg; ///< m, signed
};

/// What a closed mould leaves at the m triangles of a ply, 0 where they are not in it; all empty
/// without one: core/run/closed_gap.hpp.
struct GapFrame {
  std::vector<double> gap, left;    ///< mm: between the tools; of it, what the stack does not fill
  std::vector<double> packing;      ///< densest packing of the stack over the gap
  std::vector<double> fibre_volume; ///< fraction, of the stack; empty if not of all plies is known
};

/// One ply at one time. Sizes: n nodes, m triangles. Plies of a run may have different families.
struct PlyFrame {
  std::string name;
  double angle_deg = 0;
  std::vector<Vec3> x0, x;              ///< n, mm: before and now
  std::vector<Triangle> triangles;      ///< m
  std::vector<FamilyFrame> families;    ///< any number
  std::vector<StitchFrame> stitches;    ///< any number
  std::vector<double> shear_deg;        ///< m, signed, of the first crossing
  std::vector<CrossingFrame> crossings; ///< those behind the first
  std::vector<double> thickness;        ///< m, mm
  std::vector<double> areal_weight;     ///< m, g/m^2
  std::vector<double> fibre_volume;     ///< m, fraction; empty without fibre_density
  GapFrame mould;
  /// m, the larger and the smaller principal stretch of a sheet of rubber; empty of others
  std::array<std::vector<double>, 2> stretch;
  std::vector<double> shear_rate;       ///< m, 1/s of the process; empty without laws with rates
  std::vector<double> largest_rate;     ///< m, likewise, of magnitude, since the start
  std::vector<double> viscous_shear;    ///< m, N/mm; likewise
  std::vector<double> contact_pressure; ///< n, N/mm^2, normal contact force over node area
  std::vector<Vec3> reaction;           ///< n, N, of boundaries; empty where there are none
  std::vector<double> wrinkle_height;   ///< n, mm: wrinkles.hpp; empty if not looked for
  std::vector<double> temperature;      ///< n, degC; empty of cases without temperatures
  std::vector<double> bridging_height;  ///< n, mm: bridging.hpp; empty where nothing could bridge
  /// n, unit vectors to where nodes are pressed that nothing holds up there, else 0, or empty:
  /// core/run/bridging.hpp. No column.
  std::vector<Vec3> pushed;
  /// N/mm^2, of all loads on it, from below less from above; NaN if it has none
  double load_pressure = std::numeric_limits<double>::quiet_NaN();
};

/// A column of the results beside its values.
struct Column : Description {
  Location location = Location::triangle;
  std::string quantity = {}; ///< what columns of several families share; empty: none
  bool may_lack = false;     ///< left out of the files of plies for which it is empty
};

/// The column of the opening between the yarns of a family.
inline Column opening_column(const std::string& family) {
  return {{family + "_opening", family + "-opening", "opening between " + family, "1", 3, 5e-6,
           Scale::both_ways,
           "change of the distance between neighbouring yarns; negative: closer together"},
          Location::triangle,
          "opening",
          true};
}

/// The column of bridging.
inline Column bridging_column() {
  return {{"bridging_height_mm", "bridging", "bridging height", "mm", 2, 1e-3, Scale::from_zero,
           "over the tool that the stack is pressed towards, where it spans a hollow"},
          Location::node,
          "",
          true};
}

/// The column of temperatures.
inline Column temperature_column() {
  return {{"temperature_C", "temperature", "temperature", "°C", 1, 1e-6, Scale::whole,
           "the same through the ply"},
          Location::node,
          "",
          true};
}

/// The column of one of the principal stretches.
inline Column stretch_column(bool larger) {
  const std::string number = larger ? "1" : "2";
  return {{"stretch_" + number, "stretch-" + number,
           std::string(larger ? "larger" : "smaller") + " principal stretch", "1", 3, 5e-6,
           Scale::whole, "of rubber: length over that before"},
          Location::triangle,
          "stretch",
          true};
}

/// The columns of stitches.
template <class AnyStitch, class Visit>
void each_stitch_column(AnyStitch& stitch, Visit&& visit) {
  visit(Column{{stitch.name, stitch.name, "direction of " + stitch.name, "1", 3, 1e-6,
                Scale::both_ways}},
        stitch.direction);
  visit(Column{{stitch.name + "_strain", stitch.name + "-strain", stitch.name + " strain", "1", 3,
                5e-6, Scale::both_ways, "of the sheet along the stitches"}},
        stitch.strain);
  visit(Column{{stitch.name + "_tension_N", stitch.name + "-tension", stitch.name + " tension",
                "N per stitch", 3, 1e-4, Scale::from_zero}},
        stitch.tension);
  visit(Column{{stitch.name + "_broken", stitch.name + "-broken", stitch.name + " broken", "1", 0,
                1e-3, Scale::from_zero, "1: broken"}},
        stitch.broken);
}

/// The columns of what laws see of rates, and answer.
template <class AnyPly, class Visit>
void each_rate_column(AnyPly& ply, Visit&& visit) {
  visit(Column{{"shear_rate_per_s", "shear-rate", "rate of shear", "1/s", 4, 1e-6, Scale::magnitude,
                "of the process, smoothed over a hundredth of the stroke; negative: shear grows "
                "less"},
               Location::triangle,
               "",
               true},
        ply.shear_rate);
  visit(Column{{"largest_shear_rate_per_s", "largest-shear-rate", "largest rate of shear", "1/s", 4,
                1e-6, Scale::from_zero, "of the process, since the start"},
               Location::triangle,
               "",
               true},
        ply.largest_rate);
  visit(Column{{"viscous_shear_N_per_mm", "viscous-shear", "viscous shear force", "N/mm", 4, 1e-6,
                Scale::magnitude, "that the ply bears by rates, of its first crossing"},
               Location::triangle,
               "",
               true},
        ply.viscous_shear);
}

/// The columns of what the ply is through its thickness.
template <class AnyPly, class Visit>
void each_thickness_column(AnyPly& ply, Visit&& visit) {
  visit(Column{{"thickness_mm", "thickness", "thickness", "mm", 3, 1e-5, Scale::whole,
                "from constant volume; of fabrics with compaction what contact leaves"}},
        ply.thickness);
  visit(Column{{"areal_weight_g_m2", "areal-weight", "areal weight", "g/m²", 0, 0.01, Scale::whole,
                "of the formed ply by itself"},
               Location::triangle,
               "",
               true},
        ply.areal_weight);
  visit(Column{{"fibre_volume", "fibre-volume", "fibre volume fraction", "1", 3, 1e-5, Scale::whole,
                "of the ply by itself"},
               Location::triangle,
               "",
               true},
        ply.fibre_volume);
}

/// The columns of what a closed mould leaves.
template <class AnyPly, class Visit>
void each_gap_column(AnyPly& ply, Visit&& visit) {
  const auto column = [](Description description) {
    return Column{std::move(description), Location::triangle, "", true};
  };
  visit(column({"stack_gap_mm", "stack-gap", "gap of the closed mould", "mm", 3, 1e-5,
                Scale::from_zero, "between its tools; 0: not between them"}),
        ply.mould.gap);
  visit(column({"gap_left_mm", "gap-left", "gap left by the stack", "mm", 3, 1e-5, Scale::both_ways,
                "gap of the closed mould less the present thickness of the plies in it"}),
        ply.mould.left);
  visit(column({"stack_packing", "stack-packing", "packing of the stack", "1", 3, 1e-5,
                Scale::from_zero, "its thickness at the densest packing over the gap"}),
        ply.mould.packing);
  visit(column({"stack_fibre_volume", "stack-fibre-volume", "fibre volume fraction of the stack",
                "1", 3, 1e-5, Scale::from_zero, "in the gap of the closed mould"}),
        ply.mould.fibre_volume);
}

/// Calls visit(Column, values) for each column of a ply, in the order of files: values is one of
/// its vectors, of doubles or of Vec3. Every file, reader, report and plot follows this list; a new
/// column needs an entry here, and is filled in output_state.cpp.
template <class AnyPly, class Visit>
void each_column(AnyPly& ply, Visit&& visit) {
  visit(Column{{"contact_pressure", "pressure", "contact pressure", "N/mm²", 4, 1e-6,
                Scale::from_zero, "normal force of all contacts over the node's area"},
               Location::node},
        ply.contact_pressure);
  visit(Column{{"reaction_N", "reaction", "reaction", "N", 3, 1e-4, Scale::both_ways,
                "of what holds or pulls the ply"},
               Location::node,
               "",
               true},
        ply.reaction);
  visit(Column{{"wrinkle_height_mm", "wrinkle", "wrinkle height", "mm", 2, 1e-3, Scale::from_zero,
                "from valley to crest, of the waves that the mesh shows and no tool has"},
               Location::node,
               "",
               true},
        ply.wrinkle_height);
  visit(bridging_column(), ply.bridging_height);
  visit(temperature_column(), ply.temperature);
  for (auto& family : ply.families)
    visit(Column{{family.name, family.name, "direction of " + family.name, "1", 3, 1e-6,
                  Scale::both_ways},
                 Location::triangle,
                 "direction"},
          family.direction);
  const auto visit_shear = [&](const std::string& suffix, auto& values) {
    const std::string word = suffix.empty() ? "" : "-" + suffix, end = suffix.empty() ? "" : "_";
    visit(Column{{"shear_angle_deg" + end + suffix, "shear" + word,
                  "shear angle" + (suffix.empty() ? "" : " of " + suffix), "deg", 2, 0.005,
                  Scale::magnitude, "negative: the angle between the fibres opens"},
                 Location::triangle,
                 "shear"},
          values);
  };
  visit_shear("", ply.shear_deg);
  for (auto& crossing : ply.crossings)
    visit_shear(crossing.suffix, crossing.shear_deg);
  for (auto& family : ply.families)
    visit(Column{{family.name + "_strain", family.name + "-strain", family.name + " strain", "1", 3,
                  5e-6, Scale::both_ways, "negative: shorter"},
                 Location::triangle,
                 "strain"},
          family.strain);
  for (auto& family : ply.families)
    visit(Column{{family.name + "_tension_N", family.name + "-tension", family.name + " tension",
                  "N per yarn", 3, 1e-4, Scale::from_zero, "negative: compression"},
                 Location::triangle,
                 "tension"},
          family.tension);
  for (auto& family : ply.families)
    visit(opening_column(family.name), family.opening);
  for (auto& stitch : ply.stitches)
    each_stitch_column(stitch, visit);
  each_rate_column(ply, visit);
  each_thickness_column(ply, visit);
  each_gap_column(ply, visit);
  for (std::size_t i = 0; i < 2; ++i)
    visit(stretch_column(i == 0), ply.stretch[i]);
}

/// The columns of a ply whose files have them.
std::vector<Column> columns_of(const PlyFrame& ply);

/// The values of a ply's column of one number a triangle; nullptr if it has none of that name.
const std::vector<double>* triangle_values(const PlyFrame& ply, const std::string& name);

/// Two columns, or a column and the positions of nodes, that would have one name; empty if there
/// are none. A family may be called anything that makes no such pair.
std::string name_used_twice(const PlyFrame& ply);

/// Area of each triangle before forming, mm^2; m of them.
std::vector<double> areas_before(const PlyFrame& ply);

/// Mean of the values of nodes, n of them, over the area before forming.
double mean_of_nodes(const PlyFrame& ply, const std::vector<double>& values);

} // namespace plyform
