// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/tool_mesh_cache.hpp"

#include "contact/shapes/mesh_shape.hpp"

#include <algorithm>
#include <array>
#include <list>
#include <mutex>
#include <optional>
#include <sys/stat.h>

namespace plyform {
namespace {

/// What changes when a file is written or put in the place of another.
using FileState = std::array<std::int64_t, 6>;

std::optional<FileState> state_of(const std::filesystem::path& file) {
  struct stat s {};
  if (stat(file.c_str(), &s) != 0) return std::nullopt;
  return FileState{static_cast<std::int64_t>(s.st_ino),
                   s.st_size,
                   s.st_mtim.tv_sec,
                   s.st_mtim.tv_nsec,
                   s.st_ctim.tv_sec,
                   s.st_ctim.tv_nsec};
}

struct KeptMesh {
  std::filesystem::path file;
  double scale;
  FileState state;
  MeshShapePtr mesh;
};

class MeshCache {
public:
  void set_limit(std::size_t facets) {
    const std::lock_guard lock(guard_);
    limit_ = facets;
    drop_old();
  }

  MeshShapePtr find(const std::filesystem::path& file, double scale, const FileState& state) {
    const std::lock_guard lock(guard_);
    const auto it = std::find_if(kept_.begin(), kept_.end(), [&](const KeptMesh& kept) {
      return kept.file == file && kept.scale == scale;
    });
    if (it == kept_.end()) return nullptr;
    if (it->state != state) {
      kept_.erase(it);
      return nullptr;
    }
    kept_.splice(kept_.begin(), kept_, it);
    return it->mesh;
  }

  void keep(KeptMesh mesh) {
    const std::lock_guard lock(guard_);
    if (limit_ == 0) return;
    kept_.push_front(std::move(mesh));
    drop_old();
  }

private:
  void drop_old() {
    std::size_t facets = 0;
    auto it = kept_.begin();
    for (; it != kept_.end(); ++it)
      if ((facets += it->mesh->surface().triangles.size()) > limit_) break;
    kept_.erase(it, kept_.end());
  }

  std::mutex guard_;
  std::size_t limit_ = 0;
  std::list<KeptMesh> kept_; ///< the one used last first
};

MeshCache& cache() {
  static MeshCache meshes;
  return meshes;
}

} // namespace

void keep_tool_meshes(std::size_t facets) {
  cache().set_limit(facets);
}

MeshShapePtr cached_tool_mesh(const std::filesystem::path& file, double scale) {
  const std::optional<FileState> before = state_of(file);
  if (before)
    if (MeshShapePtr mesh = cache().find(file, scale, *before)) return mesh;
  MeshShapePtr mesh = load_tool_mesh(file, scale, nullptr);
  // one that changed while it was read is read again the next time
  if (before && state_of(file) == before) cache().keep({file, scale, *before, mesh});
  return mesh;
}

} // namespace plyform
