// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/parts/yarn_families.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/sheet_laws.hpp"
#include "core/input/parts/crimp_file.hpp"
#include "core/input/parts/viscous_file.hpp"
#include "core/model/fabric_estimates.hpp"
#include "core/model/ply_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plyform {

namespace {

constexpr double steepest = 1e12; // N, or N mm^2: far beyond the stiffest key; steps stay numbers

/// Checks the table of a law: it must start at the origin with increasing first column; the second
/// column must not decrease if `rising`, its name in the message, is not empty.
void check_law(const TableView& law, const std::string& key, const std::vector<Vec2>& points,
               const std::string& rising, Diagnostics& diagnostics) {
  if (!given(law, key) || points.empty()) return;
  const auto fail = [&](std::size_t row, const std::string& rule, const std::string& remedy) {
    row_error(law, key, row, rule, remedy, diagnostics);
  };
  if (points[0] != Vec2::Zero())
    return fail(0, "must be [0, 0], where the law starts", "put [0.0, 0.0] first");
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(points[i].x() > points[i - 1].x()))
      return fail(i, "must have a first number above that of the row before",
                  "put the rows in ascending order, each value once");
    if (!(std::abs(points[i].y() - points[i - 1].y()) <=
          steepest * (points[i].x() - points[i - 1].x())))
      return fail(i,
                  fmt::format("is too steep: more than {:g} a unit from the row before", steepest),
                  "check the first number of both rows");
    if (!rising.empty() && !(points[i].y() >= points[i - 1].y()))
      return fail(i, fmt::format("must not have less {} than the row before", rising),
                  "take out what falls: a yarn that softens is not modelled");
  }
}

void split(const std::vector<Vec2>& points, std::vector<double>& first,
           std::vector<double>& second) {
  for (const Vec2& point : points) {
    first.push_back(point.x());
    second.push_back(point.y());
  }
}

/// Whether the file gives a compression stiffness of 0. A missing one is estimated if it is needed
/// (core/model/fabric_estimates.hpp).
bool tension_only(const TableView& yarn, const TensionLaw& law) {
  return given(yarn, "compression_stiffness") && law.compression == 0.0;
}

TensionLaw read_tension(const TableView& yarn, Diagnostics& diagnostics) {
  TensionLaw law;
  read_members(yarn, law);
  read_table(yarn, "table", law.strain, law.tension, diagnostics);
  if (const double most = law.largest_slope(); law.compression > most)
    value_error(yarn, "compression_stiffness",
                fmt::format("must be at most the largest stiffness in tension, {:g}", most),
                fmt::format("give {:g}, a hundredth of that, or so", usual_compression(law)),
                diagnostics);
  if (std::isfinite(law.buckling_force) && tension_only(yarn, law))
    value_error(yarn, "buckling_force",
                "needs a compression_stiffness of the same yarns above 0: yarns that carry tension "
                "only have no force to buckle at",
                fmt::format("give compression_stiffness = {:g}, 0.01 of the largest stiffness in "
                            "tension, or take buckling_force out",
                            usual_compression(law)),
                diagnostics);
  return law;
}

/// Reads the bending law of yarns whose law of tension is `tension`: bending needs yarns that bear
/// compression, as a moment shortens yarns that do not.
MomentLaw read_moments(const TableView& yarn, const TensionLaw& tension, Diagnostics& diagnostics) {
  MomentLaw law;
  read_members(yarn, law);
  const std::vector<Vec2> points = pairs(yarn, "bending_table");
  check_law(yarn, "bending_table", points, "moment", diagnostics);
  split(points, law.curvature, law.moment);
  if (law.largest_slope() > 0.0 && tension_only(yarn, tension))
    value_error(yarn, points.empty() ? "bending_stiffness" : "bending_table",
                "needs a compression_stiffness of the same yarns, or they shorten instead of "
                "bending",
                fmt::format("give compression_stiffness = {:g}, 0.01 of the largest stiffness in "
                            "tension, or so",
                            usual_compression(tension)),
                diagnostics);
  return law;
}

YarnSources sources_of(const TableView& yarn) {
  const auto source = [](bool is_given) {
    return is_given ? ValueSource::given : ValueSource::missing;
  };
  return {source(given(yarn, "compression_stiffness")),
          source(given(yarn, "bending_stiffness") || given(yarn, "bending_table")),
          source(given(yarn, "in_plane_bending_stiffness"))};
}

} // namespace

void read_table(const TableView& section, const std::string& key, std::vector<double>& strain,
                std::vector<double>& force, Diagnostics& diagnostics) {
  const std::vector<Vec2> points = pairs(section, key);
  check_law(section, key, points, "tension", diagnostics);
  split(points, strain, force);
}

