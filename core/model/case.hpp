// SPDX-License-Identifier: GPL-3.0-or-later
// A case as plain data: plies, tools, boundaries and solver options. Units: mm, N, s, t, rad.
// Filled by read_case (core/input/case_file.hpp), turned into a Scene by make_scene
// (core/solver/scene.hpp).
#pragma once

#include "contact/shapes/tool_shape.hpp"
#include "core/model/blank_spec.hpp"
#include "core/model/fabric.hpp"
#include "core/model/friction.hpp"
#include "core/model/temperature.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace plyform {

/// One ply of the stack. Plies are listed from the bottom up.
struct Ply {
  std::string name;
  int fabric = 0;           ///< index into Case::fabrics
  int blank = 0;            ///< index into Case::blanks
  double angle = 0.0;       ///< rad, from x to warp, about +z
  double z = 0.0;           ///< mm, height of the mid-surface at the start
  Vec2 seed = Vec2::Zero(); ///< mm, where the blank's origin lies
  double rotation = 0.0;    ///< rad, of the blank about its origin, about +z; not of the yarns
  std::optional<double> temperature = std::nullopt; ///< degC, at the start; else that of the case
};

enum class Motion {
  fixed,  ///< stays
  driven, ///< moves along `direction` over the duration: core/model/motion.hpp
  force,  ///< pushed by `force` along `direction`, free to move along it only
};

/// One stage of the programme of a tool or boundary: by this share of the duration it has reached
/// this stroke (mm) or force (N).
struct Stage {
  double share = 1.0, value = 0.0;
  bool operator==(const Stage&) const = default;
};

struct Tool {
  std::string name;
  ToolShape shape;
  Vec3 position = Vec3::Zero();                           ///< mm, of the tool frame's origin
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< tool frame to space
  Motion motion = Motion::fixed;
  Vec3 direction = -Vec3::UnitZ(); ///< unit vector
  double stroke = 0.0;             ///< mm, for Motion::driven; the largest of a programme
  double force = 0.0;              ///< N, for Motion::force; likewise
  std::vector<Stage> programme;    ///< in order of time; empty: one stage over the duration
  double mass = 0.0;               ///< t, for Motion::force
  /// degC over the time of the process; empty: that of the case
  std::vector<TemperatureStage> temperature;
};

/// Nodes of the undeformed plies that a boundary holds: on a line, or in a box.
struct HeldPlace {
  bool on_edge = false;
  /// mm, ends of the line, corners of the box
  std::array<Vec2, 2> ends = {Vec2::Zero(), Vec2::Zero()};
};

/// Rigid: all its nodes move by one displacement.
struct Grip {
  HeldPlace place;
  std::array<bool, 3> held = {{true, true, true}}; ///< prescribed along x, y, z; else free
  Vec3 direction = Vec3::UnitX();                  ///< unit vector
  double stroke = 0.0;                             ///< mm; the largest of a programme
  std::vector<Stage> programme;                    ///< in order of time; empty: one stage
};

/// Four bars hinged at their ends, pulled along a diagonal.
struct HingedFrame {
  /// mm, in order; the first is fixed, the third moves away from it
  std::array<Vec2, 4> hinges = {Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  double stroke = 0.0;          ///< mm, along the diagonal; the largest of a programme
  std::vector<Stage> programme; ///< as of a grip
};

/// A vertical plane.
struct SymmetryPlane {
  Vec2 point = Vec2::Zero(), normal = Vec2::UnitX(); ///< mm; unit vector
  bool operator==(const SymmetryPlane&) const = default;
};

/// A tension spring from its nodes to an anchor.
struct TensionSpring {
  HeldPlace place;
  double stiffness = 0.0;               ///< N/mm
  Vec3 anchor = Vec3::Zero();           ///< mm
  int carrier = -1;                     ///< index into Case::tools that takes the anchor along
  double preload = 0.0;                 ///< N, at the start
  std::optional<double> natural_length; ///< mm; else from the preload
  double max_force = std::numeric_limits<double>::infinity(); ///< N
};

/// Clamps its nodes to one piece, and pulls it, by a force or a drive.
struct Gripper {
  HeldPlace place;
  Vec3 direction = Vec3::UnitX(); ///< unit vector
  double stiffness = 0.0;         ///< N/mm, of the drive; 0: pulled by a force
  double stroke = 0.0;            ///< mm, of the drive; the largest of a programme
  double force = 0.0;             ///< N; likewise
  std::vector<Stage> programme;   ///< of stroke or force, as of a grip
  double mass = 0.0;              ///< t
  bool guided = false;            ///< whether it moves along its direction only
};

using BoundaryKind = std::variant<Grip, HingedFrame, SymmetryPlane, TensionSpring, Gripper>;

/// Nodes whose motion is prescribed (core/model/boundary.hpp), or that springs and grippers pull
/// (core/model/attachment.hpp), selected in the undeformed plies.
struct Boundary {
  std::string name;
  int ply = -1; ///< index into Case::plies; -1: all
  BoundaryKind kind;

  template <class Kind>
  bool is() const {
    return std::holds_alternative<Kind>(kind);
  }
  /// Throws std::bad_variant_access unless it is of that kind.
  template <class Kind>
  const Kind& as() const {
    return std::get<Kind>(kind);
  }
  template <class Kind>
  Kind& as() {
    return std::get<Kind>(kind);
  }
};

/// Which face of a ply: that which is up at the start, or the other.
enum class PlyFace { above, below };

/// A pressure on a face of a ply. It stays normal to the surface as that deforms, and pushes
/// against it.
struct PressureLoad {
  int ply = 0; ///< index into Case::plies
  PlyFace side = PlyFace::above;
  double pressure = 0.0;        ///< N/mm^2; the largest of a programme
  std::vector<Stage> programme; ///< of it, in order of time; empty: it rises over the duration
  std::size_t entry = 0; ///< number of the [[load]] that it is of; one between two plies is of both

