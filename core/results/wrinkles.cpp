// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/wrinkles.hpp"

#include "base/node_normals.hpp"
#include "contact/forces/tool_ply.hpp"
#include "core/results/way_to_tool.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace plyform {
namespace {

constexpr double shortest_half = 1.5; // elements: three per wave; shorter waves are mesh artefacts
constexpr double longest_half = 4.0;  // elements, at least, for coarse meshes
constexpr double longest_half_mm = 30.0; // waves of dry cloth under a holder are 20 to 60 mm long
constexpr double half_growth = 1.2;      // from one s to the next; between them H loses 3 % at most
constexpr double near_waves = 2.0;       // s: tools nearer than that may have a wave's shape
constexpr double facing = std::numbers::sqrt2 / 2.0; // cosine of 45 degrees

double mean_side(const PlyFrame& ply) {
  double sum = 0.0;
  for (const Triangle& t : ply.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sum += (ply.x0[at(t[k])] - ply.x0[at(t[(k + 1) % 3])]).norm();
  return sum / (3.0 * static_cast<double>(ply.triangles.size()));
}

/// A point of the formed ply, located by its position in the undeformed one.
struct Place {
  Vec3 x = Vec3::Zero(), normal = Vec3::Zero();
  std::size_t triangle = 0;
  bool inside = false;        ///< whether the ply covers this point
  double height = 0.0;        ///< mm, the largest H found here; 0 of less than least_wrinkle
  Vec3 pushed = Vec3::Zero(); ///< mean of PlyFrame::pushed
};

/// Places on a square grid of the undeformed ply whose rows run along the warp.
class Grid {
public:
  Grid(const PlyFrame& ply, const std::vector<const ToolBody*>& tools, double step)
      : step_(step), ply_(ply), tools_(tools), normals_(area_normals(ply.x, ply.triangles)) {
    for (Vec3& n : normals_)
      n.stableNormalize();
    const double angle = -ply.angle_deg * degree;
    for (const Vec3& x : ply.x0)
      flat_.push_back(Eigen::Rotation2Dd(angle) * x.head<2>());
    low_ = flat_.front();
    Vec2 high = low_;
    for (const Vec2& x : flat_)
      low_ = low_.cwiseMin(x), high = high.cwiseMax(x);
    columns_ = static_cast<int>((high.x() - low_.x()) / step) + 1;
    rows_.resize(static_cast<std::size_t>((high.y() - low_.y()) / step) + 1);
    // The remainder is divided between both sides, so that rounding puts no column onto the border.
    low_ += 0.5 * (high - low_ - step * Vec2(columns_ - 1, rows() - 1));
    make_rows();
    for (std::size_t t = 0; t < ply.triangles.size(); ++t)
      fill(t);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (int k = 0; k < 3; ++k) {
      const auto number = [](const Place& p, const Vec3& of, int i) {
        return p.inside ? of[i] : none;
      };
      x_[at(k)].resize(static_cast<Eigen::Index>(places_.size())), n_[at(k)] = x_[at(k)];
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const Place& p = places_[i];
        x_[at(k)][static_cast<Eigen::Index>(i)] = number(p, p.x, k);
        n_[at(k)][static_cast<Eigen::Index>(i)] = number(p, p.normal, k);
      }
    }
  }

  int rows() const { return static_cast<int>(rows_.size()); }
  double step() const { return step_; }
  /// A place of the grid; null where the ply does not cover it.
  Place* find(int i, int j) {
    if (j < 0 || j >= rows() || !rows_[at(j)].has(i)) return nullptr;
    Place& p = places_[index(i, j)];
    return p.inside ? &p : nullptr;
  }

  /// Columns from first on, before last.
  struct Columns {
    int first = 0, last = 0;
    bool has(int i) const { return i >= first && i < last; }
  };

  /// |D_0| (mm) at the places of row j of lines whose points are (di, dj) apart, for the columns
  /// that may have all three; NaN where the ply does not cover them.
  const Eigen::ArrayXd& bends(int j, int di, int dj, Columns& columns) {
    const Row &before = rows_[at(j - dj)], &row = rows_[at(j)], &after = rows_[at(j + dj)];
    columns = {std::max({row.first, before.first + di, after.first - di}),
               std::min({row.last, before.last + di, after.last - di})};
    const Eigen::Index count = std::max(0, columns.last - columns.first);
    bends_.setZero(count);
    if (count == 0) return bends_;
    const auto place = [&](int i, int in_row) {
      return static_cast<Eigen::Index>(index(i, in_row));
    };
    const Eigen::Index here = place(columns.first, j), back = place(columns.first - di, j - dj),
                       on = place(columns.first + di, j + dj);
    const auto bend = [&](std::size_t k) {
      const auto x = [&](Eigen::Index from) { return x_[k].segment(from, count); };
      return n_[k].segment(here, count) * (x(here) - 0.5 * (x(back) + x(on)));
    };
    bends_ = (bend(0) + bend(1) + bend(2)).abs();
    return bends_;
  }

  const std::vector<const ToolBody*>& tools() const { return tools_; }
  /// Where the surface of a tool is nearest to a place: lines in all directions ask for it.
  const SurfacePoint& nearest(std::size_t tool, const Place& place) {
    const auto number = static_cast<std::size_t>(&place - places_.data());
    if (nearest_.empty()) nearest_.resize(tools_.size() * places_.size());
    std::optional<SurfacePoint>& known = nearest_[tool * places_.size() + number];
    if (!known) {
      SurfaceHint hint;
      known = distance_to_tool(*tools_[tool], place.x, hint);
    }
    return *known;
  }

  /// The heights at the nodes of the triangles that the places are in.
  std::vector<double> heights_at_nodes() const {
    std::vector<double> heights(ply_.x.size(), 0.0);
    for (const Place& p : places_)
      if (p.height > 0.0)
        for (const std::int32_t node : ply_.triangles[p.triangle])
          heights[at(node)] = std::max(heights[at(node)], p.height);
    return heights;
  }

private:
  /// The places that a row has: of a strip across its fibres the box is mostly empty.
  struct Row : Columns {
    std::size_t begin = 0; ///< of its places
  };

  std::size_t index(int i, int j) const {
    return rows_[at(j)].begin + static_cast<std::size_t>(i - rows_[at(j)].first);
  }

  /// Columns and rows of the grid in the box of a triangle.
  std::pair<Columns, Columns> box_of(std::size_t triangle) const {
    const Triangle& t = ply_.triangles[triangle];
    const Vec2 &a = flat_[at(t[0])], &b = flat_[at(t[1])], &c = flat_[at(t[2])];
    const Vec2 from = (a.cwiseMin(b).cwiseMin(c) - low_) / step_,
               to = (a.cwiseMax(b).cwiseMax(c) - low_) / step_;
    const auto range = [](double least, double most, int count) {
      return Columns{std::max(0, static_cast<int>(std::ceil(least))),
                     std::min(count, static_cast<int>(std::floor(most)) + 1)};
    };
    return {range(from.x(), to.x(), columns_), range(from.y(), to.y(), rows())};
  }

  void make_rows() {
    for (Row& row : rows_)
      row.first = columns_;
    for (std::size_t t = 0; t < ply_.triangles.size(); ++t) {
      const auto [columns, in_rows] = box_of(t);
      for (int j = in_rows.first; j < in_rows.last && columns.first < columns.last; ++j) {
        rows_[at(j)].first = std::min(rows_[at(j)].first, columns.first);
        rows_[at(j)].last = std::max(rows_[at(j)].last, columns.last);
      }
    }
    std::size_t places = 0;
    for (Row& row : rows_) {
      row.begin = places;
      row.first = std::min(row.first, row.last);
      places += static_cast<std::size_t>(row.last - row.first);
    }
    places_.resize(places);
  }

  /// (2)
  Place place(std::size_t triangle, const Vec3& w) const {
    const Triangle& t = ply_.triangles[triangle];
    Vec3 p = Vec3::Zero(), q = Vec3::Zero(), n = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      p += w[static_cast<int>(k)] * ply_.x[at(t[k])];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& normal = normals_[at(t[k])];
      q += w[static_cast<int>(k)] * (p - normal.dot(p - ply_.x[at(t[k])]) * normal);
      n += w[static_cast<int>(k)] * normal;
    }
    Place found{0.5 * (p + q), n.stableNormalized(), triangle, true};
    if (!ply_.pushed.empty())
      for (std::size_t k = 0; k < 3; ++k)
        found.pushed += w[static_cast<int>(k)] * ply_.pushed[at(t[k])];
    return found;
  }

