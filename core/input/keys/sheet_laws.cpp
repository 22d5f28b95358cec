// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/sheet_laws.hpp"

#include "core/input/keys/key_member.hpp"

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
             .meaning = "isotropic law of the sheet beside its yarns, of which bending is left to "
                        "the yarns: what holds bundles together, or a foil"}};
  append(rows, isotropic_constants(table));
  return rows;
}

void read_sheet_beside(const TableView& section, Fabric& fabric) {
  if (!section.entry) return;
  fabric.sheet = read_isotropic_constants(section, fabric.thickness);
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
