// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "contact/shapes/tool_shape.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace plyform {
namespace {

/// Middles of the sides that are divided in one pass: a side has the same in both its triangles.
class SideMiddles {
public:
  SideMiddles(std::vector<Vec3>& nodes, double size) : x_(nodes), size2_(size * size) {}

  /// The number of the node in the middle of the side; -1 if it is not too long.
  std::int32_t of(std::int32_t a, std::int32_t b) {
    if ((x_[at(a)] - x_[at(b)]).squaredNorm() <= size2_) return -1;
    const auto [place, fresh] =
        middles_.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(x_.size()));
    if (fresh) x_.push_back(Vec3(0.5 * (x_[at(a)] + x_[at(b)])));
    return place->second;
  }
  bool any() const { return !middles_.empty(); }

private:
  std::vector<Vec3>& x_;
  double size2_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles_{};
};

/// The pieces of a triangle of whose sides, from corner k to the next, those with a middle are
/// divided.
void append_pieces(const Triangle& t, const std::array<std::int32_t, 3>& middle,
                   std::vector<Triangle>& out) {
  const auto count = std::count_if(middle.begin(), middle.end(), [](auto m) { return m >= 0; });
  if (count == 0) return out.push_back(t);
  if (count == 3) {
    for (std::size_t k = 0; k < 3; ++k)
      out.push_back({t[k], middle[k], middle[(k + 2) % 3]});
    return out.push_back(middle);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = middle[k],
                       bc = middle[(k + 1) % 3];
    if (count == 1 && ab >= 0) {
      out.push_back({a, ab, c});
      out.push_back({ab, b, c});
    }
    if (count == 2 && ab >= 0 && bc >= 0) {
      out.push_back({ab, b, bc});
      out.push_back({a, ab, bc});
      out.push_back({a, bc, c});
    }
  }
}

} // namespace

void divide_sides(TriMesh& surface, double size) {
  if (!(size > 0.0))
    throw std::invalid_argument(
        fmt::format("the triangle size of a tool must be above 0 mm, got {:g}", size));
  constexpr std::size_t most = 1000000; // triangles: slivers may need very many
  for (bool again = true; again && surface.triangles.size() < most;) {
    SideMiddles middles(surface.x, size);
    std::vector<Triangle> pieces;
    pieces.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles)
      append_pieces(t, {middles.of(t[0], t[1]), middles.of(t[1], t[2]), middles.of(t[2], t[0])},
                    pieces);
    surface.triangles = std::move(pieces);
    again = middles.any();
  }
}

} // namespace plyform