  void fill(std::size_t triangle) {
    const Triangle& t = ply_.triangles[triangle];
    const Vec2 &a = flat_[at(t[0])], &b = flat_[at(t[1])], &c = flat_[at(t[2])];
    const auto cross = [](const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x(); };
    const double whole = cross(b - a, c - a);
    const auto [columns, in_rows] = box_of(triangle);
    for (int j = in_rows.first; j < in_rows.last; ++j)
      for (int i = columns.first; i < columns.last; ++i) {
        const Vec2 p = low_ + step_ * Vec2(i, j);
        const double wb = cross(p - a, c - a) / whole, wc = cross(b - a, p - a) / whole;
        // tolerance of a weight, so that points on a side are found
        constexpr double rounding = 1e-9;
        if (std::min({1.0 - wb - wc, wb, wc}) < -rounding) continue;
        places_[index(i, j)] = place(triangle, {1.0 - wb - wc, wb, wc});
      }
  }

  double step_;
  const PlyFrame& ply_;
  const std::vector<const ToolBody*>& tools_;
  std::vector<std::optional<SurfacePoint>>
      nearest_; ///< places of the first tool, of the second ...
  std::vector<Vec3> normals_;
  std::vector<Vec2> flat_;
  Vec2 low_;
  int columns_ = 0;
  std::vector<Row> rows_;
  std::vector<Place> places_;
  std::array<Eigen::ArrayXd, 3> x_, n_; ///< of the places, by coordinate; NaN outside the ply
  Eigen::ArrayXd bends_;
};

