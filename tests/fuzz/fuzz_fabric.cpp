// SPDX-License-Identifier: GPL-3.0-or-later
// A fabric file, as two plies of a case name it. Refused with errors, or laws whose forces are
// finite.
#include "core/setup/prepare_case.hpp"
#include "fuzz/fuzz_file.hpp"

#include <cmath>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plyform;
  static const std::string text = "[fabrics]\nf = \"fabric.toml\"\n[blanks.b]\nsize = [20.0, "
                                  "20.0]\nelement_size = 10.0\n[[ply]]\nname = \"a\"\nfabric = "
                                  "\"f\"\nblank = \"b\"\nangle = 0.0\n[[ply]]\nname = \"c\"\n"
                                  "fabric = \"f\"\nblank = \"b\"\nangle = 45.0\n";
  static const auto file =
      fuzz::put("two.toml", reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  fuzz::put("fabric.toml", data, size);
  const PreparedCase prepared = prepare_case(file, {});
  if (prepared.value.has_value() != prepared.errors.empty()) std::abort();
  if (!prepared.value) return 0;
  const Fabric& fabric = prepared.value->fabrics[0];
  if (fabric.has_yarns())
    for (const double strain : {-0.1, 0.0, 1e-3, 0.2})
      for (const TensionLaw& law : {fabric.families[0].tension, fabric.families[1].tension})
        if (!std::isfinite(law.at(strain).value)) std::abort();
  return 0;
}
