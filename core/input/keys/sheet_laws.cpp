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

Rows isotropic_rows() {
  return {{.key = "fabrics.NAME.isotropic",
           .kind = K::table,
           .of = "law",
           .with = {"isotropic"},
           .meaning = "law of a sheet without yarns, which resists compression too"},
          {.key = "fabrics.NAME.isotropic.youngs_modulus",
           .unit = "N/mm2",
           .ranges = {{.least = 1e-6, .most = 1e7}},
           .usual = {{.least = 0.01, .most = 1e6}},
           .meaning = "Young's modulus, multiplied by the thickness",
           .members = {to(&IsotropicKeys::youngs_modulus)}},
          {.key = "fabrics.NAME.isotropic.poissons_ratio",
           .ranges = {{.least = 0.0, .most = 0.5}},
           .meaning = "Poisson's ratio",
           .members = {to(&IsotropicKeys::poissons_ratio)}},
          {.key = "fabrics.NAME.isotropic.bending",
           .kind = K::choice,
           .fallback = "\"none\"",
           .choices = {"none", "plate"},
           .meaning = "bending stiffness: none, a membrane; or that of a plate of this thickness"}};
}

/// Bending of an isotropic plate: core/ply/bending.hpp.
BendingLaw plate_bending(const IsotropicLaw& law, double thickness) {
  const double nu = law.poissons_ratio;
  const double d = law.modulus * thickness * thickness / (12.0 * (1.0 - nu * nu));
  BendingLaw bending;
  bending.warp.stiffness = bending.weft.stiffness = d;
  bending.coupling = nu * d;
  bending.twist = 2.0 * (1.0 - nu) * d;
  return bending;
}

void read_isotropic(const TableView& section, Fabric& fabric) {
  IsotropicKeys keys{};
  read_members(section, keys);
  const IsotropicLaw law{keys.youngs_modulus * fabric.thickness, keys.poissons_ratio};
  if (text(section, "bending") == "plate") fabric.bending = plate_bending(law, fabric.thickness);
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
  std::vector<std::string> words{"woven"};
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

bool read_sheet(const TableView& section, Fabric& fabric) {
  for (const SheetLawInput& law : sheet_laws)
    if (text(section, "law") == law.word) {
      law.read(subsection(section, law.word), fabric);
      return true;
    }
  return false;
}

} // namespace plyform