using Line = std::array<Place*, 5>;

/// (1) from D_-1, D_0, D_1
double height(double before, double here, double after) {
  if (before * here >= 0.0 || after * here >= 0.0) return 0.0;
  return std::min({std::abs(here), 2.0 * std::abs(before), 2.0 * std::abs(after)});
}

/// D at the place k of a line
double bend(const Line& line, std::size_t k) {
  return line[k]->normal.dot(line[k]->x - 0.5 * (line[k - 1]->x + line[k + 1]->x));
}

/// The smallest H of the distances from the tools that face the ply; infinite if none does.
double height_above_tools(Grid& grid, const Line& line, double half_wave) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t tool = 0; tool < grid.tools().size(); ++tool) {
    const SurfacePoint& nearest = grid.nearest(tool, *line[2]);
    if (std::abs(nearest.distance) > half_wave ||
        std::abs(nearest.normal.dot(line[2]->normal)) < facing)
      continue;
    std::array<double, 5> f{};
    for (std::size_t k = 0; k < 5; ++k)
      f[k] = grid.nearest(tool, *line[k]).distance;
    const auto d = [&](std::size_t k) { return f[k] - 0.5 * (f[k - 1] + f[k + 1]); };
    least = std::min(least, height(d(1), d(2), d(3)));
  }
  return least;
}

/// (3): T_k of one tool at the place k of a line, mm; 0 if the tool is not near or does not face
/// it.
double height_of_tool(Grid& grid, const Line& line, std::size_t k, std::size_t tool,
                      double half_wave) {
  const Vec3 &x = line[k]->x, &n = line[k]->normal;
  const SurfacePoint& nearest = grid.nearest(tool, *line[k]);
  const double faces = nearest.normal.dot(n);
  if (std::abs(nearest.distance) > near_waves * half_wave || std::abs(faces) < facing) return 0.0;
  const Vec3 towards = faces > 0.0 ? Vec3(-n) : n; // from the ply to the tool
  std::array<double, 3> z{};
  for (std::size_t j = 0; j < 3; ++j) {
    const Vec3& p = line[k + j - 1]->x;
    z[j] = n.dot(p - x) + n.dot(towards) * way_to_tool(*grid.tools()[tool], p, towards,
                                                       2.0 * near_waves * half_wave);
  }
  return std::isfinite(z[1]) ? z[1] - 0.5 * (z[0] + z[2]) : 0.0;
}