namespace {

/// Checks that the table of a law of shear has [0, 0], and torques that resist.
void check_shear_table(const TableView& shear, const std::vector<Vec2>& points,
                       Diagnostics& diagnostics) {
  if (!given(shear, "table") || points.empty()) return;
  const auto fail = [&](std::size_t row, const std::string& rule, const std::string& remedy) {
    row_error(shear, "table", row, rule, remedy, diagnostics);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double angle = points[i].x(), torque = points[i].y();
    if (i > 0 && !(angle > points[i - 1].x()))
      return fail(i, "must have a first number above that of the row before",
                  "put the rows in ascending order, each value once");
    if (angle * torque < 0.0 || (angle == 0.0 && torque != 0.0))
      return fail(i, "must have a torque of the angle's sign, and 0 at 0",
                  "give torques that resist shear: below 0 for angles below 0");
    if (angle > 0.0 && (i == 0 || points[i - 1].x() < 0.0))
      return fail(i, "must come after [0, 0], where the law starts",
                  "put [0.0, 0.0] before it; rows before that are of negative angles");
  }
  if (!(points.back().x() > 0.0))
    fail(points.size() - 1, "must not be the last row: angles above 0 have none",
         "go on with rows of positive angles");
}

void check_first_coefficient(const TableView& shear, const std::string& key,
                             const std::vector<double>& k, Diagnostics& diagnostics) {
  if (!k.empty() && k[0] < 0.0)
    value_error(shear, key, "must start with a k1 of at least 0",
                "give k1, k3, k5 ...; a cell with k1 < 0 shears by itself", diagnostics);
}

} // namespace

ShearLaw read_shear(const TableView& shear, Diagnostics& diagnostics) {
  ShearLaw law;
  const std::vector<Vec2> points = pairs(shear, "table");
  check_shear_table(shear, points, diagnostics);
  split(points, law.angle, law.torque);
  law.k = numbers(shear, "polynomial");
  law.negative_k = numbers(shear, "negative_polynomial");
  check_first_coefficient(shear, "polynomial", law.k, diagnostics);
  check_first_coefficient(shear, "negative_polynomial", law.negative_k, diagnostics);
  if (law.tabulated() && !law.negative_k.empty())
    value_error(shear, "negative_polynomial", "stands beside a polynomial only",
                "begin the table with rows of negative angles, or give both polynomials",
                diagnostics);
  return law;
}

YarnFamily read_family(const TableView& section, Diagnostics& diagnostics) {
  YarnFamily family;
  read_members(section, family);
  family.tension = read_tension(section, diagnostics);
  for (const Vec2& branch : pairs(section, "relaxation"))
    family.relaxation = MaxwellBranch{branch.x(), branch.y()};
  family.bending = read_moments(section, family.tension, diagnostics);
  family.sources = sources_of(section);
  return family;
}

