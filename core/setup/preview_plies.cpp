// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/preview_plies.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/keys/schema.hpp"
#include "core/mesh/mesh_ply.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <tuple>

namespace plyform {
namespace {

constexpr double most_triangles = 1e5; // of a ply

/// What a ply's mesh depends on.
using MeshKey = std::tuple<int, double, int, double, double, double>;

MeshKey mesh_key(const Case& data, const Ply& ply) {
  const bool by_angle = data.blanks[static_cast<std::size_t>(ply.blank)].mesh == MeshKind::fibres;
  return {ply.blank,
          by_angle ? ply.angle : 0.0,
          by_angle ? ply.fabric : 0,
          ply.seed.x(),
          ply.seed.y(),
          ply.rotation};
}

struct LaidMesh {
  FlatPly flat;
  std::vector<std::vector<int>> edges;
  double coarser = 1.0;
  std::string trouble;
};

/// Closed chains of the sides that one triangle has, in the order of their first node.
std::vector<std::vector<int>> edges_of(const BlankMesh& mesh) {
  std::vector<std::pair<int, int>> sides;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      sides.emplace_back(t[i], t[(i + 1) % 3]);
  std::sort(sides.begin(), sides.end());
  std::multimap<int, int> next;
  for (const auto& [a, b] : sides)
    if (!std::binary_search(sides.begin(), sides.end(), std::pair(b, a))) next.emplace(a, b);
  std::vector<std::vector<int>> edges;
  while (!next.empty()) {
    std::vector<int>& edge = edges.emplace_back();
    for (auto it = next.begin(); it != next.end(); it = next.find(edge.back())) {
      if (edge.empty()) edge.push_back(it->first);
      const int to = it->second;
      next.erase(it);
      if (to == edge.front()) break;
      edge.push_back(to);
    }
  }
  return edges;
}

/// mesh_ply with larger elements where they would be too many to draw.
BlankMesh mesh_to_draw(const Case& data, const Ply& ply, double& coarser) {
  const auto number = static_cast<std::size_t>(ply.blank);
  const double expected = expected_triangles(data.blanks[number]);
  if (!(expected > most_triangles)) return mesh_ply(data, ply);
  coarser = std::sqrt(expected / most_triangles);
  Case drawn;
  drawn.fabrics = data.fabrics;
  drawn.tools = data.tools;
  drawn.blanks = {data.blanks[number]};
  scale_elements(drawn.blanks[0], coarser);
  Ply alone = ply;
  alone.blank = 0;
  return mesh_ply(drawn, alone);
}

LaidMesh lay(const Case& data, const Ply& ply) {
  LaidMesh laid;
  try {
    BlankMesh mesh = mesh_to_draw(data, ply, laid.coarser);
    laid.edges = edges_of(mesh);
    laid.flat = make_flat_ply(std::move(mesh), 0.0, 0.0);
  } catch (const std::exception& error) {
    laid.trouble = error.what();
  }
  return laid;
}

std::vector<std::string> fabric_mistakes(const Case& data, const CaseReading& reading,
                                         const Ply& ply) {
  return reading.sketch.mistaken_keys("fabrics." +
                                      data.fabrics[static_cast<std::size_t>(ply.fabric)].name);
}

/// What mistakes keep a ply from being drawn, or nothing.
std::string mistakes_of(const Case& data, const CaseReading& reading, std::size_t number) {
  const Ply& ply = data.plies[number];
  std::vector<std::string> keys = reading.sketch.mistaken_keys(fmt::format("ply.{}", number));
  std::erase_if(keys, [](const std::string& key) {
    return key == "name" || (!key.empty() && pattern_of("ply[]", key).empty());
  });
  if (!keys.empty()) return trouble_with(keys);
  const auto fabric = static_cast<std::size_t>(ply.fabric),
             blank = static_cast<std::size_t>(ply.blank);
  if (fabric >= data.fabrics.size() || blank >= data.blanks.size())
    return "has no fabric or no blank";
  if (number < reading.words.ply_blanks.size())
    if (std::vector<std::string> wrong =
            reading.sketch.mistaken_keys("blanks." + reading.words.ply_blanks[number]);
        !wrong.empty())
      return "its blank " + trouble_with(std::move(wrong));
  std::vector<std::string> wrong = fabric_mistakes(data, reading, ply);
  const bool mesh_needs_yarns = data.blanks[blank].mesh == MeshKind::fibres;
  if (!mesh_needs_yarns)
    std::erase_if(wrong, [](const std::string& key) { return !key.empty() && key != "thickness"; });
  if (!wrong.empty()) return "its fabric " + trouble_with(std::move(wrong));
  const double thickness = data.fabrics[fabric].thickness;
  if (!(thickness > 0.0) || !std::isfinite(thickness + ply.z + ply.angle + ply.rotation) ||
      !ply.seed.allFinite())
    return "lies nowhere: what is below it has mistakes";
  return {};
}

void add_families(const Case& data, const Ply& ply, PlyPreview& seen) {
  for (const YarnFamily& family : data.fabrics[static_cast<std::size_t>(ply.fabric)].families) {
    const double angle = ply.angle + family.angle;
    seen.families.emplace_back(family.name, Vec3(std::cos(angle), std::sin(angle), 0.0));
  }
}

} // namespace

std::string trouble_with(std::vector<std::string> keys) {
  std::erase(keys, "");
  return keys.empty() ? "has mistakes" : "has mistakes: " + joined(keys);
}

LaidPlies lay_plies(const Case& data, const CaseReading& reading, ThreadPool& pool) {
  LaidPlies laid;
  std::map<MeshKey, std::pair<const Ply*, LaidMesh>> meshes;
  for (std::size_t i = 0; i < data.plies.size(); ++i) {
    PlyPreview& seen = laid.plies.emplace_back();
    seen.trouble = mistakes_of(data, reading, i);
    if (seen.trouble.empty())
      meshes.try_emplace(mesh_key(data, data.plies[i]), &data.plies[i], LaidMesh{});
  }
  std::vector<std::pair<const Ply*, LaidMesh>*> tasks;
  for (auto& [key, task] : meshes)
    tasks.push_back(&task);
  pool.run(static_cast<int>(tasks.size()), [&](int i) {
    auto& [ply, mesh] = *tasks[static_cast<std::size_t>(i)];
    mesh = lay(data, *ply);
  });
  for (std::size_t i = 0; i < data.plies.size(); ++i) {
    const Ply& ply = data.plies[i];
    PlyPreview& seen = laid.plies[i];
    seen.name = ply.name;
    if (i < reading.words.ply_fabrics.size()) seen.fabric = reading.words.ply_fabrics[i];
    if (i < reading.words.ply_blanks.size()) seen.blank = reading.words.ply_blanks[i];
    seen.angle = ply.angle;
    if (!seen.trouble.empty()) continue;
    const LaidMesh& mesh = meshes.at(mesh_key(data, ply)).second;
    seen.trouble = mesh.trouble;
    if (!seen.trouble.empty()) continue;
    seen.thickness = data.fabrics[static_cast<std::size_t>(ply.fabric)].thickness;
    seen.coarser = mesh.coarser;
    for (const Vec2& x : mesh.flat.mesh.x)
      seen.x.emplace_back(x.x(), x.y(), ply.z);
    seen.triangles = mesh.flat.mesh.triangles;
    seen.edges = mesh.edges;
    if (fabric_mistakes(data, reading, ply).empty()) add_families(data, ply, seen);
    FlatPly flat = mesh.flat;
    flat.z = ply.z;
    flat.half = 0.5 * seen.thickness;
    laid.flat.push_back(std::move(flat));
    laid.number.push_back(i);
  }
  return laid;
}

} // namespace plyform