/// Whether a bend (mm) is that of a ply blown or sucked into a hollow, which its tension bears.
bool is_hollow(const Place& place, double bend) {
  constexpr double most = 0.5; // of the way from a node that is held up to one that is not
  return place.pushed.dot(place.normal) * (bend > 0.0 ? 1.0 : -1.0) > most;
}

/// (3): the share of a wave that is the tools' own or hangs in their hollows, 0 to 1.
double share_of_tools(Grid& grid, const Line& line, double half_wave) {
  double share = 1.0;
  for (std::size_t k = 1; k <= 3 && share > 0.0; ++k) {
    const double d = bend(line, k);
    if (is_hollow(*line[k], d)) continue;
    double most = 0.0;
    for (std::size_t tool = 0; tool < grid.tools().size(); ++tool)
      most = std::max(most, height_of_tool(grid, line, k, tool, half_wave) / d);
    share = std::min(share, most);
  }
  return share;
}

/// Updates the heights of places, and `best` with the highest wrinkle, of all lines whose points
/// are (di, dj) grid steps apart.
void search_along(Grid& grid, int di, int dj, Wrinkle& best) {
  const double half_wave = grid.step() * std::hypot(di, dj);
  const int above = 2 * std::abs(dj); // a line reaches so far
  Grid::Columns columns;
  constexpr double rounding = 1e-9;
  for (int j = above; j < grid.rows() - above; ++j) {
    const Eigen::ArrayXd& bends = grid.bends(j, di, dj, columns);
    const double least = (1.0 - rounding) * std::min(best.height, least_wrinkle);
    for (int i = columns.first; i < columns.last; ++i) {
      if (!(bends[i - columns.first] >= least)) continue; // most lines end here: H is at most this
      Line line{};
      const auto have = [&](int k) {
        return (line[at(k + 2)] = grid.find(i + k * di, j + k * dj)) != nullptr;
      };
      if (!have(0) || !have(-1) || !have(1)) continue;
      double& here = line[2]->height;
      const double needed = std::min(best.height, std::max(here, least_wrinkle));
      const double middle = bend(line, 2);
      if (std::abs(middle) <= needed || !have(-2) || !have(2)) continue;
      double found = height(bend(line, 1), middle, bend(line, 3));
      if (found <= needed) continue;
      found = std::min(found, height_above_tools(grid, line, half_wave));
      if (found > needed) found *= 1.0 - share_of_tools(grid, line, half_wave);
      if (found > best.height) best = {found, 2.0 * half_wave, line[2]->x};
      if (found >= least_wrinkle) here = std::max(here, found);
    }
  }
}

/// The highest wrinkle of all four directions at about this half wavelength, mm.
Wrinkle search_at(Grid& grid, double half_wave, Wrinkle best) {
  const double steps = half_wave / grid.step();
  const int straight = static_cast<int>(std::lround(steps));
  const int slanted = static_cast<int>(std::lround(steps / std::numbers::sqrt2));
  search_along(grid, straight, 0, best);
  search_along(grid, 0, straight, best);
  search_along(grid, slanted, slanted, best);
  search_along(grid, slanted, -slanted, best);
  return best;
}

} // namespace

Wrinkles wrinkles_of(const PlyFrame& ply, const std::vector<const ToolBody*>& tools, double from) {
  Wrinkles result{{}, std::vector<double>(ply.x.size(), 0.0)};
  Wrinkle& best = result.highest;
  best.height = from;
  if (ply.triangles.empty()) return result;
  for (const Vec3& x : ply.x)
    if (!x.allFinite()) return result;
  const double side = mean_side(ply);
  Grid grid(ply, tools, 0.5 * side);
  const double longest = std::max(longest_half * side, longest_half_mm);
  // A wave is nearly as high along oblique lines or with a slightly wrong wavelength: the
  // wavelength reported is the shortest one at which it has at least 95 % of its height.
  double length_of = 0.0; // mm, height at which the wavelength and the position were found
  for (double half = shortest_half * side; half <= longest; half *= half_growth) {
    const Wrinkle found = search_at(grid, half, best);
    best.height = found.height;
    if (found.height > length_of / 0.95) best = found, length_of = found.height;
  }
  result.at_nodes = grid.heights_at_nodes();
  return result;
}

} // namespace plyform
