// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/drawing/dxf_blocks.hpp"

#include "base/format.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

constexpr std::size_t most_entities = 100000;
constexpr int most_blocks_deep = 16; // blocks in blocks

struct Map {
  Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();
  Vec2 shift = Vec2::Zero();

  Vec2 operator()(const Vec2& x) const { return turn * x + shift; }
  /// Whether circles stay circles.
  bool similar() const {
    constexpr double rounding = 1e-9;
    const Vec2 u = turn.col(0), v = turn.col(1);
    const double size = u.squaredNorm() + v.squaredNorm();
    return std::abs(u.dot(v)) <= rounding * size &&
           std::abs(u.squaredNorm() - v.squaredNorm()) <= rounding * size;
  }
};

Map map_of(const DxfInsert& insert, const Vec2& base) {
  Map map;
  map.turn = Eigen::Rotation2Dd(insert.angle).toRotationMatrix() * insert.scale.asDiagonal();
  map.shift = insert.at - map.turn * base;
  if (insert.from_below) {
    map.turn.row(0) *= -1.0;
    map.shift.x() *= -1.0;
  }
  return map;
}

void move(DxfEntity& e, const Map& map) {
  const bool arcs = std::any_of(e.chain.begin(), e.chain.end(), [](const ProfileSegment& s) {
    return s.kind == ProfileSegment::Kind::arc;
  });
  if (arcs && !map.similar()) {
    e.fault = "has arcs and is in a block that is scaled by different factors";
    return;
  }
  for (ProfileSegment& s : e.chain) {
    s.a = map(s.a), s.b = map(s.b), s.centre = map(s.centre);
    if (map.turn.determinant() < 0.0) s.turn = -s.turn;
  }
  if (e.curve) e.curve->at = [at = e.curve->at, map](double t) -> Vec2 { return map(at(t)); };
}

/// Why an insertion cannot be resolved; empty if it can.
std::string fault_of(const DxfInsert& insert, const DxfBlocks& blocks, int depth) {
  if (!blocks.contains(lower_case(insert.block)))
    return fmt::format("names the block {}, which is not there", shown(insert.block));
  if (insert.array) return "repeats a block in rows or columns";
  if (insert.scale.x() == 0.0 || insert.scale.y() == 0.0) return "has a scale of 0";
  if (depth > most_blocks_deep) return fmt::format("is a block {} blocks deep", depth);
  return {};
}

struct Exploder {
  const DxfBlocks& blocks;
  std::vector<DxfEntity> all{};
  std::size_t visited = 0; ///< insertions of empty blocks too

  void append(const DxfEntity& e, int depth);
};

void Exploder::append(const DxfEntity& e, int depth) {
  if (++visited > most_entities)
    throw std::runtime_error(fmt::format("has more than {} entities, those of inserted blocks "
                                         "among them; save the outline alone",
                                         most_entities));
  if (!e.insert || !e.fault.empty()) return all.push_back(e);
  if (std::string fault = fault_of(*e.insert, blocks, depth); !fault.empty()) {
    all.push_back(e);
    all.back().fault = std::move(fault);
    return;
  }
  const DxfBlock& block = blocks.at(lower_case(e.insert->block));
  const Map map = map_of(*e.insert, block.base);
  const std::size_t first = all.size();
  for (const DxfEntity& inner : block.entities)
    append(inner, depth + 1);
  for (std::size_t i = first; i < all.size(); ++i) {
    if (all[i].layer == "0") all[i].layer = e.layer;
    if (all[i].fault.empty()) move(all[i], map);
  }
}

} // namespace

std::vector<DxfEntity> exploded(const std::vector<DxfEntity>& entities, const DxfBlocks& blocks) {
  Exploder exploder{blocks};
  for (const DxfEntity& e : entities)
    exploder.append(e, 1);
  return std::move(exploder.all);
}

} // namespace plyform
