// SPDX-License-Identifier: GPL-3.0-or-later
// What is shown of a scene of which a part is modelled (Case::part_at): the part and its mirror
// images as one, so that files, figures and pictures are those of the whole. Nodes and triangles of
// the part come first.
//
//   - Vectors and places of an image are mirrored. A family of yarns goes over into the one along
//     its mirror image, backwards if that is how it then runs; a shear angle changes its sign where
//     one of its two families runs backwards.
//   - A tool, or boundary, has the forces of all those parts of which it is an image: the sum of
//     what acts, mirrored, on those that go over into it.
//   - Energies are those of all parts.
#pragma once

#include "core/model/case.hpp"
#include "core/model/mirror.hpp"
#include "core/results/frame.hpp"

#include <vector>

namespace plyform {

class WholeFrame {
public:
  /// part: any frame of the case.
  WholeFrame(const Case& data, const Frame& part);

  /// The whole of a state of the part.
  Frame of(Frame part) const;
  Energies of(Energies part) const;
  bool is_part() const { return mirrors_.size() > 1; }
  std::size_t nodes(std::size_t ply) const { return nodes_[ply]; } ///< of the whole

private:
  /// Which of a list is the image, and which way round.
  struct Image {
    std::size_t of = 0; ///< of which it is the image
    double sign = 1.0;
  };
  /// The image of a ply.
  struct PlyImage {
    std::vector<std::int32_t> node; ///< of each node of the part: its image
    std::vector<Image> families, stitches, crossings;
  };

  PlyFrame of(const PlyFrame& part, std::size_t ply) const;
  void append_image(const PlyFrame& part, std::size_t ply, std::size_t mirror,
                    PlyFrame& whole) const;
  Image crossing_image(const Fabric& fabric, const PlyImage& image, std::size_t crossing,
                       const Mirror& mirror) const;

  std::vector<Mirror> mirrors_;
  std::vector<std::vector<PlyImage>> images_;        ///< by ply and mirror
  std::vector<std::vector<std::size_t>> tools_;      ///< by mirror: of which each tool is the image
  std::vector<std::vector<std::size_t>> boundaries_; ///< likewise
  std::vector<char> holds_;                          ///< boundaries with nodes in the part
  std::vector<std::size_t> nodes_;
};

} // namespace plyform
