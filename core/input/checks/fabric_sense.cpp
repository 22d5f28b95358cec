// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/checks/sense_checks.hpp"
#include "core/model/usual_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace plyform {
namespace {

struct FabricSense {
  const TableView& section;
  const Fabric& fabric;
  const Crossing& crossing; ///< that is looked at
  Diagnostics& diagnostics;

  void warn(const TomlNode& at, const std::string& item, const std::string& text) {
    diagnostics.warning(at.at, fmt::format("{}: {}", item, text));
  }
};

/// The key of the law of shear that is given for angles of this sign.
const TomlNode* shear_law(const TableView& shear, double side, std::string& key) {
  std::vector<const char*> words{"polynomial", "table"};
  if (side < 0.0) words.insert(words.begin(), "negative_polynomial");
  for (const char* word : words)
    if (const TomlNode* law = given(shear, word)) {
      key = word;
      return law;
    }
  return nullptr;
}

/// Torque of a cell over its angle and area: of cloth within usual_shear_rigidity. What is smaller
/// by far is meant to be limp, as nets are. side: the sign of the angles that are looked at.
void check_rigidity(FabricSense& check, double side, const TomlNode& law, const std::string& item) {
  constexpr double at_angle = 10.0 * degree; // as usual_shear_rigidity
  constexpr double limp = 1e-5;              // N/mm: a thousandth of what the softest cloth has
  const double rigidity =
      cells_per_area(check.fabric, check.crossing) * check.crossing.shear.secant(side * at_angle);
  if (!(std::abs(rigidity) > limp) || usual_shear_rigidity.holds(rigidity) || rigidity < 0.0)
    return;
  check.warn(law, item,
             fmt::format("makes the fabric {:.2g} N/mm stiff in shear at {:g} degrees, and cloth "
                         "usually has {:g} to {:g}; the torque is that of one unit cell, in N mm: "
                         "check unit and densities of the yarns",
                         rigidity, side * at_angle / degree, usual_shear_rigidity.least,
                         usual_shear_rigidity.most));
}

/// The first angle (rad) from which the torque no longer resists.
std::optional<double> turns_back_at(const ShearLaw& law, double side) {
  constexpr int parts = 320;
  constexpr double most = 80.0 * degree; // hardly any fabric gets there
  for (int i = 1; i <= parts; ++i)
    if (const double angle = side * most * i / parts; side * law.at(angle).value < 0.0)
      return angle;
  return std::nullopt;
}

void check_torque(FabricSense& check, double side, const TomlNode& law, const std::string& item) {
  const std::optional<double> from = turns_back_at(check.crossing.shear, side);
  if (!from) return;
  constexpr double usual = 45.0 * degree; // that formed parts reach
  const std::string rule =
      fmt::format("has a torque {} 0 from {:.3g} degrees of shear on: a ply sheared that far "
                  "goes on shearing by itself",
                  side > 0.0 ? "below" : "above", *from / degree);
  const std::string remedy = "give coefficients or rows that hold up to 60 degrees or so";
  if (std::abs(*from) < usual)
    check.diagnostics.error(law.at, item, law.source_text, rule, remedy);
  else
    check.warn(law, item, rule + "; " + remedy);
}

/// Angles of the table in rad.
void check_table(FabricSense& check, const TomlNode& law, const std::string& item) {
  constexpr double radians = 1.6; // degrees; as rad 92 degrees
  const std::vector<double>& angles = check.crossing.shear.angle;
  if (angles.empty() || angles.back() / degree > radians || angles.front() / degree < -radians)
    return;
  check.warn(law, item,
             fmt::format("ends at {:.3g} degrees of shear; angles are in degrees, if it is in rad "
                         "multiply them by 57.3",
                         angles.back() / degree));
}

/// The stiffness of all yarns over their mass, (m/s)^2: that of fibres is 3e7 (glass), 1.3e8
/// (carbon), 1.8e8 (polyethylene), and 2.4e8 of the stiffest carbon that is woven.
void check_yarns(FabricSense& check) {
  constexpr double most = 2.5e8; // (m/s)^2
  constexpr double mm2_in_m2 = 1e6;
  const Fabric& f = check.fabric;
  double stiffness = 0.0;
  std::vector<std::string> names;
  for (const YarnFamily& family : f.families) {
    stiffness += family.density * family.tension.largest_slope() / f.surface_density / mm2_in_m2;
    names.push_back(family.name);
  }
  const char* key = given(check.section, "warp") ? "warp" : "family";
  const TomlNode* first = given(check.section, key);
  if (!first || !(stiffness > most)) return;
  check.warn(*first, item_of(check.section, key),
             fmt::format("{} together are {:.2g} N m/kg stiff for the mass of the "
                         "fabric, and fibres have 3e7 (glass) to 2.4e8 (carbon); densities are "
                         "yarns per mm, a tenth of those per cm, stiffness is N per yarn, "
                         "surface_density g/m2",
                         joined(names, " and "), stiffness));
}

/// Mass per volume.
void check_thickness(FabricSense& check) {
  constexpr double least = 0.02, most = 8.0; // g/cm3: fleece, steel
  constexpr double g_cm3 = 1e-9;             // t/mm3
  const TomlNode* thickness = given(check.section, "thickness");
  const double density = check.fabric.surface_density / check.fabric.thickness / g_cm3;
  if (!thickness || !(density < least || density > most)) return;
  check.warn(*thickness, item_of(check.section, "thickness"),
             fmt::format("with its surface_density makes {:.2g} g/cm3, and fabrics have 0.3 to 2; "
                         "thickness is in mm, surface_density in g/m2",
                         density));
}

void check_shear(FabricSense check, const TableView& shear) {
  const ShearLaw& of = check.crossing.shear;
  if (of.k.empty() && of.angle.empty()) return;
  for (const double side : {1.0, -1.0}) {
    std::string key;
    const TomlNode* law = shear_law(shear, side, key);
    if (!law || (side < 0.0 && of.odd())) return;
    const std::string item = item_of(shear, key);
    if (side > 0.0) check_table(check, *law, item);
    check_rigidity(check, side, *law, item);
    if (of.at(0.0 * side).slope >= 0.0) check_torque(check, side, *law, item);
  }
}

} // namespace

void check_fabric_sense(const TableView& section, const Fabric& fabric, Diagnostics& diagnostics) {
  static const Crossing none;
  FabricSense check{section, fabric, none, diagnostics};
  check_thickness(check);
  if (!fabric.has_yarns()) return;
  check_yarns(check);
  std::vector<TableView> tables{subsection(section, "shear")};
  if (!tables[0].entry) tables = subsections(section, "crossing");
  for (std::size_t c = 0; c < std::min(tables.size(), fabric.crossings.size()); ++c)
    check_shear({section, fabric, fabric.crossings[c], diagnostics}, tables[c]);
}

} // namespace plyform
