// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/sheet_laws.hpp"

#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"

#include <cmath>

namespace plyform {

namespace {

using K = KeyKind;

/// Its keys, of the material.
struct IsotropicKeys {
  double youngs_modulus, poissons_ratio; ///< N/mm^2, -
};

/// Constants of the law in a table.
Rows isotropic_constants(const std::string& table) {
  return {{.key = table + ".youngs_modulus",
           .unit = "N/mm2",
           .ranges = {{.least = 1e-6, .most = 1e7}},
           .usual = {{.least = 0.01, .most = 1e6}},
           .meaning = "Young's modulus, multiplied by the thickness",
           .members = {to(&IsotropicKeys::youngs_modulus)}},
          {.key = table + ".poissons_ratio",
           .ranges = {{.least = 0.0, .most = 0.5}},
           .meaning = "Poisson's ratio",
           .members = {to(&IsotropicKeys::poissons_ratio)}}};
}

Rows isotropic_rows() {
  const std::string table = "fabrics.NAME.isotropic";
  Rows rows{{.key = table,
             .kind = K::table,
             .of = "law",
             .with = {"isotropic"},
             .meaning = "law of a sheet without yarns, which resists compression too"}};
  append(rows, isotropic_constants(table));
  append(rows, {{.key = table + ".bending",
                 .kind = K::choice,
                 .fallback = "\"none\"",
                 .choices = {"none", "plate"},
                 .meaning =
                     "bending stiffness: none, a membrane; or that of a plate of this thickness"}});
  return rows;
}

/// Gives the fabric the bending of an isotropic plate of stiffness D, N mm: core/ply/bending.hpp.
void set_plate_bending(double stiffness, double nu, Fabric& fabric) {
  fabric.plate = stiffness;
  fabric.plate_coupling = nu * stiffness;
  fabric.twist = 2.0 * (1.0 - nu) * stiffness;
}

IsotropicLaw read_isotropic_constants(const TableView& section, double thickness) {
  IsotropicKeys keys{};
  read_members(section, keys);
  return {keys.youngs_modulus * thickness, keys.poissons_ratio};
}

/// D of a plate of the material, N mm.
double plate_stiffness(double plane_stiffness, double thickness) {
  return plane_stiffness * thickness * thickness / 12.0;
}

void read_isotropic(const TableView& section, Fabric& fabric, Diagnostics&) {
  const IsotropicLaw law = read_isotropic_constants(section, fabric.thickness);
  if (text(section, "bending") == "plate")
    set_plate_bending(plate_stiffness(law.plane_stiffness(), fabric.thickness), law.poissons_ratio,
                      fabric);
  fabric.sheet = law;
}

// ---- rubber ----

/// Keys of both laws, of the material.
struct RubberKeys {
  double shear_modulus, c10, c01; ///< N/mm^2
};

constexpr Range rubber_modulus{.least = 1e-6, .most = 1e4};
constexpr Range rubber_constant{.least = -1e4, .most = 1e4};

Rows rubber_rows(const std::string& law, const std::string& what, const Rows& constants) {
  const std::string table = "fabrics.NAME." + law;
  Rows rows{{.key = table, .kind = K::table, .of = "law", .with = {law}, .meaning = what}};
  append(rows, constants);
  append(rows, {{.key = table + ".bending_stiffness",
                 .unit = "N mm",
                 .otherwise = "that of a plate of this rubber and thickness h, E h^3 / (12 (1 - "
                              "nu^2)) = mu h^3 / 3",
                 .ranges = {bending_range},
                 .meaning = "moment per width divided by curvature, before it is stretched; 0: a "
                            "membrane, whose folds have the size of the mesh",
                 .members = {to(&Fabric::plate)}},
                {.key = table + ".stretch_limit",
                 .otherwise = "not known",
                 .ranges = {{.least = 1.0, .most = 20.0, .open_least = true}},
                 .meaning = "stretch up to which the law was measured; results say where it is "
                            "exceeded, forces do not depend on it",
                 .members = {to(&Fabric::stretch_limit)}}});
  return rows;
}

Rows neo_hookean_rows() {
  return rubber_rows("neo_hookean",
                     "neo-Hookean law of a sheet of rubber, incompressible, at any stretch",
                     {{.key = "fabrics.NAME.neo_hookean.shear_modulus",
                       .unit = "N/mm2",
                       .ranges = {rubber_modulus},
                       .usual = {range_of(usual_rubber_modulus)},
                       .meaning = "shear modulus mu at rest, a third of Young's modulus",
                       .members = {to(&RubberKeys::shear_modulus)}}});
}

Rows mooney_rivlin_rows() {
  const std::string table = "fabrics.NAME.mooney_rivlin";
  return rubber_rows(
      "mooney_rivlin", "Mooney-Rivlin law of a sheet of rubber, incompressible, at any stretch",
      {{.key = table + ".c10",
        .unit = "N/mm2",
        .ranges = {rubber_constant},
        .usual = {{.least = 0.0, .most = 2.5}},
        .meaning = "constant of I1 - 3; c10 + c01, half of the shear modulus at rest, must be "
                   "above 0",
        .members = {to(&RubberKeys::c10)}},
       {.key = table + ".c01",
        .unit = "N/mm2",
        .ranges = {rubber_constant},
        .usual = {{.least = 0.0, .most = 2.5}},
        .meaning = "constant of I2 - 3; below 0 the sheet softens when stretched both ways",
        .members = {to(&RubberKeys::c01)}}});
}

void read_rubber(const TableView& section, const MooneyRivlinLaw& law, Fabric& fabric) {
  constexpr double nu = 0.5;
  set_plate_bending(plate_stiffness(law.plane_stiffness(), fabric.thickness), nu, fabric);
  read_members(section, fabric);
  set_plate_bending(fabric.plate, nu, fabric);
  fabric.sheet = law;
}

void read_neo_hookean(const TableView& section, Fabric& fabric, Diagnostics&) {
  RubberKeys keys{};
  read_members(section, keys);
  read_rubber(section, {0.5 * keys.shear_modulus * fabric.thickness, 0.0}, fabric);
}

void read_mooney_rivlin(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  RubberKeys keys{};
  read_members(section, keys);
  if (keys.c10 + keys.c01 <= 0.0)
    value_error(section, "c01",
                fmt::format("makes c10 + c01 = {:g} N/mm2; half of the shear modulus at rest must "
                            "be above 0",
                            keys.c10 + keys.c01),
                "check the signs: plyform identify finds both from curves", diagnostics);
  const MooneyRivlinLaw law{keys.c10 * fabric.thickness, keys.c01 * fabric.thickness};
  const std::optional<Softening> softens = softening_of(law);
  const char* key = softens && softens->equibiaxial ? "c01" : "c10";
  if (softens && law.shear_modulus() > 0.0)
    diagnostics.warning(
        section.entry->find(key)->at,
        fmt::format("{} = {:g}: a sheet stretched {} softens beyond a stretch of "
                    "{:.3g} and is unstable there; only less may come in a run",
                    item_of(section, key), softens->equibiaxial ? keys.c01 : keys.c10,
                    softens->equibiaxial ? "both ways" : "one way", softens->stretch));
  read_rubber(section, law, fabric);
}

struct SheetLawInput {
  const char* word; ///< of `law`, and of the table that its keys are in
  Rows (*rows)();
  void (*read)(const TableView& section, Fabric& fabric, Diagnostics& diagnostics);
};

constexpr SheetLawInput sheet_laws[] = {{"isotropic", isotropic_rows, read_isotropic},
                                        {"neo_hookean", neo_hookean_rows, read_neo_hookean},
                                        {"mooney_rivlin", mooney_rivlin_rows, read_mooney_rivlin}};

} // namespace

std::vector<std::string> fabric_laws() {
  std::vector<std::string> words{"woven", families_word};
  for (const SheetLawInput& law : sheet_laws)
    words.emplace_back(law.word);
  return words;
}

Rows sheet_law_rows() {
  Rows rows;
  for (const SheetLawInput& law : sheet_laws)
    append(rows, law.rows());
  return rows;
}

namespace {

constexpr Range melt_viscosity_range{.least = 0.0, .most = 1e9};
constexpr Range usual_melt_viscosity{.least = 10.0, .most = 1e6};

/// The melt of a sheet beside yarns, if it has one.
void read_matrix(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  ViscousMatrix matrix;
  read_members(section, matrix);
  if (!(matrix.longitudinal > 0.0 || matrix.transverse > 0.0)) return;
  fabric.matrix = matrix;
  if (yarn_directions(fabric) != 1)
    value_error(section,
                matrix.longitudinal > 0.0 ? "longitudinal_viscosity" : "transverse_viscosity",
                "is of a melt around yarns in one direction, and this fabric has others, or none",
                "give the viscosity of a [[crossing]], or take it out", diagnostics);
}

} // namespace

Rows sheet_beside_rows() {
  const std::string table = "fabrics.NAME.sheet";
  Rows rows{{.key = table,
             .kind = K::table,
             .otherwise = "none",
             .of = "law",
             .with = {families_word},
             .meaning = "isotropic law of the sheet beside its yarns: what holds bundles together, "
                        "or a foil"}};
  append(rows, isotropic_constants(table));
  append(rows,
         {{.key = table + ".bending_stiffness",
           .unit = "N mm",
           .otherwise = "0 of a ply alone, in a stack an estimate for yarns in one direction that "
                        "bear compression: a bending length of 20 mm",
           .ranges = {bending_range},
           .meaning = "moment per width divided by curvature of the sheet by itself, what a "
                      "cantilever test across yarns in one direction gives; of fabrics with "
                      "yarns in one direction, or two at right angles",
           .members = {to(&Fabric::plate)}},
          {.key = table + ".bending_viscosity",
           .unit = "N mm s",
           .fallback = "0.0",
           .ranges = {bending_range},
           .meaning = "moment per width by the rate of curvature of the process, beside "
                      "bending_stiffness",
           .members = {to(&Fabric::plate_viscosity)}},
          {.key = table + ".longitudinal_viscosity",
           .unit = "Pa s",
           .otherwise = "0: no melt",
           .ranges = {melt_viscosity_range},
           .usual = {usual_melt_viscosity},
           .meaning = "of the melt around yarns in one direction, for shear "
                      "along them in the plane, beside the elastic law; needs process.duration",
           .members = {to(&ViscousMatrix::longitudinal)}},
          {.key = table + ".transverse_viscosity",
           .unit = "Pa s",
           .otherwise = "0",
           .ranges = {melt_viscosity_range},
           .usual = {usual_melt_viscosity},
           .meaning = "likewise for shear across the yarns: they are drawn apart in the plane by "
                      "four times it, as the ply gets thinner",
           .members = {to(&ViscousMatrix::transverse)}}});
  return rows;
}

void read_sheet_beside(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  fabric.plate_source = ValueSource::missing;
  if (!section.entry) return;
  const IsotropicLaw law = read_isotropic_constants(section, fabric.thickness);
  fabric.sheet = law;
  read_matrix(section, fabric, diagnostics);
  if (!given(section, "bending_stiffness")) {
    if (number(section, "bending_viscosity") > 0.0)
      value_error(section, "bending_viscosity", "needs a bending_stiffness beside it",
                  "give both, or take it out", diagnostics);
    return;
  }
  read_members(section, fabric);
  fabric.plate_source = ValueSource::given;
  fabric.plate_coupling = law.poissons_ratio * fabric.plate;
  if (!fabric.has_yarns()) fabric.twist = 2.0 * (1.0 - law.poissons_ratio) * fabric.plate;
  constexpr double askew = 1e-6; // cosine of the angle between the axes
  if (fabric.plate > 0.0 && std::abs(std::cos(material_axes(fabric).between())) > askew)
    value_error(section, "bending_stiffness",
                "is of the sheet across yarns in one direction, or in two at right angles; here "
                "yarns bend in two directions that are not",
                "take it out: their bending_stiffness is enough", diagnostics);
}

bool read_sheet(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  for (const SheetLawInput& law : sheet_laws)
    if (text(section, "law") == law.word) {
      law.read(subsection(section, law.word), fabric, diagnostics);
      return true;
    }
  return false;
}

} // namespace plyform