namespace {

/// The index of the family that a crossing names; nothing if there is none, which is reported,
/// unless families have mistakes.
std::optional<std::size_t> family_named(const TableView& crossing, std::size_t place,
                                        const Fabric& fabric, bool all_known,
                                        Diagnostics& diagnostics) {
  const TomlNode* names = given(crossing, "families");
  if (!names) return std::nullopt;
  const TomlNode& name = names->children[place];
  std::vector<std::string> known;
  for (std::size_t a = 0; a < fabric.families.size(); ++a) {
    if (fabric.families[a].name == name.text) return a;
    known.push_back(fabric.families[a].name);
  }
  if (all_known)
    diagnostics.error(name.at, fmt::format("{}.{}", item_of(crossing, "families"), place),
                      name.source_text, "names no family of this fabric",
                      "give one of " + joined(known));
  return std::nullopt;
}

/// all_known: whether the families' names are.
Crossing read_crossing(const TableView& section, const Fabric& fabric, bool all_known,
                       Diagnostics& diagnostics) {
  Crossing crossing;
  crossing.shear = read_shear(section, diagnostics);
  crossing.viscous = read_viscous_shear(section, diagnostics);
  const std::optional<std::size_t> first = family_named(section, 0, fabric, all_known, diagnostics),
                                   second =
                                       family_named(section, 1, fabric, all_known, diagnostics);
  if (!first || !second) return crossing;
  crossing.first = *first, crossing.second = *second;
  constexpr double least = 1e-3; // sine of the angle between them
  if (std::sin(crossing_angle(fabric, crossing)) <= least)
    value_error(section, "families", "must be two families that are not parallel",
                "give families at an angle to each other", diagnostics);
  const auto same = [&](const Crossing& other) {
    return std::minmax(other.first, other.second) == std::minmax(crossing.first, crossing.second);
  };
  if (std::any_of(fabric.crossings.begin(), fabric.crossings.end(), same))
    value_error(section, "families", "cross already in a [[crossing]] before",
                "give each two families one crossing", diagnostics);
  const TableView crimp = subsection(section, "crimp");
  read_crimp(crimp, fabric, crossing, diagnostics);
  const auto crimped_there = [&](const Crossing& other) {
    const auto of = [&](std::size_t a) { return a == crossing.first || a == crossing.second; };
    return other.crimp && (of(other.first) || of(other.second));
  };
  if (crimp.entry && std::any_of(fabric.crossings.begin(), fabric.crossings.end(), crimped_there))
    value_error(section, "crimp", "is of a family that has crimp in a [[crossing]] before",
                "give each family crimp in one crossing", diagnostics);
  return crossing;
}

/// Reports names that stand twice, or that give a column which there is already.
void check_names(const TableView& section, const Fabric& fabric, Diagnostics& diagnostics) {
  const std::vector<TableView> tables = subsections(section, "family");
  for (std::size_t a = 0; a < tables.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (fabric.families[a].name == fabric.families[b].name)
        value_error(tables[a], "name", "names two families of this fabric",
                    "give each family a name of its own", diagnostics);
  PlyFrame ply;
  for (std::size_t a = 0; a < tables.size(); ++a) {
    ply.families.push_back({fabric.families[a].name, 0.0, {}, {}, {}});
    const std::string column = name_used_twice(ply);
    if (column.empty() || !given(tables[a], "name")) continue;
    return value_error(tables[a], "name",
                       fmt::format("would give results two columns of one name, {}", column),
                       "give the family another name", diagnostics);
  }
}

/// Angles (rad) from the first family's on, less than half a turn: a yarn has no sense. Answers
/// which were turned by half a turn, or three.
std::vector<bool> order_angles(Fabric& fabric) {
  std::vector<bool> turned;
  for (YarnFamily& family : fabric.families) {
    const double from = family.angle - fabric.families[0].angle;
    const double half_turns = std::floor(from / std::numbers::pi);
    family.angle -= std::numbers::pi * half_turns;
    turned.push_back(std::fmod(half_turns, 2.0) != 0.0);
  }
  return turned;
}

/// Reports a law of both signs of two families of which one has been turned: the diagonal that
/// shear above 0 draws out would not be the one between their angles.
void check_sign(const TableView& section, const Crossing& crossing, const std::vector<bool>& turned,
                Diagnostics& diagnostics) {
  if (crossing.shear.odd() || turned[crossing.first] == turned[crossing.second]) return;
  value_error(section, "families",
              "has a law that differs by the sign of shear, and the angle of one of them lies "
              "outside of the half turn from the first [[family]] on, so that the sign is unclear",
              "put the [[family]] with the least angle first, or give that angle with 180 degrees "
              "more",
              diagnostics);
}

/// Reports a fabric in which nothing holds against strains in some direction, whatever holds it.
void check_hold(const TableView& section, const Fabric& fabric, Diagnostics& diagnostics) {
  if (given(section, "sheet") || !section.entry || yarn_directions(fabric) > 1) return;
  diagnostics.error(section.entry->at, item_of(section, "sheet"), "",
                    fabric.families.empty()
                        ? "is missing, and there are no yarns"
                        : "is missing, and nothing else holds against strain across the yarns",
                    subsections(section, "stitch").empty()
                        ? "give a [sheet], or a [[family]] in another direction"
                        : "give a [sheet], or a [[family]] in another direction: stitches bear no "
                          "compression, and break");
}

} // namespace

void read_families(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errors.size();
  const bool sound = is_sound(section);
  for (const TableView& family : subsections(section, "family"))
    fabric.families.push_back(read_family(family, diagnostics));
  const std::vector<bool> turned = order_angles(fabric);
  const bool all_known = knows_names(section, "family");
  Diagnostics unheard; // what would follow from families with mistakes
  Diagnostics& told = is_sound(section, "family") ? diagnostics : unheard;
  check_names(section, fabric, diagnostics);
  for (const TableView& crossing : subsections(section, "crossing")) {
    fabric.crossings.push_back(read_crossing(crossing, fabric, all_known, diagnostics));
    if (!fabric.families.empty()) check_sign(crossing, fabric.crossings.back(), turned, told);
  }
  read_sheet_beside(subsection(section, "sheet"), fabric, told);
  if (sound && diagnostics.errors.size() == before) check_hold(section, fabric, diagnostics);
}

} // namespace plyform
