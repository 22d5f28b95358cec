// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/whole_frame.hpp"

#include "core/model/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace plyform {
namespace {

Vec3 along(double angle_deg) {
  return {std::cos(angle_deg * degree), std::sin(angle_deg * degree), 0.0};
}

/// Which of the directions `all` (degrees from x) goes over into the line of `one`, and the sign of
/// its image along it.
template <class Frames, class Found>
void find_image(const Mirror& mirror, const Frames& all, std::size_t one, Found& found) {
  double most = -1.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double same = mirror.direction(along(all[k].angle_deg)).dot(along(all[one].angle_deg));
    if (std::abs(same) > most + 1e-9) most = std::abs(same), found = {k, same < 0.0 ? -1.0 : 1.0};
  }
}

/// Appends those of an image to the values of a part.
void append(std::vector<double>& whole, const std::vector<double>& part, double sign = 1.0) {
  for (const double value : part)
    whole.push_back(sign * value);
}
void append(std::vector<Vec3>& whole, const std::vector<Vec3>& part, const Mirror& mirror,
            double sign) {
  for (const Vec3& value : part)
    whole.push_back(sign * mirror.direction(value));
}

void append_family(FamilyFrame& whole, const FamilyFrame& part, const Mirror& mirror, double sign) {
  append(whole.direction, part.direction, mirror, sign);
  append(whole.strain, part.strain);
  append(whole.tension, part.tension);
  append(whole.opening, part.opening);
}

/// Of which each of a list is the image at all planes of a mirror, by those at each plane.
std::vector<std::size_t> images_of(const Case& data, unsigned planes, std::size_t count,
                                   std::vector<int> PartPlane::*at_plane) {
  std::vector<std::size_t> of(count);
  for (std::size_t i = 0; i < count; ++i) {
    of[i] = i;
    for (std::size_t k = 0; k < data.part_at.size(); ++k)
      if (planes >> k & 1U) of[i] = at((data.part_at[k].*at_plane)[of[i]]);
  }
  return of;
}

/// The planes that a node before forming lies on, as bits.
unsigned planes_at(const Case& data, const Vec3& x0) {
  unsigned on = 0;
  for (std::size_t k = 0; k < data.part_at.size(); ++k)
    if (lies_on(data.part_at[k].plane, x0.head<2>())) on |= 1U << k;
  return on;
}

} // namespace

WholeFrame::WholeFrame(const Case& data, const Frame& part) {
  std::vector<SymmetryPlane> planes;
  for (const PartPlane& at : data.part_at)
    planes.push_back(at.plane);
  mirrors_ = images_at(planes);
  if (!is_part()) return;
  for (const Mirror& mirror : mirrors_) {
    tools_.push_back(images_of(data, mirror.planes, part.tools.size(), &PartPlane::tools));
    boundaries_.push_back(
        images_of(data, mirror.planes, part.boundaries.size(), &PartPlane::boundaries));
  }
  for (std::size_t b = 0; b < part.boundaries.size(); ++b) {
    bool any = false;
    for (std::size_t p = 0; p < part.plies.size(); ++p)
      for (const Vec3& x : part.plies[p].x0)
        any = any || plyform::holds(data.boundaries[b], static_cast<int>(p), x.head<2>());
    holds_.push_back(any);
  }
  for (std::size_t p = 0; p < part.plies.size(); ++p) {
    const PlyFrame& ply = part.plies[p];
    std::vector<PlyImage>& images = images_.emplace_back();
    std::map<std::pair<std::size_t, unsigned>, std::int32_t> numbers;
    auto next = static_cast<std::int32_t>(ply.x0.size());
    for (const Mirror& mirror : mirrors_) {
      PlyImage& image = images.emplace_back();
      for (std::size_t n = 0; n < ply.x0.size(); ++n) {
        const unsigned beyond = mirror.planes & ~planes_at(data, ply.x0[n]);
        if (beyond == 0)
          image.node.push_back(static_cast<std::int32_t>(n));
        else if (const auto [found, is_new] = numbers.try_emplace({n, beyond}, next); is_new)
          image.node.push_back(next++);
        else
          image.node.push_back(found->second);
      }
      image.families.resize(ply.families.size()), image.stitches.resize(ply.stitches.size());
      for (std::size_t a = 0; a < ply.families.size(); ++a)
        find_image(mirror, ply.families, a, image.families[a]);
      for (std::size_t i = 0; i < ply.stitches.size(); ++i)
        find_image(mirror, ply.stitches, i, image.stitches[i]);
      const Fabric& fabric = data.fabrics[at(data.plies[p].fabric)];
      for (std::size_t c = 0; c < ply.crossings.size() + 1; ++c)
        image.crossings.push_back(crossing_image(fabric, image, c, mirror));
    }
    nodes_.push_back(at(next));
  }
}

WholeFrame::Image WholeFrame::crossing_image(const Fabric& fabric, const PlyImage& image,
                                             std::size_t crossing, const Mirror& mirror) const {
  // of a single family, or none: the angle of the sheet to the line across
  if (fabric.crossings.empty() || image.families.size() < 2)
    return {crossing, mirror.turns_round() ? -1.0 : 1.0};
  const Crossing& own = fabric.crossings[crossing];
  const Image &first = image.families[own.first], &second = image.families[own.second];
  for (std::size_t c = 0; c < fabric.crossings.size(); ++c)
    if (const Crossing& other = fabric.crossings[c];
        std::minmax(other.first, other.second) == std::minmax(first.of, second.of))
      return {c, first.sign * second.sign};
  return {crossing, 1.0};
}

