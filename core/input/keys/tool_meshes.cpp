// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/tool_meshes.hpp"

#include "base/thread_pool.hpp"
#include "core/input/keys/overrides.hpp"
#include "core/input/keys/tool_mesh_cache.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <system_error>
#include <vector>

namespace plyform {

ToolMeshes::ToolMeshes(const TableView& root, const std::filesystem::path& folder)
    : folder_(folder) {
  using Load = std::pair<const Key, Loaded>;
  std::vector<Load*> loads;
  for (const TableView& tool : subsections(root, "tool"))
    if (const auto key = key_of(tool, folder)) {
      const auto [place, fresh] = meshes_.try_emplace(*key);
      if (fresh) loads.push_back(&*place);
    }
  const auto bytes = [](const Load* load) { // 0 of a file that is not there
    std::error_code none;
    const std::uintmax_t size = std::filesystem::file_size(load->first.first, none);
    return none ? 0 : size;
  };
  std::stable_sort(loads.begin(), loads.end(), // the longest first
                   [&](const Load* a, const Load* b) { return bytes(a) > bytes(b); });
  const int count = static_cast<int>(loads.size());
  ThreadPool pool(std::clamp(count, 1, available_cores()));
  pool.run(count, [&](int i) {
    auto& [key, loaded] = *loads[static_cast<std::size_t>(i)];
    try {
      loaded.mesh = cached_tool_mesh(key.first, key.second);
    } catch (...) {
      loaded.error = std::current_exception();
    }
  });
}

MeshShapePtr ToolMeshes::of(const TableView& tool) const {
  const auto key = key_of(tool, folder_);
  if (!key) return nullptr;
  const Loaded& loaded = meshes_.at(*key);
  if (loaded.error) std::rethrow_exception(loaded.error);
  return loaded.mesh;
}

std::optional<ToolMeshes::Key> ToolMeshes::key_of(const TableView& tool,
                                                  const std::filesystem::path& folder) {
  if (text(tool, "shape") != "mesh") return std::nullopt;
  const TomlNode* file = given(tool, "file");
  const double scale = number(tool, "scale");
  if (!file || std::isnan(scale)) return std::nullopt;
  return Key(resolve_path(*file, folder).lexically_normal(), scale);
}

} // namespace plyform
