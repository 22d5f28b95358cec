// SPDX-License-Identifier: GPL-3.0-or-later
// Fabric files outside a case: reading one, and inserting an identified law into one.
#pragma once

#include "base/diagnostics.hpp"
#include "core/model/fabric.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

struct FabricReading {
  std::optional<Fabric> value; ///< only when there is no error
  std::vector<CaseError> errors;
  std::vector<std::string> missing; ///< those of "warp", "weft", "shear" that have no law
  std::string text;                 ///< of the file
};

/// Reads and checks a fabric file by the rules of case files. With `laws_may_miss` the laws of
/// warp, weft and shear (not the densities) may be missing; they are then empty in the fabric and
/// named in `missing`. Never throws because of the content of the file.
FabricReading read_fabric_file(const std::filesystem::path& file, bool laws_may_miss);

/// A law as text for a fabric file.
struct LawText {
  std::string table;                ///< "warp", "weft" or "shear"
  std::string key;                  ///< "stiffness", "polynomial", "bending_stiffness" ...
  std::string value;                ///< TOML; empty: the key is taken out
  std::vector<std::string> comment; ///< lines above the key; control characters become spaces
};

/// The text of a fabric file with the law inserted, in place of the table's law if it has one. All
/// other keys and values are kept, and so are comments at the top of the file, directly above a key
/// or table and after a value; other comments and those above the replaced law are lost, and inline
/// tables get a header. Throws std::invalid_argument if `text` is not TOML.
std::string with_law(const std::string& text, const LawText& law);

} // namespace plyform
