// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/case_file.hpp"
#include "tools/cli/commands.hpp"

#include <fmt/format.h>

namespace plyform {

int keys_command() {
  for (const KeyInfo& k : case_keys()) {
    fmt::print("{}\n    {}", k.key, k.type);
    if (!k.unit.empty() && k.unit != "-") fmt::print(", {}", k.unit);
    const bool required = k.fallback.rfind("required", 0) == 0;
    if (!k.fallback.empty()) fmt::print("; {}{}", required ? "" : "default ", k.fallback);
    if (!k.range.empty()) fmt::print("; {}", k.range);
    fmt::print("\n    {}\n", k.meaning);
  }
  return exit_done;
}

} // namespace plyform
