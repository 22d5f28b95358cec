// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh file as a tool, with distances to it, and as a blank. Refused with std::runtime_error, or
// sound.
#include "contact/shapes/tool_shape.hpp"
#include "core/mesh/mesh_blank.hpp"
#include "fuzz/fuzz_file.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace plyform::fuzz {
extern const char* const mesh_format; // mesh_format.cpp
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plyform;
  const auto file = fuzz::put(("mesh." + std::string(fuzz::mesh_format)).c_str(), data, size);
  try {
    const ToolShape tool = load_tool_mesh(file, 1.0, nullptr);
    SurfaceHint hint;
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 2, 3), Vec3(-1e3, 5, 1e-9)})
      if (!std::isfinite(signed_distance(tool, p, hint).distance)) std::abort();
  } catch (const std::runtime_error&) {
  }
  try {
    BlankSpec blank;
    blank.mesh = MeshKind::file;
    blank.file = file;
    if (mesh_blank(blank, 0.0, 1.5).triangles.empty()) std::abort();
  } catch (const std::runtime_error&) {
  }
  return 0;
}
