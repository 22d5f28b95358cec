// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/checks/mirror_images.hpp"

#include "base/format.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// Whether two directions (rad) are one line.
bool same_line(double a, double b) {
  return std::abs(std::sin(a - b)) < 1e-6;
}

/// Whether the mirror image of each direction of stitches has the same stitches. along: rad, of the
/// plane.
bool stitches_are_symmetric(const Ply& ply, const Fabric& fabric, double along) {
  const std::vector<Stitch>& all = fabric.stitches;
  return std::all_of(all.begin(), all.end(), [&](const Stitch& stitch) {
    return std::any_of(all.begin(), all.end(), [&](const Stitch& other) {
      return stitch.density == other.density && stitch.law == other.law &&
             same_line(2.0 * along - ply.angle - stitch.angle, ply.angle + other.angle);
    });
  });
}

/// Whether each crossing has the mirror image of its families and its law. image: of each family
/// the one that is its mirror image. A crossing whose families are each other's image shears as its
/// image does; any other the other way.
bool crossings_are_symmetric(const Fabric& fabric, const std::vector<std::size_t>& image) {
  const std::vector<Crossing>& all = fabric.crossings;
  return std::all_of(all.begin(), all.end(), [&](const Crossing& c) {
    const std::size_t first = image[c.first], second = image[c.second];
    if (first == c.second && second == c.first) return true;
    return c.shear.odd() && std::any_of(all.begin(), all.end(), [&](const Crossing& other) {
             return std::minmax(other.first, other.second) == std::minmax(first, second) &&
                    c.shear == other.shear;
           });
  });
}

} // namespace

std::vector<std::string> broken_by_fibres(const Ply& ply, const Fabric& fabric,
                                          const SymmetryPlane& plane) {
  std::vector<std::string> broken;
  if (!fabric.has_yarns()) return broken;
  const double along = std::atan2(plane.normal.x(), -plane.normal.y());
  if (!stitches_are_symmetric(ply, fabric, along))
    broken.emplace_back("has the stitches in other directions");
  const auto image_is_family = [&](const YarnFamily& family, const YarnFamily& other) {
    return same_line(2.0 * along - ply.angle - family.angle, ply.angle + other.angle);
  };
  const std::vector<YarnFamily>& families = fabric.families;
  std::vector<std::size_t> image; // of each family that has one
  bool own = true;                // whether each is its own
  for (std::size_t a = 0; a < families.size(); ++a) {
    std::size_t b = image_is_family(families[a], families[a]) ? a : 0;
    while (b < families.size() && !image_is_family(families[a], families[b]))
      ++b;
    if (b < families.size()) image.push_back(b);
    own = own && b == a;
  }
  if (image.size() < families.size()) {
    broken.emplace_back("has the fibres in other directions");
  } else if (!own && !balanced(fabric)) {
    std::vector<std::string> names;
    for (const YarnFamily& family : families)
      names.push_back(family.name);
    broken.push_back(fmt::format("has {} exchanged, and in fabric {} they differ",
                                 joined(names, " and "), fabric.name));
  } else if (!crossings_are_symmetric(fabric, image)) {
    broken.push_back(fmt::format("shears the other way, or at other crossings, and the laws of "
                                 "shear of fabric {} differ",
                                 fabric.name));
  }
  return broken;
}

std::pair<Fabric, double> with_families_alike(Fabric fabric) {
  double largest = 0.0;
  const auto take = [&](double& value, double as) {
    const double most = std::max(std::abs(value), std::abs(as));
    if (most > 0.0 && std::isfinite(most)) largest = std::max(largest, std::abs(value - as) / most);
    value = as;
  };
  for (YarnFamily& family : fabric.families) {
    const YarnFamily& first = fabric.families.front();
    take(family.density, first.density);
    take(family.tension.stiffness, first.tension.stiffness);
    take(family.tension.compression, first.tension.compression);
    take(family.tension.buckling_force, first.tension.buckling_force);
    take(family.bending.stiffness, first.bending.stiffness);
    take(family.in_plane_bending, first.in_plane_bending);
  }
  return {std::move(fabric), largest};
}

Difference difference_to_image(const Tool& tool, const Tool& other, const TriMesh& surface,
                               const SymmetryPlane& plane, std::size_t most) {
  const auto frame_of = [](const Tool& of, const Vec3& x) {
    return Vec3(of.rotation.transpose() * (x - of.position));
  };
  Difference largest;
  SurfaceHint hint, mirror_hint;
  const bool of_facets = std::holds_alternative<MeshShapePtr>(tool.shape); // x is on them
  const std::size_t stride = std::max<std::size_t>(1, surface.x.size() / most);
  for (std::size_t i = 0; i < surface.x.size(); i += stride) {
    const Vec3 &x = surface.x[i], image = mirrored(plane, x);
    const double own = of_facets ? 0.0 : tool_distance(tool, Vec3::Zero(), x, hint);
    const double all = std::abs(own - tool_distance(other, Vec3::Zero(), image, mirror_hint));
    if (all <= largest.beyond) continue;
    constexpr double margin = 1.5; // of an estimate
    const double facets = margin * (deflection_near(tool.shape, frame_of(tool, x)) +
                                    deflection_near(other.shape, frame_of(other, image)));
    if (all - facets > largest.beyond) largest = {all - facets, all, facets};
  }
  return largest;
}

} // namespace plyform
