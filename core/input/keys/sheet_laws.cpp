// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/sheet_laws.hpp"

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

/// Gives the fabric the bending of an isotropic plate: core/ply/bending.hpp.
void set_plate_bending(const IsotropicLaw& law, Fabric& fabric) {
  const double nu = law.poissons_ratio, thickness = fabric.thickness;
  fabric.plate = law.modulus * thickness * thickness / (12.0 * (1.0 - nu * nu));
  fabric.plate_coupling = nu * fabric.plate;
  fabric.twist = 2.0 * (1.0 - nu) * fabric.plate;
}

IsotropicLaw read_isotropic_constants(const TableView& section, double thickness) {
  IsotropicKeys keys{};
  read_members(section, keys);
  return {keys.youngs_modulus * thickness, keys.poissons_ratio};
}

void read_isotropic(const TableView& section, Fabric& fabric) {
  const IsotropicLaw law = read_isotropic_constants(section, fabric.thickness);
  if (text(section, "bending") == "plate") set_plate_bending(law, fabric);
  fabric.sheet = law;
}

struct SheetLawInput {
  const char* word; ///< of `law`, and of the table that its keys are in
  Rows (*rows)();
  void (*read)(const TableView& section, Fabric& fabric);
};

constexpr SheetLawInput sheet_laws[] = {{"isotropic", isotropic_rows, read_isotropic}};

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
           .members = {to(&Fabric::plate)}}});
  return rows;
}

void read_sheet_beside(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  fabric.plate_source = ValueSource::missing;
  if (!section.entry) return;
  const IsotropicLaw law = read_isotropic_constants(section, fabric.thickness);
  fabric.sheet = law;
  if (!given(section, "bending_stiffness")) return;
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

bool read_sheet(const TableView& section, Fabric& fabric) {
  for (const SheetLawInput& law : sheet_laws)
    if (text(section, "law") == law.word) {
      law.read(subsection(section, law.word), fabric);
      return true;
    }
  return false;
}

} // namespace plyform
