// SPDX-License-Identifier: GPL-3.0-or-later
// The one rule of names: of plies, tools, boundaries, fabrics and blanks. Files, datasets and
// columns are named by them. tools/ has the same rule in Python.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace plyform {

constexpr std::size_t longest_name = 100; ///< bytes; file systems take 255, endings included

/// The rule that a name breaks, "must not ..."; empty if it breaks none: it is not empty, no longer
/// than longest_name, UTF-8 without characters that cannot be seen, without / and \, and not . or
/// ..
std::string fault_of_name(std::string_view name);

/// Of a name that is to be that of a file on any system: the same, and neither begins with a dot
/// nor holds any of : * ? " < > |
std::string fault_of_file_name(std::string_view name);

} // namespace plyform
