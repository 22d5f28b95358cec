// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/shapes/mesh_curvature.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <utility>

namespace plyform {
namespace {

using SideFaces = std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::int32_t, 2>>;

/// The one or two faces of each side; a third one is left out.
SideFaces faces_of_sides(const TriMesh& surface) {
  SideFaces sides;
  for (std::size_t f = 0; f < surface.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& t = surface.triangles[f];
      const auto [place, fresh] =
          sides.try_emplace(std::minmax(t[k], t[(k + 1) % 3]), std::array<std::int32_t, 2>{-1, -1});
      place->second[fresh ? 0 : 1] = static_cast<std::int32_t>(f);
    }
  return sides;
}

Vec3 face_normal(const TriMesh& s, std::size_t f) {
  const auto& [a, b, c] = s.triangles[f];
  return (s.x[at(b)] - s.x[at(a)]).cross(s.x[at(c)] - s.x[at(a)]).stableNormalized();
}

/// A corner of a face: the sides of one smooth sector at a node are those of its corners.
struct SmoothSectors {
  std::vector<std::int32_t> parent; ///< of corner 3 f + k, union-find
  std::int32_t root(std::int32_t corner) {
    while (parent[at(corner)] != corner)
      corner = parent[at(corner)] = parent[at(parent[at(corner)])];
    return corner;
  }
  void join(std::int32_t a, std::int32_t b) { parent[at(root(a))] = root(b); }
};

std::int32_t corner_of(const TriMesh& s, std::int32_t face, std::int32_t node) {
  const Triangle& t = s.triangles[at(face)];
  return 3 * face + (t[0] == node ? 0 : t[1] == node ? 1 : 2);
}

/// Fit of (2) at one sector.
struct SectorFit {
  Vec3 normal = Vec3::Zero();
  Vec3 first = Vec3::Zero(), second = Vec3::Zero(); ///< of the tangent plane
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
};

/// n . d, without what rounding of the nodes may make of nothing.
double height(const Vec3& normal, const Vec3& d, double rounding) {
  const double z = normal.dot(d);
  return std::copysign(std::max(std::abs(z) - rounding, 0.0), z);
}

/// The larger convex principal curvature, 1/mm; 0 if there is none.
double tightest(SectorFit fit) {
  // sides along few directions leave h and b of (2) nearly free: the rounder surface is taken
  constexpr double hold = 0.005; // of the weight of all sides: a cylinder is half a percent rounder
  const double weight = fit.matrix(0, 0);
  if (!(weight > 0.0)) return 0.0;
  fit.matrix(1, 1) += hold * weight;
  fit.matrix(2, 2) += hold * weight;
  const Vec3 k = fit.matrix.ldlt().solve(fit.right);
  return std::max(std::hypot(k[1], k[2]) - k[0], 0.0); // neighbours below: convex
}

/// The two largest of the values that were added.
struct LargestTwo {
  double first = 0.0, second = 0.0;
  void add(double value) {
    second = std::max(second, std::min(value, first));
    first = std::max(first, value);
  }
};

class CurvatureOfMesh {
public:
  explicit CurvatureOfMesh(const TriMesh& surface)
      : s_(surface), sides_(faces_of_sides(surface)), fits_(3 * surface.triangles.size()) {
    double largest = 0.0;
    for (const Vec3& x : s_.x)
      largest = std::max(largest, x.cwiseAbs().maxCoeff());
    constexpr double half_digit = 6e-8; // of numbers in binary STL files
    rounding_ = 2.0 * half_digit * largest;
    for (std::size_t f = 0; f < s_.triangles.size(); ++f)
      normals_.push_back(face_normal(s_, f));
    sectors_.parent.resize(fits_.size());
    for (std::size_t c = 0; c < fits_.size(); ++c)
      sectors_.parent[c] = static_cast<std::int32_t>(c);
  }

