// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/scene_mesh.hpp"

#include "base/format.hpp"
#include "core/accuracy/error_model.hpp"
#include "core/mesh/mesh_ply.hpp"
#include "core/results/checkpoint_file.hpp"
#include "core/setup/kept_sizes.hpp"
#include "core/setup/size_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace plyform {
namespace {

// Degrees: the error of the mesh that is aimed at where none is asked for, that of --accuracy
// standard.
constexpr double usual_error = 1.0;

const BlankSpec& blank_of(const Case& data, std::size_t ply) {
  return data.blanks[at(data.plies[ply].blank)];
}

double error_of_mesh(const Case& data) {
  const double asked = data.accuracy.shear_error / degree;
  return mesh_share(asked > 0.0 ? asked : usual_error);
}

/// Takes a ply's sizes from those of a run before.
SizeGrid sizes_of_before(const std::vector<PlySizes>& before, const std::string& ply,
                         const std::filesystem::path& path) {
  const auto found = std::find_if(before.begin(), before.end(),
                                  [&](const PlySizes& sizes) { return sizes.ply == ply; });
  if (found == before.end())
    throw std::runtime_error(fmt::format("{} has no sizes of a ply \"{}\"; give the folder of a "
                                         "run of the same plies",
                                         path.string(), ply));
  return found->sizes;
}

/// The sizes that were kept from before, or a scout's; nothing if neither may be.
std::optional<Scouted> look_for_sizes(const PreparedCase& prepared, int threads,
                                      const MeshRequest& request) {
  const Case& data = *prepared.value;
  if (request.kept)
    if (auto kept = kept_sizes(prepared.identity, data.plies.size())) return kept;
  if (!request.scouts) return std::nullopt;
  Scouted found = scout(data, error_of_mesh(data), threads, request.scout);
  if (!found.fault.empty())
    throw ScoutStopped("the run with coarse elements that looks where small ones are "
                       "needed (mesh_from = \"scene\") did not go to its end: " +
                       found.fault + "; give zones by hand instead");
  if (request.kept) keep_sizes(prepared.identity, found);
  return found;
}

/// Finds the sizes of every ply that asks for some.
SceneMesh find_sizes(const PreparedCase& prepared, int threads, const MeshRequest& request) {
  const Case& data = *prepared.value;
  SceneMesh found;
  std::optional<Scouted> scouted;
  std::map<std::filesystem::path, std::vector<PlySizes>> before; // each file is read once
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    const std::string& from = blank_of(data, p).mesh_from;
    if (from.empty()) continue;
    const std::filesystem::path path =
        from == mesh_from_scene_word ? request.known : std::filesystem::path(from);
    if (!path.empty()) {
      if (!before.contains(path)) before[path] = read_sizes(path);
      found.sizes.push_back(
          {data.plies[p].name, sizes_of_before(before[path], data.plies[p].name, path)});
      continue;
    }
    if (!scouted) scouted = look_for_sizes(prepared, threads, request);
    if (!scouted) {
      found.sizes.clear();
      found.unknown = true;
      return found;
    }
    found.sizes.push_back({data.plies[p].name, scouted->sizes[p]});
  }
  if (scouted) {
    found.scouted = scouted->work > 0.0;
    found.kept = !found.scouted;
    found.scout_work = scouted->work;
    found.scout_seconds = scouted->seconds;
    if (!scouted->ended.empty()) found.warnings.push_back(scouted->ended);
  }
  return found;
}

/// Reports what is wrong with the sizes of the first blank that asks for some.
void report(PreparedCase& prepared, const std::string& message) {
  const std::vector<BlankSpec>& blanks = prepared.value->blanks;
  const auto first = std::find_if(blanks.begin(), blanks.end(),
                                  [](const BlankSpec& blank) { return !blank.mesh_from.empty(); });
  const SourceLocation& place =
      prepared.parts.blanks[static_cast<std::size_t>(first - blanks.begin())];
  Diagnostics told;
  told.error_from(place.at, place.item + ".mesh_from", first->mesh_from, "", message);
  prepared.errors.push_back(std::move(told.errors.front()));
  prepared.value.reset();
}

/// Gives each of these plies a blank of its own with its sizes, and a mesh of it.
void give_sizes(PreparedCase& prepared, const std::vector<PlySizes>& sizes) {
  Case& data = *prepared.value;
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    const auto found = std::find_if(sizes.begin(), sizes.end(), [&](const PlySizes& of) {
      return of.ply == data.plies[p].name;
    });
    if (found == sizes.end()) continue;
    set_sizes(data, p, found->sizes);
    prepared.meshes[p] = mesh_ply(data, data.plies[p]);
  }
}

void measure(const PreparedCase& prepared, SceneMesh& found) {
  found.smallest = std::numeric_limits<double>::infinity();
  for (const BlankMesh& mesh : prepared.meshes) {
    found.triangles += static_cast<double>(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
      const Vec2 u = mesh.x[at(t[1])] - mesh.x[at(t[0])], v = mesh.x[at(t[2])] - mesh.x[at(t[0])];
      const double size = std::sqrt(std::abs(u.x() * v.y() - u.y() * v.x()));
      found.smallest = std::min(found.smallest, size);
      found.largest = std::max(found.largest, size);
    }
  }
}

} // namespace

SceneMesh mesh_from_scene(PreparedCase& prepared, int threads, const MeshRequest& request) {
  const Case& data = *prepared.value;
  bool asked = false;
  for (std::size_t p = 0; p < data.plies.size(); ++p)
    asked = asked || !blank_of(data, p).mesh_from.empty();
  if (!asked || data.accuracy.instant) return {};
  SceneMesh found;
  try {
    found = find_sizes(prepared, threads, request);
  } catch (const ScoutStopped&) {
    throw;
  } catch (const std::runtime_error& error) {
    if (!request.known.empty()) throw; // not what the case says
    report(prepared, error.what());
    return {};
  }
  if (found.unknown) return found;
  give_sizes(prepared, found.sizes);
  check_meshes(prepared);
  if (!prepared.value) return found;
  measure(prepared, found);
  prepared.identity += fmt::format("mesh sizes: {:016x}\n", checkpoint_sum(text_of(found.sizes)));
  prepared.notes.push_back(
      fmt::format("mesh from the scene: {:.0f} triangles, elements of {:.3g} to {:.3g} mm",
                  found.triangles, found.smallest, found.largest));
  if (std::string missed = missed_accuracy(data); !missed.empty()) found.warnings.push_back(missed);
  return found;
}

} // namespace plyform
