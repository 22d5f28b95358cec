// SPDX-License-Identifier: GPL-3.0-or-later
// Fabrics: a yarn's tension and a cell's torque as constants or tables.
#include "core/case_parts.hpp"

#include <fmt/format.h>

namespace plyform {

namespace {

/// Tables of laws start in the origin and go on to the right; `rising`: and never down.
void check_law(const Section& law, const char* key, const std::vector<Vec2>& points, bool rising,
               Findings& findings) {
  const Entry* table = given(law, key);
  if (!table || points.empty()) return;
  const auto fail = [&](std::size_t row, const std::string& rule, const std::string& remedy) {
    const Entry& entry = table->children[row];
    findings.error(entry.at, fmt::format("{}.{}", item_of(law, key), row), entry.written, rule,
                   remedy);
  };
  if (points[0] != Vec2::Zero())
    return fail(0, "must be [0, 0], where the law starts", "put [0.0, 0.0] first");
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(points[i].x() > points[i - 1].x()))
      return fail(i, "must have a first number above that of the row before",
                  "put the rows in ascending order, each value once");
    if (rising && !(points[i].y() >= points[i - 1].y()))
      return fail(i, "must not have less in its second number than the row before",
                  "take out what falls: softening is not modelled");
  }
}

void split(const std::vector<Vec2>& points, std::vector<double>& first,
           std::vector<double>& second) {
  for (const Vec2& point : points) {
    first.push_back(point.x());
    second.push_back(point.y());
  }
}

TensionLaw read_tension(const Section& yarn, Findings& findings) {
  TensionLaw law;
  const std::vector<Vec2> points = pairs(yarn, "table");
  check_law(yarn, "table", points, true, findings);
  split(points, law.strain, law.tension);
  if (points.empty()) law.stiffness = number(yarn, "stiffness");
  return law;
}

ShearLaw read_shear(const Section& shear, Findings& findings) {
  ShearLaw law;
  const std::vector<Vec2> points = pairs(shear, "table");
  check_law(shear, "table", points, false, findings);
  split(points, law.angle, law.torque);
  law.k = numbers(shear, "polynomial");
  if (!law.k.empty() && law.k[0] < 0.0)
    value_error(shear, "polynomial", "must start with a k1 of at least 0",
                "give k1, k3, k5 ...; a cell with k1 < 0 shears by itself", findings);
  return law;
}

MomentLaw read_moments(const Section& bending, const std::string& yarn, Findings& findings) {
  MomentLaw law;
  const std::string key = yarn + "_table";
  const std::vector<Vec2> points = pairs(bending, key);
  check_law(bending, key.c_str(), points, true, findings);
  split(points, law.curvature, law.moment);
  if (points.empty() && given(bending, yarn)) law.stiffness = number(bending, yarn);
  return law;
}

/// Bending of an isotropic plate: core/bending.hpp.
BendingLaw plate_bending(const IsotropicLaw& law, double thickness) {
  const double nu = law.poissons_ratio;
  const double d = law.modulus * thickness * thickness / (12.0 * (1.0 - nu * nu));
  BendingLaw bending;
  bending.warp.stiffness = bending.weft.stiffness = d;
  bending.coupling = nu * d;
  bending.twist = 2.0 * (1.0 - nu) * d;
  return bending;
}

Fabric read_fabric(const Section& section, const std::string& key, Findings& findings) {
  Fabric fabric;
  fabric.name = given(section, "name") ? text(section, "name") : key;
  fabric.surface_density = number(section, "surface_density");
  fabric.thickness = number(section, "thickness");
  if (given(section, "fibre_angle")) fabric.fibre_angle = number(section, "fibre_angle");
  if (text(section, "law") == "isotropic") {
    const Section law = subsection(section, "isotropic");
    fabric.isotropic = {number(law, "youngs_modulus") * fabric.thickness,
                        number(law, "poissons_ratio")};
    if (text(law, "bending") == "plate")
      fabric.bending = plate_bending(*fabric.isotropic, fabric.thickness);
    return fabric;
  }
  const Section warp = subsection(section, "warp"), weft = subsection(section, "weft");
  fabric.warp_density = number(warp, "density");
  fabric.weft_density = number(weft, "density");
  fabric.warp = read_tension(warp, findings);
  fabric.weft = read_tension(weft, findings);
  fabric.shear = read_shear(subsection(section, "shear"), findings);
  const Section bending = subsection(section, "bending");
  fabric.bending = {read_moments(bending, "warp", findings),
                    read_moments(bending, "weft", findings), 0.0,
                    given(bending, "twist") ? number(bending, "twist") : 0.0};
  return fabric;
}

} // namespace

std::vector<Fabric> read_fabrics(const Section& root, Findings& findings) {
  std::vector<Fabric> fabrics;
  for (const Section& section : subsections(root, "fabrics"))
    fabrics.push_back(
        read_fabric(section, section.item.substr(std::string("fabrics.").size()), findings));
  return fabrics;
}

} // namespace plyform
