// SPDX-License-Identifier: GPL-3.0-or-later
// A DXF drawing as the outline of a ply. Refused with errors, or a mesh. dxflib reads it in a
// process of its own, which may end as it likes; but AddressSanitizer, which ends it without a
// message, must find nothing there.
#include "core/setup/prepare_case.hpp"
#include "fuzz/fuzz_file.hpp"
#include "fuzz/shared_counters.hpp"

#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plyform;
  static const bool shared = fuzz::share_counters();
  (void)shared;
  static const std::string text =
      "[fabrics.f]\nsurface_density = 600.0\nthickness = 0.6\nwarp = {density = 0.25, stiffness = "
      "46000.0}\nweft = {density = 0.25, stiffness = 46000.0}\nshear = {polynomial = [0.37, -0.84, "
      "1.03]}\n[blanks.b]\noutline_file = \"drawing.dxf\"\nmesh = \"free\"\nelement_size = 40.0\n"
      "[[ply]]\nname = \"p\"\nfabric = \"f\"\nblank = \"b\"\nangle = 0.0\n";
  static const auto file =
      fuzz::put("drawn.toml", reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  fuzz::put("drawing.dxf", data, size);
  const PreparedCase prepared = prepare_case(file, {}, CaseSize::sensible);
  if (prepared.value.has_value() != prepared.errors.empty()) std::abort();
  for (const CaseError& error : prepared.errors)
    if (error.rule.ends_with("cannot be read ()")) std::abort();
  if (!prepared.value) return 0;
  if (prepared.meshes.size() != 1 || prepared.meshes[0].triangles.empty()) std::abort();
  return 0;
}