  MeshCurvature find() {
    made_.radius.assign(s_.x.size(), std::numeric_limits<double>::infinity());
    made_.deflection.assign(s_.triangles.size(), 0.0);
    for (const auto& [side, faces] : sides_)
      if (faces[1] >= 0) join_over(side, faces);
    sum_normals();
    for (const auto& [side, faces] : sides_)
      for (const std::int32_t face : faces)
        if (face >= 0) add_side(side, face, faces[1] >= 0 && smooth(faces) ? 0.5 : 1.0);
    set_radii();
    return std::move(made_);
  }

private:
  /// A node's curvature counts as far as two of its neighbours have it too: the tightest of
  /// thousands of nodes would else be the worst of all fits.
  void set_radii() {
    std::vector<double> own(s_.x.size(), 0.0);
    for (std::size_t c = 0; c < fits_.size(); ++c) {
      double& largest = own[at(s_.triangles[c / 3][c % 3])];
      largest = std::max(largest, tightest(fits_[c]));
    }
    for (const auto& [side, faces] : sides_) // one-sided sums (3) lean outwards
      if (faces[1] < 0) own[at(side.first)] = own[at(side.second)] = 0.0;
    std::vector<LargestTwo> around(s_.x.size());
    for (const auto& [side, faces] : sides_) {
      around[at(side.first)].add(own[at(side.second)]);
      around[at(side.second)].add(own[at(side.first)]);
    }
    for (std::size_t n = 0; n < own.size(); ++n)
      if (const double k = std::min(own[n], around[n].second); k > 0.0)
        made_.radius[n] = std::min(made_.radius[n], 1.0 / k);
  }

  bool smooth(const std::array<std::int32_t, 2>& faces) const {
    return normals_[at(faces[0])].dot(normals_[at(faces[1])]) >= std::cos(sharp_turn);
  }

  void join_over(const std::pair<std::int32_t, std::int32_t>& side,
                 const std::array<std::int32_t, 2>& faces) {
    if (smooth(faces)) {
      for (const std::int32_t node : {side.first, side.second})
        sectors_.join(corner_of(s_, faces[0], node), corner_of(s_, faces[1], node));
      return;
    }
    const Triangle& t = s_.triangles[at(faces[1])];
    const Vec3 middle = (s_.x[at(t[0])] + s_.x[at(t[1])] + s_.x[at(t[2])]) / 3.0;
    const bool convex = normals_[at(faces[0])].dot(middle - s_.x[at(side.first)]) < 0.0;
    if (convex) made_.radius[at(side.first)] = made_.radius[at(side.second)] = 0.0;
  }

  /// (3) of each sector.
  void sum_normals() {
    for (std::size_t f = 0; f < s_.triangles.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const Triangle& t = s_.triangles[f];
        const Vec3 u = s_.x[at(t[(k + 1) % 3])] - s_.x[at(t[k])],
                   v = s_.x[at(t[(k + 2) % 3])] - s_.x[at(t[k])];
        const auto corner = static_cast<std::int32_t>(3 * f + k);
        fits_[at(sectors_.root(corner))].normal += u.cross(v) / (u.squaredNorm() * v.squaredNorm());
      }
    for (SectorFit& fit : fits_) {
      if (fit.normal.isZero(0.0)) continue;
      fit.normal.normalize();
      fit.first = fit.normal.unitOrthogonal();
      fit.second = fit.normal.cross(fit.first);
    }
  }

  /// Adds (1) of a side to the fits at its ends, and (4) to the face.
  void add_side(const std::pair<std::int32_t, std::int32_t>& side, std::int32_t face,
                double weight) {
    const Vec3 along = s_.x[at(side.second)] - s_.x[at(side.first)];
    const double length2 = along.squaredNorm();
    double sag = 0.0;
    for (const bool from_first : {true, false}) {
      const std::int32_t node = from_first ? side.first : side.second;
      SectorFit& fit = fits_[at(sectors_.root(corner_of(s_, face, node)))];
      const Vec3 d = from_first ? along : Vec3(-along);
      const double z = height(fit.normal, d, rounding_);
      sag += 0.5 * std::abs(z) / 3.0;
      const Vec2 direction = Vec2(fit.first.dot(d), fit.second.dot(d)).stableNormalized();
      const double c = direction.x(), s = direction.y();
      const Vec3 row(1.0, c * c - s * s, 2.0 * c * s);
      fit.matrix += weight * row * row.transpose();
      fit.right += weight * row * (2.0 * z / length2);
    }
    made_.deflection[at(face)] = std::max(made_.deflection[at(face)], sag);
  }

  const TriMesh& s_;
  SideFaces sides_;
  std::vector<Vec3> normals_;
  SmoothSectors sectors_{};
  std::vector<SectorFit> fits_; ///< of a sector at its root corner
  double rounding_ = 0.0;       ///< mm
  MeshCurvature made_;
};

} // namespace

MeshCurvature mesh_curvature(const TriMesh& surface) {
  return CurvatureOfMesh(surface).find();
}

} // namespace plyform
