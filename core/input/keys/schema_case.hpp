// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the table of keys (core/input/keys/schema.hpp). Internal to core/input.
#pragma once

#include "core/input/keys/schema.hpp"
#include "core/input/keys/schema_check.hpp"
#include "core/model/case.hpp"
#include "core/model/usual_ranges.hpp"

#include <vector>

namespace plyform {

using Rows = std::vector<KeyRow>;

// Ranges of numbers: far beyond any use, and narrow enough for every sum to stay finite and for
// every mesh of a tool to stay within the memory. Lengths are in mm, to 100 m.
inline const Range length_range{.least = 1e-6, .most = 1e5};
inline const Range length_or_zero{.least = 0.0, .most = 1e5};
inline const Range place_range{.least = -1e5, .most = 1e5};
inline const Range direction_range{.least = -1e9, .most = 1e9};
inline const Range stroke_or_zero{.least = 0.0, .most = 1e5};
inline const Range force_range{.least = 0.0, .most = 1e9}; ///< N
inline const Range programme_share{.least = 0.0, .most = 1.0, .open_least = true};
inline const Range bending_range{.least = 0.0, .most = 1e7};    ///< N mm
inline const Range yarn_force_range{.least = 0.0, .most = 1e9}; ///< N a yarn, per strain or not
inline const Range stiffness_range{.least = 1e-6, .most = 1e9}; ///< N a yarn, of a law that has any

/// The range that messages call usual.
inline Range range_of(const UsualRange& usual) {
  return {.least = usual.least, .most = usual.most};
}

inline void append(Rows& all, Rows part) {
  for (KeyRow& row : part)
    all.push_back(std::move(row));
}

/// core/input/keys/schema_bending.cpp: keys of the yarns ("warp") in a table and of the fabric.
Rows yarn_bending_rows(const std::string& table, const std::string& yarn);
Rows sheet_rows();

/// core/input/keys/schema_fabric.cpp: fabrics.NAME and fabric files.
Rows fabric_rows();

/// core/input/keys/schema_blank.cpp: blanks.NAME.
Rows blank_rows();

/// core/input/keys/schema_tool.cpp: [[tool]], and its motion. Shapes:
/// core/input/keys/tool_shapes.cpp.
Rows tool_rows();
Rows shape_rows();
Rows motion_rows();

/// A part of a case that has a file of its own with its rows and its reader, which is called when
/// fabrics, plies, tools and boundaries are read, and may have what it needs of other parts, which
/// is asked when all parts are read and have no mistakes. The list:
/// core/input/keys/schema_case.cpp.
struct FurtherPart {
  Rows (*rows)();
  void (*read)(const TableView& root, Case& built, Diagnostics& diagnostics);
  void (*check)(const TableView& root, const Case& built, Diagnostics& diagnostics) = nullptr;
};
void read_further_parts(const TableView& root, Case& built, Diagnostics& diagnostics);
/// The one place from which parts are asked what they need of each other: of parts with mistakes
/// nothing follows, and nothing is there to be asked.
void check_further_parts(const TableView& root, const Case& built, Diagnostics& diagnostics);

/// core/input/keys/process_clock.cpp: the clock of the process.
Rows process_rows();
void read_process(const TableView& root, Case& built, Diagnostics& diagnostics);
void check_process(const TableView& root, const Case& built, Diagnostics& diagnostics);
/// Reports a fabric whose laws have rates, as `rated` says, without process.duration; warns of one
/// that does nothing.
void check_clock(const TableView& root, const Case& built, bool (*rated)(const Fabric&),
                 Diagnostics& diagnostics);

/// core/input/keys/friction_laws.cpp: friction.NAME.
Rows friction_law_rows();
/// Those of a case, by their names.
std::vector<FrictionLawPtr> read_friction_laws(const TableView& root, Diagnostics& diagnostics);

/// core/input/keys/loads.cpp: [[load]].
Rows load_rows();
void read_loads(const TableView& root, Case& built, Diagnostics& diagnostics);

/// core/input/keys/schema_boundary.cpp: [[boundary]]; and the keys of its springs and grippers,
/// core/input/keys/schema_attachment.cpp.
Rows boundary_rows();
Rows attachment_rows();

} // namespace plyform