void WholeFrame::append_image(const PlyFrame& part, std::size_t ply, std::size_t number,
                              PlyFrame& whole) const {
  const Mirror& mirror = mirrors_[number];
  const PlyImage& image = images_[ply][number];
  // nodes
  std::vector<std::size_t> fresh; // nodes of the part whose images are new
  for (std::size_t n = 0; n < image.node.size(); ++n)
    if (at(image.node[n]) == whole.x.size() + fresh.size()) fresh.push_back(n);
  for (const std::size_t n : fresh) {
    whole.x0.push_back(mirror.place(part.x0[n])), whole.x.push_back(mirror.place(part.x[n]));
    if (!part.reaction.empty()) whole.reaction.emplace_back(Vec3::Zero());
    if (!part.pushed.empty()) whole.pushed.push_back(mirror.direction(part.pushed[n]));
    for (auto of : {&PlyFrame::contact_pressure, &PlyFrame::wrinkle_height, &PlyFrame::temperature,
                    &PlyFrame::bridging_height})
      if (!(part.*of).empty()) (whole.*of).push_back((part.*of)[n]);
  }
  for (std::size_t n = 0; n < part.reaction.size(); ++n)
    whole.reaction[at(image.node[n])] += mirror.direction(part.reaction[n]);
  // triangles
  for (const Triangle& t : part.triangles) {
    Triangle& of = whole.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      of[k] = image.node[at(t[k])];
    if (mirror.turns_round()) std::swap(of[1], of[2]);
  }
  for (std::size_t a = 0; a < part.families.size(); ++a)
    append_family(whole.families[a], part.families[image.families[a].of], mirror,
                  image.families[a].sign);
  for (std::size_t i = 0; i < part.stitches.size(); ++i) {
    const StitchFrame& of = part.stitches[image.stitches[i].of];
    append_family(whole.stitches[i], of, mirror, image.stitches[i].sign);
    append(whole.stitches[i].broken, of.broken);
  }
  for (std::size_t c = 0; c < image.crossings.size(); ++c) {
    const Image& of = image.crossings[c];
    append(c == 0 ? whole.shear_deg : whole.crossings[c - 1].shear_deg,
           of.of == 0 ? part.shear_deg : part.crossings[of.of - 1].shear_deg, of.sign);
  }
  const double first = image.crossings.front().sign;
  append(whole.shear_rate, part.shear_rate, first);
  append(whole.viscous_shear, part.viscous_shear, first);
  for (auto of : {&PlyFrame::thickness, &PlyFrame::areal_weight, &PlyFrame::fibre_volume,
                  &PlyFrame::largest_rate})
    append(whole.*of, part.*of);
  for (auto of : {&GapFrame::gap, &GapFrame::left, &GapFrame::packing, &GapFrame::fibre_volume})
    append(whole.mould.*of, part.mould.*of);
  for (std::size_t k = 0; k < 2; ++k)
    append(whole.stretch[k], part.stretch[k]);
}

PlyFrame WholeFrame::of(const PlyFrame& part, std::size_t ply) const {
  PlyFrame whole = part;
  for (std::size_t i = 1; i < mirrors_.size(); ++i)
    append_image(part, ply, i, whole);
  return whole;
}

Energies WholeFrame::of(Energies part) const {
  const auto count = static_cast<double>(mirrors_.size());
  for (const EnergyTerm& term : energy_terms)
    part.*term.value *= count;
  part.floor *= count;
  return part;
}

Frame WholeFrame::of(Frame part) const {
  if (!is_part()) return part;
  Frame whole = part;
  whole.energy = of(part.energy);
  for (std::size_t p = 0; p < part.plies.size(); ++p)
    whole.plies[p] = of(part.plies[p], p);
  for (std::size_t t = 0; t < part.tools.size(); ++t) {
    ToolFrame& tool = whole.tools[t];
    tool.force = Vec3::Zero(), tool.force_N = tool.force_raw_N = 0.0;
    for (std::size_t i = 0; i < mirrors_.size(); ++i) {
      const ToolFrame& of = part.tools[tools_[i][t]];
      tool.force += mirrors_[i].direction(of.force);
      tool.force_N += of.force_N, tool.force_raw_N += of.force_raw_N;
    }
  }
  for (std::size_t b = 0; b < part.boundaries.size(); ++b) {
    BoundaryFrame& boundary = whole.boundaries[b];
    boundary.force = Vec3::Zero(), boundary.force_N = 0.0;
    for (std::size_t i = 0; i < mirrors_.size(); ++i) {
      const std::size_t from = boundaries_[i][b];
      if (!holds_[from]) continue;
      const BoundaryFrame& of = part.boundaries[from];
      boundary.force += mirrors_[i].direction(of.force);
      boundary.force_N += of.force_N, boundary.stroke_mm = of.stroke_mm;
    }
  }
  return whole;
}

} // namespace plyform
