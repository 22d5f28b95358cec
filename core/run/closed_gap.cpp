// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/closed_gap.hpp"

#include "core/run/triangle_grid.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace plyform {
namespace {

constexpr double looking_at_each_other = -0.5; // cosine of their normals

/// The places where the shortest ways from a point meet both tools of a mould.
struct Room {
  Vec3 on_a, on_b;
  double gap = std::numeric_limits<double>::infinity(); ///< mm
};

class GapSearch {
public:
  GapSearch(const Scene& s, const Moulds& moulds, std::vector<PlyFrame>& plies)
      : scene_(s), plies_(plies) {
    if (!moulds.closed.empty()) moulds_ = moulds.pairs; // one half may be several tools
    grids_.resize(plies.size());
    for (std::size_t p = 0; p < plies.size(); ++p) {
      with_fibres_ = with_fibres_ && !plies[p].fibre_volume.empty();
      if (moulds_.empty() || plies.size() < 2 || !is_finite(plies[p])) continue;
      grids_[p].emplace(plies[p].x, plies[p].triangles, element_size(s.plies[p]));
    }
  }

  void fill(std::size_t p) const {
    PlyFrame& ply = plies_[p];
    const std::size_t count = ply.triangles.size();
    GapFrame& mould = ply.mould;
    for (std::vector<double>* values : {&mould.gap, &mould.left, &mould.packing})
      values->assign(count, 0.0);
    if (with_fibres_) mould.fibre_volume.assign(count, 0.0);
    if (!is_finite(ply)) return;
    for (std::size_t e = 0; e < count && !moulds_.empty(); ++e) {
      const auto [a, b, c] = ply.triangles[e];
      if (const auto room = room_at((ply.x[at(a)] + ply.x[at(b)] + ply.x[at(c)]) / 3.0))
        fill(p, e, *room);
    }
  }

private:
  static bool is_finite(const PlyFrame& ply) {
    return std::all_of(ply.x.begin(), ply.x.end(), [](const Vec3& x) { return x.allFinite(); });
  }

  /// Of the mould that leaves least there; none if it is in none.
  std::optional<Room> room_at(const Vec3& x) const {
    Room least;
    for (const Mould& mould : moulds_) {
      SurfaceHint hint_a, hint_b;
      const SurfacePoint a = distance_to_tool(scene_.tools[mould.from].body, x, hint_a),
                         b = distance_to_tool(scene_.tools[mould.to].body, x, hint_b);
      const double gap = a.distance + b.distance;
      if (!(a.normal.dot(b.normal) < looking_at_each_other) || !(gap > 0.0)) continue;
      if (gap < least.gap) least = {x - a.distance * a.normal, x - b.distance * b.normal, gap};
    }
    return std::isfinite(least.gap) ? std::optional(least) : std::nullopt;
  }

  /// mm, of triangle e of ply p at its densest packing.
  double densest(std::size_t p, std::size_t e) const {
    const PlyBody& ply = scene_.plies[p];
    const auto& compaction = ply.membrane.fabric.compaction;
    if (!compaction) return plies_[p].thickness[e];
    double ratio = 0.0;
    for (const std::int32_t n : plies_[p].triangles[e])
      ratio += ply.thickness_ratio[at(n)] / 3.0;
    return ratio * compaction->densest();
  }

  double nesting(std::size_t p) const {
    const auto& compaction = scene_.plies[p].membrane.fabric.compaction;
    return compaction ? compaction->nesting : 0.0;
  }

  void fill(std::size_t p, std::size_t e, const Room& room) const {
    // flat triangles cut into round tools: the way begins and ends a little within them
    const Vec3 more = 0.5 * scene_.plies[p].thickness * (room.on_b - room.on_a).stableNormalized();
    double thickness = 0.0, packed = 0.0, fibres = 0.0, nested = 0.0, last = 0.0;
    for (std::size_t q = 0; q < plies_.size(); ++q) {
      const std::int32_t crossed =
          q == p ? static_cast<std::int32_t>(e)
                 : (grids_[q] ? grids_[q]->crossed(room.on_a - more, room.on_b + more) : -1);
      if (crossed < 0) continue;
      const PlyFrame& ply = plies_[q];
      if (thickness > 0.0) nested += 0.5 * (last + nesting(q)); // as contact takes two plies
      last = nesting(q);
      thickness += ply.thickness[at(crossed)];
      packed += densest(q, at(crossed));
      if (with_fibres_) fibres += ply.fibre_volume[at(crossed)] * ply.thickness[at(crossed)];
    }
    GapFrame& mould = plies_[p].mould;
    mould.gap[e] = room.gap;
    mould.left[e] = room.gap - thickness;
    mould.packing[e] = (packed - nested) / room.gap;
    if (with_fibres_) mould.fibre_volume[e] = fibres / room.gap;
  }

  const Scene& scene_;
  std::vector<PlyFrame>& plies_;
  std::vector<Mould> moulds_;
  std::vector<std::optional<TriangleGrid>> grids_;
  bool with_fibres_ = true;
};

} // namespace

void add_closed_gap(const Scene& s, const Moulds& moulds, ThreadPool& pool,
                    std::vector<PlyFrame>& plies) {
  const bool gives_way = std::any_of(s.plies.begin(), s.plies.end(), [](const PlyBody& ply) {
    return ply.membrane.fabric.compaction.has_value();
  });
  if (!moulds.any || !gives_way) return;
  const GapSearch search(s, moulds, plies);
  pool.run(static_cast<int>(plies.size()), [&](int p) { search.fill(at(p)); });
}

} // namespace plyform
