// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever a test gives is held against the ranges of the keys that it is written to, by the reader
// of these keys: what no case could use is refused, what is unusual is warned of.
#pragma once

#include "tools/identify/identify_parts.hpp"

namespace plyform {

/// Reports errors and warnings that the reader of keys has of what was identified, as of the curve;
/// warnings only about the keys `items`, as "shear.polynomial".
void hold_to_keys(const std::vector<CaseError>& errors, const std::vector<std::string>& warnings,
                  const std::vector<std::string>& items, const Place& curve,
                  Diagnostics& diagnostics);
/// The base with the laws in it, held against the ranges of its keys.
std::string fabric_text(const IdentifyArguments& arguments, const FabricReading& base,
                        const std::vector<LawText>& laws, Diagnostics& diagnostics);

} // namespace plyform