  std::vector<Stage> stages() const {
    return programme.empty() ? std::vector<Stage>{{1.0, pressure}} : programme;
  }
};

enum class ElementKind {
  automatic, ///< plain where sides run along the fibres, averaged elsewhere
  plain,     ///< the paper's element
  averaged,  ///< fibre strains averaged over strain groups of two triangles: does not lock
};

struct SolverOptions {
  ElementKind element = ElementKind::automatic;
  double duration = 0.1;             ///< s, simulated time of the stroke: a cost parameter
  double dwell = 0.0;                ///< of the duration, at most, until forces have settled
  double step_factor = 0.5;          ///< fraction of the stable time step
  double fibre_softening = 1.0;      ///< fibre stiffness is divided by this
  double fibre_damping = 0.05;       ///< fraction of critical of the stiffest element mode
  double mass_damping = 0.0;         ///< 1/s, acceleration -mass_damping * velocity
  double mass_scaling = 0.01;        ///< largest share of a ply's mass added at stiff contacts
  double element_mass_scaling = 0.0; ///< largest share of a ply's mass added to small elements
  double max_balance_error = 0.1;    ///< stop above this relative energy balance error
  int outputs = 20;                  ///< states written, evenly over the stroke
  double checkpoint_interval = 60.0; ///< s of wall time
};

enum class SelfContact {
  automatic, ///< in a stack of two plies or more
  off,
  on,
};

/// Plies that give their heat to what is around them: core/solver/follow_temperature.hpp.
/// Conductances in N/(mm s K), 1 W/(m^2 K) = 0.001 of it.
struct Cooling {
  double to_tools = 0.0;                      ///< of a face in contact with a tool
  double to_plies = 0.0;                      ///< of one face to that of another ply
  double to_air = 0.0;                        ///< of a face that touches nothing
  std::vector<TemperatureStage> surroundings; ///< degC, of the air
};

/// The real process. What is simulated in solver.duration takes this long in it.
struct ProcessOptions {
  std::optional<double> duration;    ///< s, of the stroke; needed where laws have rates
  std::optional<double> temperature; ///< degC, of plies and tools that have none of their own
  std::optional<Cooling> cooling;    ///< nothing: plies keep their temperatures
};

struct ContactOptions {
  double stiffness = 0.1; ///< omega^2 of a free node on it over that of the elements
  double damping = 0.2;   ///< fraction of critical
  double skin = 0.0;      ///< mm, search distance beyond contact; 0: from the element size
  SelfContact self = SelfContact::automatic;
};

/// Requested accuracy relative to a converged run (core/accuracy/error_model.hpp).
struct AccuracyOptions {
  double shear_error = 0.0; ///< rad, rms; 0: not requested, solver options and element sizes apply
  bool verify = false;      ///< runs siblings after the run: core/verification/verify.hpp
  bool instant = false;     ///< forms each ply alone: core/setup/instant.hpp
};

/// Which planes of symmetry of a scene leave only a part of it to be modelled.
enum class Symmetry {
  none,  ///< none
  scene, ///< those that hold
  alike, ///< those, too, that hold if families that differ by less than 5 % are taken as one
};

/// A plane at which a scene was cut: the side to which its normal points is modelled.
struct PartPlane {
  SymmetryPlane plane;
  std::vector<int> tools, boundaries; ///< of each, its mirror image
};

struct Case {
  std::string title;
  std::vector<Fabric> fabrics;
  std::vector<BlankSpec> blanks;
  std::vector<Ply> plies;
  std::vector<Tool> tools;
  std::vector<Boundary> boundaries;
  std::vector<PressureLoad> loads;
  Vec3 gravity = Vec3::Zero(); ///< mm/s^2
  std::vector<FrictionLawPtr> friction_laws;
  FrictionTable friction;
  SolverOptions solver;
  ProcessOptions process;
  ContactOptions contact;
  AccuracyOptions accuracy;
  Symmetry symmetry = Symmetry::none;
  /// mm, of each tool: by how much farther than half its thickness a ply is kept from it, as by
  /// other plies between (core/setup/instant.hpp); empty: by nothing
  std::vector<double> tool_clearance;
  std::vector<PartPlane> part_at; ///< at right angles to each other; what is shown is the whole

  /// s, that the stroke takes in the process, or what is simulated of it if that is not said
  double process_stroke_time() const { return process.duration.value_or(solver.duration); }
  /// s of the process in each simulated second; 1 if it is not said how long the process takes
  double process_time() const { return process_stroke_time() / solver.duration; }
};

/// Whether anything of it has a temperature; then every ply has.
bool has_temperature(const Case& data);

/// degC of a ply at the start, and of a tool at a time (s) of the process; nothing: not known.
std::optional<double> start_temperature(const Case& data, const Ply& ply);
std::optional<double> tool_temperature(const Case& data, const Tool& tool, double time);

/// Takes out all plies but those for which keep (one per ply) is not 0, and numbers anew those that
/// boundaries and loads name. Nothing may act on what is taken out.
void keep_plies(Case& data, const std::vector<char>& keep);

/// What moves a ply without touching it.
struct Push {
  std::size_t ply;
  Vec3 way;         ///< mm, how far it may take the ply
  std::string name; ///< "gravity", "a pressure"
  bool measured;    ///< whether scenes that the error model was fitted to have it
};
std::vector<Push> pushes(const Case& data);

} // namespace plyform
