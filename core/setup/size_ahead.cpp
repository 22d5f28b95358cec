// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/size_ahead.hpp"

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/step.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sys/resource.h>
#include <unistd.h>

namespace plyform {
namespace {

// Measured on one core with five plies (README) and on 25 000 triangles and more; of few triangles
// what a step takes beside them, on plies of 200.
constexpr double seconds_a_triangle = 2e-7, seconds_a_step = 1e-5;
constexpr double day = 86400.0; // s

} // namespace

double steps_ahead(const Case& data, const Ply& ply, double size) {
  constexpr double elements_a_step = 0.7; // of cases/hemisphere_0, holds to a factor of two or so
  const Fabric& fabric = data.fabrics[ply.fabric];
  if (!fabric.has_yarns() || !(size > 0.0)) return 0.0;
  double stiffness = 0.0; // N/mm
  for (const YarnFamily& family : fabric.families)
    stiffness = std::max(stiffness, family.tension.largest_slope() * family.density /
                                        data.solver.fibre_softening);
  const double speed = std::sqrt(stiffness / fabric.surface_density);
  return data.solver.duration * speed / (elements_a_step * size);
}

SizeAhead size_ahead(const Case& data, int threads) {
  SizeAhead size;
  double most = 0.0;
  for (const Ply& ply : data.plies) {
    const double triangles = expected_triangles(data.blanks[ply.blank]);
    size.triangles += triangles;
    if (triangles > most) most = triangles, size.largest = ply.blank;
    size.steps =
        std::max(size.steps, steps_ahead(data, ply, smallest_wanted(data.blanks[at(ply.blank)])));
  }
  size.bytes = bytes_for(data, size.triangles);
  size.seconds = seconds_a_triangle * size.triangles * size.steps / std::max(threads, 1);
  return size;
}

namespace {

/// The least height of a triangle.
double least_height(const BlankMesh& mesh, const Triangle& t) {
  const Vec2 u = mesh.x[at(t[1])] - mesh.x[at(t[0])], v = mesh.x[at(t[2])] - mesh.x[at(t[0])];
  const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
  return std::abs(u.x() * v.y() - u.y() * v.x()) / longest;
}

/// Steps at the one that the scene begins with.
double steps_of_scene(const Case& data, const std::vector<BlankMesh>& meshes, int threads) {
  Scene scene = make_scene(data, meshes, threads);
  ThreadPool pool(threads);
  start(scene, pool);
  return data.solver.duration / scene.next_dt;
}

} // namespace

SizeAhead size_of_meshes(const Case& data, const std::vector<BlankMesh>& meshes, int threads) {
  constexpr double square = std::numbers::sqrt2; // its side over the height of its halves
  SizeAhead size;
  std::size_t most = 0;
  for (std::size_t p = 0; p < meshes.size(); ++p) {
    const BlankMesh& mesh = meshes[p];
    size.triangles += static_cast<double>(mesh.triangles.size());
    if (mesh.triangles.size() > most)
      most = mesh.triangles.size(), size.largest = data.plies[p].blank;
    for (const Triangle& t : mesh.triangles) {
      const double height = least_height(mesh, t);
      if (size.smallest > 0.0 && height >= size.smallest) continue;
      size.smallest = height, size.where = mesh.x[at(t[0])], size.ply = p;
    }
    size.steps = std::max(size.steps, steps_ahead(data, data.plies[p], square * size.smallest));
  }
  size.bytes = bytes_for(data, size.triangles);
  const auto seconds = [&] {
    return std::max(seconds_a_triangle * size.triangles / std::max(threads, 1), seconds_a_step) *
           size.steps;
  };
  size.seconds = seconds();
  if (size.seconds <= day) return size;
  size.steps = steps_of_scene(data, meshes, threads);
  size.seconds = seconds();
  return size;
}

double bytes_for(const Case& data, double triangles) {
  // at the peak of whole runs of eleven shipped cases, within a factor of 1.2
  constexpr double own = 3.6e7, a_triangle = 3072.0, a_facet = 1100.0;
  double facets = 0.0;
  for (const Tool& tool : data.tools)
    facets += static_cast<double>(facet_count(tool.shape));
  return own + a_triangle * triangles + a_facet * facets;
}

double machine_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  double memory =
      pages > 0 && page > 0 ? static_cast<double>(pages) * static_cast<double>(page) : 4e9;
  if (rlimit of{}; getrlimit(RLIMIT_AS, &of) == 0 && of.rlim_cur != RLIM_INFINITY)
    memory = std::min(memory, static_cast<double>(of.rlim_cur));
  for (const char* file :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    double limit = 0.0; // "max" where there is none
    if (std::ifstream(file) >> limit && limit > 0.0) memory = std::min(memory, limit);
  }
  return memory;
}

bool too_large(const SizeAhead& size, double memory) {
  return size.bytes > 0.5 * memory || size.seconds > day;
}

} // namespace plyform
