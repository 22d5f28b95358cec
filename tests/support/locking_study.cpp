// SPDX-License-Identifier: GPL-3.0-or-later
// How far a mesh whose sides do not follow the yarns falsifies the load of a bias-extension test,
// at rest, strip of 300 x 100 mm of the glass weave: one row of CSV a mesh, element and size.
//   locking_study angles     sizes w/10 and w/20, cells at 0 to 45 degrees to the yarns
//   locking_study sizes      four sizes, four angles
//   locking_study signs      a law of shear ten times stiffer where the angle closes, pulled both
//                            ways: w/10 and w/20, four angles
#include "core/mesh/mesh_blank.hpp"
#include "support/static_bias.hpp"

#include <cstdio>
#include <cstring>

using namespace plyform;

namespace {

constexpr double length = 300.0, width = 100.0;
const std::vector<double> angles{10.0 * degree, 20.0 * degree, 30.0 * degree};

/// A fabric and how it is pulled: warp (rad) to the pull.
struct Specimen {
  Fabric fabric = glass_weave();
  double warp = 45.0 * degree;
};

std::vector<double> converged_loads(const Specimen& of) {
  return bias_loads(strip_mesh({MeshKind::crossed, 5.0, 0.0, 0.0}, length, width), of.fabric,
                    length, width, ElementKind::plain, angles, 1e-10, of.warp);
}

void row(const Specimen& of, const StripMesh& spec, double yarns_to_cells, ElementKind element,
         const std::vector<double>& converged) {
  const BlankMesh mesh = strip_mesh(spec, length, width);
  std::vector<double> loads(angles.size(), std::nan(""));
  try {
    // locked meshes, full of slack yarns, come to rest slowly: 1e-6 is enough for a factor
    const double accuracy = element == ElementKind::plain ? 1e-6 : 1e-10;
    loads = bias_loads(mesh, of.fabric, length, width, element, angles, accuracy, of.warp);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  std::printf("%s,%s,%g,%g,%zu", spec.kind == MeshKind::free ? "free" : "shaken",
              element == ElementKind::plain ? "plain" : "averaged", width / spec.size,
              yarns_to_cells, mesh.triangles.size());
  for (std::size_t i = 0; i < loads.size(); ++i)
    std::printf(",%.4f", loads[i] / converged[i]);
  std::printf("\n");
  std::fflush(stdout);
}

/// Both ways: first the stiff one, then the soft one.
void both_ways() {
  for (const double warp : {-45.0 * degree, 45.0 * degree}) {
    const Specimen of{two_sided_weave(), warp};
    const std::vector<double> converged = converged_loads(of);
    for (const double n : {10.0, 20.0})
      for (const MeshKind kind : {MeshKind::fibres, MeshKind::free})
        for (int turn = 0; turn <= 45; turn += 15)
          row(of, {kind, width / n, (45.0 - turn) * degree, kind == MeshKind::free ? 0.0 : 0.3},
              turn, ElementKind::averaged, converged);
  }
}

} // namespace

int main(int count, char** arguments) {
  const bool sizes = count > 1 && !std::strcmp(arguments[1], "sizes"),
             signs = count > 1 && !std::strcmp(arguments[1], "signs");
  std::printf(
      "mesh,element,elements_a_width,yarns_to_cells_deg,triangles,load_10,load_20,load_30\n");
  if (signs) return both_ways(), 0;
  const Specimen weave;
  const std::vector<double> converged = converged_loads(weave);
  for (const ElementKind element : {ElementKind::plain, ElementKind::averaged})
    for (const MeshKind kind : {MeshKind::fibres, MeshKind::free})
      for (const double n : sizes ? std::vector{5.0, 10.0, 20.0, 40.0} : std::vector{10.0, 20.0})
        for (int turn = 0; turn <= 45; turn += sizes ? 15 : 5)
          row(weave, {kind, width / n, (45.0 - turn) * degree, kind == MeshKind::free ? 0.0 : 0.3},
              turn, element, converged);
}
