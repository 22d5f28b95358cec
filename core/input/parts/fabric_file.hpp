// SPDX-License-Identifier: GPL-3.0-or-later
// Fabric files outside a case: reading one, and inserting an identified law into one.
#pragma once

#include "base/diagnostics.hpp"
#include "core/model/fabric.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plyform {

/// A [[stitch]] of a fabric file: its name, and which stitches of the fabric it gives; of a zigzag
/// two.
struct SeamReading {
  std::string name;
  std::vector<std::size_t> stitches;
};

struct FabricReading {
  std::optional<Fabric> value; ///< only when there is no error
  std::vector<CaseError> errors;
  std::vector<std::string> warnings; ///< numbers that are unusual
  std::vector<std::string> missing;  ///< those of "warp", "weft", "shear" that have no law
  std::string text;                  ///< of the file
  bool by_families = false;          ///< whether it has [[family]] in the place of warp and weft
  std::vector<SeamReading> seams;    ///< in the order of the file
};

/// Reads and checks a fabric file by the rules of case files. With `laws_may_miss` the laws of
/// warp, weft and shear (not the densities) may be missing; they are then empty in the fabric and
/// named in `missing`. Never throws because of the content of the file.
FabricReading read_fabric_file(const std::filesystem::path& file, bool laws_may_miss);

/// Likewise of a sheet of rubber, whose law may be missing: some law then stands for it.
FabricReading read_rubber_file(const std::filesystem::path& file);

/// The same of a text that such a file is to have, called `name` in messages. `rubber`: by the
/// rules of read_rubber_file.
FabricReading read_fabric_text(const std::string& text, const std::string& name, bool rubber);

/// Errors and unusual numbers of a text with [friction.NAME] tables, as a case has them.
Diagnostics check_friction_text(const std::string& text, const std::string& name);

/// A law as text for a fabric file.
struct LawText {
  std::string table;                ///< "warp", "shear", "crossing[0]", "crossing[0].crimp"
  std::string key;                  ///< "stiffness", "polynomial", "bending_stiffness" ...
  std::string value;                ///< TOML; empty: the key is taken out
  std::vector<std::string> comment; ///< lines above the key; control characters become spaces
  /// Further keys and values of the same law, below it.
  std::vector<std::pair<std::string, std::string>> beside = {};
  std::vector<std::string> without = {}; ///< tables of the file that leave, with all in them
};

/// Where a fabric file has the laws that its short form calls warp, weft, shear and crimp: the
/// first and second [[family]] and the first [[crossing]] if it is written by families.
std::string table_of_law(const FabricReading& reading, const std::string& short_form);

/// The text of a fabric file with the law inserted, in place of the table's law if it has one. All
/// other keys and values are kept, and so are comments at the top of the file, directly above a key
/// or table and after a value; other comments and those above the replaced law are lost, and inline
/// tables and lists of tables get headers. Throws std::invalid_argument if `text` is not TOML.
std::string with_law(const std::string& text, const LawText& law);

} // namespace plyform
