// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of boundaries in a case file: for each the word of the key `kind`, and its reader. Their
// keys are in schema_boundary.cpp and schema_attachment.cpp.
#pragma once

#include "core/input/keys/schema_check.hpp"
#include "core/model/case.hpp"

namespace plyform {

/// Words of boundary[].kind.
std::vector<std::string> boundary_words();

/// The tools of the case, and whether the names of all are known.
struct NamedTools {
  const std::vector<Tool>& tools;
  bool all_known;
};

/// Reads the kind of one [[boundary]], which gives one.
BoundaryKind read_boundary_kind(const TableView& section, const NamedTools& tools,
                                Diagnostics& diagnostics);

} // namespace plyform
