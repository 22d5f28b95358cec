// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of the stress table (stress_test.cpp) that need longer.
#include "support/static_bias.hpp"
#include "support/stress_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdexcept>

namespace plyform::stress_long_test {
namespace {

/// Bias test at rest with ten elements a width: load of the averaged element on shaken cells at 20
/// degrees to the yarns over the converged one of the same fabric.
std::vector<double> locking(const Fabric& fabric, double size) {
  constexpr double length = 300.0, width = 100.0;
  const std::vector<double> angles{10.0 * degree, 20.0 * degree, 30.0 * degree};
  const auto loads = [&](const StripMesh& mesh, ElementKind element) {
    return bias_loads(strip_mesh(mesh, length, width), fabric, length, width, element, angles);
  };
  const std::vector<double> converged =
      loads({MeshKind::crossed, 5.0, 0.0, 0.0}, ElementKind::plain);
  std::vector<double> found =
      loads({MeshKind::fibres, size, 25.0 * degree, 0.3}, ElementKind::averaged);
  for (std::size_t i = 0; i < found.size(); ++i)
    found[i] /= converged[i];
  return found;
}

void judge(const NamedFabric& f, double size, double most) {
  const std::vector<double> found = locking(f.fabric, size);
  fmt::print("{}, {} mm: {:.3f}, {:.3f}, {:.3f} of the converged load\n", f.name, size, found[0],
             found[1], found[2]);
  for (const double share : found)
    EXPECT_NEAR(share, 1.0, most) << f.name << ", " << size << " mm";
}

NamedFabric fabric_named(const std::string& name) {
  for (const NamedFabric& f : extreme_fabrics())
    if (f.name == name) return f;
  throw std::invalid_argument(name);
}

TEST(StressLong, StiffYarnsDoNotLock) {
  for (const char* name : {"glass", "warp 100 times the weft", "yarns 100 times as stiff"})
    judge(fabric_named(name), 10.0, 0.1);
}

TEST(StressLong, YarnsThatBearCompressionNeedAFinerMesh) {
  // Yarns that cannot slacken leave a pair of triangles less to give way with.
  const NamedFabric fabric = fabric_named("yarns that bear compression");
  judge(fabric, 10.0, 0.25);
  judge(fabric, 5.0, 0.1);
  // Bending of yarns in their plane bears a part of the load that does not lock, no more.
  NamedFabric bent{fabric.name + ", bent in their plane", fabric.fabric};
  for (YarnFamily& family : bent.fabric.families)
    family.in_plane_bending = 8.0; // N mm
  judge(bent, 10.0, 0.12);
  judge(bent, 5.0, 0.07);
}

} // namespace
} // namespace plyform::stress_long_test
