// SPDX-License-Identifier: GPL-3.0-or-later
// A ply that touches itself: folds pressed flat by a plate of 30 N (contact.self).
//
// A strip lies in layers that run to and fro, joined by walls one cell wide that lean by 30
// degrees. The plate lays the walls down. At rest every layer is h from the next, so that the plate
// stands at least as many thicknesses above the floor as layers overlap, the floor carries the
// plate's whole force through all of them, and no triangle crosses another. Without self-contact
// the layers fall through each other to one thickness.
#include "support/scene_checks.hpp"
#include "support/thread_checks.hpp"

#include <fmt/format.h>

namespace plyform::fold_test {
namespace {

constexpr double cell = 5.0; // mm

/// Place in the x-z plane of the material line X of a strip with folds at the lines `folds`; each
/// fold is a wall one cell wide, and the layer after it runs the other way.
Vec2 folded_place(double start, const std::vector<double>& folds, double material) {
  const double rise = cell * std::sin(std::numbers::pi / 6.0);
  const double lean = cell * std::cos(std::numbers::pi / 6.0);
  double from = start, x = start, z = 0.5 * glass_weave().thickness, way = 1.0;
  for (const double fold : folds) {
    if (material <= fold) return {x + way * (material - from), z};
    x += way * (fold - from);
    from = fold + cell;
    const double part = std::min((material - fold) / cell, 1.0);
    if (part < 1.0) return {x + part * way * lean, z + part * rise};
    x += way * lean;
    z += rise;
    way = -way;
  }
  return {x + way * (material - from), z};
}

/// The strip and the plate, ready to run.
Scene folded_strip(const std::vector<double>& folds, bool self) {
  Fabric fabric = glass_weave();
  fabric.families[0].tension.compression = fabric.families[1].tension.compression =
      460.0; // N: walls lean over, not shorten
  Case data = stack_of({0.0}, rectangle(60.0, 20.0, cell));
  data.fabrics = {fabric};
  press_by_plate(data);
  data.contact.self = self ? SelfContact::on : SelfContact::off;
  const double top = folded_place(-30.0, folds, 30.0).y() + 0.5 * fabric.thickness;
  data.tools[1].position.z() = top + 5.0;
  Scene s = make_scene(data);
  PlyBody& ply = s.plies[0];
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    const Vec2 place = folded_place(-30.0, folds, ply.x0[n].x());
    ply.x[n] = Vec3(place.x(), ply.x0[n].y(), place.y());
  }
  return s;
}

/// Height of the plate's lower face over the floor, mm.
double opening(const EndedRun& run) {
  const ToolBody& plate = run.scene.tools[1].body;
  return plate.position.z() + plate.displacement.z() - 5.0;
}

void press_fold(const std::vector<double>& folds, const char* name) {
  const double layers = static_cast<double>(folds.size()) + 1.0, h = glass_weave().thickness;
  const EndedRun run = run_on_any_threads([&] { return folded_strip(folds, true); });
  ASSERT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
  const ContactReport& contact = run.result.summary.contact;
  fmt::print(
      "{}: opening {:.3f} mm for {} layers of {} mm, floor {:.3f} N, layers {:.4f} mm deep\n", name,
      opening(run), layers, h, run.result.last.tools[0].force.z(), contact.max_ply_penetration_mm);
  EXPECT_EQ(contact.intersections_within_plies, 0);
  EXPECT_LT(run.result.last.energy.kinetic, 1e-4);
  EXPECT_NEAR(run.result.last.tools[0].force.z(), -30.0, 0.02 * 30.0);
  EXPECT_LT(contact.max_ply_penetration_mm, 0.2 * h);
  EXPECT_GT(opening(run), layers * h * 0.9);
  EXPECT_LT(std::abs(run.result.last.energy.balance_error()), 0.02);

  const EndedRun fallen = run_on_any_threads([&] { return folded_strip(folds, false); });
  EXPECT_LT(opening(fallen), 1.5 * h) << "the test must tell self-contact from none";
}

TEST(FoldScene, AStraightFoldIsTwoLayers) {
  press_fold({0.0}, "fold");
}

TEST(FoldScene, AnSFoldIsThreeLayers) {
  press_fold({-10.0, 10.0}, "S-fold");
}

} // namespace
} // namespace plyform::fold_test
