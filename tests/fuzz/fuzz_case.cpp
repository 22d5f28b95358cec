// SPDX-License-Identifier: GPL-3.0-or-later
// A case file through all that `plyform check` does before it makes a scene: entries, keys, parts,
// meshes, checks of the scene. Refused with errors, or a case.
#include "core/setup/prepare_case.hpp"
#include "fuzz/fuzz_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plyform;
  const PreparedCase prepared =
      prepare_case(fuzz::put("case.toml", data, size), {}, CaseSize::sensible);
  if (prepared.value.has_value() != prepared.errors.empty()) std::abort();
  if (prepared.value && prepared.meshes.size() != prepared.value->plies.size()) std::abort();
  return 0;
}
