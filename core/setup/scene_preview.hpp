// SPDX-License-Identifier: GPL-3.0-or-later
// A case as it will stand before the first step and as its tools will move, for a picture while it
// is being written: fast, and as much of it as can be told where it has mistakes.
#pragma once

#include "core/input/keys/case_keys.hpp"
#include "core/setup/first_contact.hpp"
#include "core/setup/tool_spacings.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plyform {

/// A ply as it is laid. Without nodes if it cannot be drawn.
struct PlyPreview {
  std::string name, fabric, blank; ///< as the file has them
  double angle = 0.0;              ///< rad
  double thickness = 0.0;          ///< mm
  double coarser = 1.0; ///< its elements over those of the run; 1 but for meshes too large to draw
  std::vector<Vec3> x;  ///< mm
  std::vector<Triangle> triangles;
  std::vector<std::vector<int>> edges; ///< nodes along its edge and those of its holes, in order
  std::vector<std::pair<std::string, Vec3>> families; ///< of yarns: unit vectors along them
  std::string trouble;                                ///< why it cannot be drawn, or empty
};

/// What is known of the motion of a tool or boundary, at the times of the preview. Empty: not known
/// before the run, or not there.
struct MotionPreview {
  std::vector<double> strokes; ///< mm
  std::vector<double> forces;  ///< N, that it is pushed or pulled with
};

/// A tool at the start and on its way. Without triangles if it cannot be drawn.
struct ToolPreview {
  std::string name, shape; ///< as the file has them
  std::string motion;      ///< the word of its motion; empty: that has a mistake
  TriMesh surface;         ///< mm, in space
  Vec3 direction = -Vec3::UnitZ();
  MotionPreview moves;
  std::vector<Vec3> shifts;  ///< mm, at the times of the preview; empty if not known before the run
  std::optional<PlyGap> gap; ///< at the start
  std::optional<FirstContact> first_contact; ///< on its way, of a tool that moves
  std::string trouble;                       ///< as of a ply
};

struct BoundaryPreview {
  std::string kind;                    ///< as the file has it
  Boundary boundary;                   ///< with its name; of no use beside a trouble
  std::string ply;                     ///< its name; empty: all plies
  std::vector<std::vector<int>> nodes; ///< that it holds, of each ply
  MotionPreview moves;
  std::vector<std::array<Vec3, 4>> hinges; ///< mm, of a frame, at the times of the preview
  std::string trouble;                     ///< as of a ply
};

/// Two neighbours of the stack, of which one lies above the other.
struct PlySpacing {
  std::size_t lower = 0, upper = 0;
  double gap = 0.0; ///< mm, between their faces; below 0: they overlap
};

struct ScenePreview {
  std::string title;
  double duration = 0.0;     ///< s
  std::vector<double> times; ///< s: evenly over the duration, and the ends of all stages
  std::vector<PlyPreview> plies;
  std::vector<ToolPreview> tools;
  std::vector<BoundaryPreview> boundaries;
  std::vector<PressureLoad> loads;
  std::vector<PlySpacing> spacings;
  std::vector<ToolSpacing> tool_spacings; ///< over the times of the preview
  Vec3 gravity = Vec3::Zero();            ///< mm/s^2
  double stack_thickness = 0.0;           ///< mm, of the plies that can be drawn
  std::vector<CaseError> mistakes; ///< of the file; those of the scene are left to check_case
};

/// Reads the case and lays what can be laid of it. Never throws because of the content of files.
/// Plies get the meshes of pick_case, without sizes from the scene, of 100 000 triangles at most.
/// threads >= 1.
ScenePreview preview_scene(const std::filesystem::path& file,
                           const std::vector<Override>& overrides, int threads);

} // namespace plyform
