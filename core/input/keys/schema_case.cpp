// SPDX-License-Identifier: GPL-3.0-or-later
// The table of keys of case and fabric files, and its rows for cases.
#include "core/input/keys/schema_case.hpp"

#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/temperature_keys.hpp"

namespace plyform {

namespace {

using K = KeyKind;

const Range share{.least = 0.0, .most = 1.0};
const Range friction_range{.least = 0.0, .most = 10.0};
const Range positive_share{.least = 0.0, .most = 1.0, .open_least = true};

/// Text of a default value of the program's option structs.
std::string toml(double number) {
  return fmt::format("{}", number);
}

Rows ply_rows() {
  return {{.key = "stack", .kind = K::table, .fallback = "{}", .meaning = "place of the stack"},
          {.key = "stack.bottom",
           .unit = "mm",
           .fallback = "0.0",
           .ranges = {place_range},
           .meaning = "height z of the lowest ply's lower face"},
          {.key = "ply",
           .kind = K::tables,
           .least_items = 1,
           .most_items = 200, // each may touch each other
           .meaning = "plies, one [[ply]] each, from the bottom up"},
          {.key = "ply[].name",
           .kind = K::name,
           .meaning = "ply's name, unlike all others; names its result file",
           .members = {to(&Ply::name)}},
          {.key = "ply[].fabric",
           .kind = K::text,
           .refers = {"fabrics"},
           .meaning = "name of one of the fabrics"},
          {.key = "ply[].blank",
           .kind = K::text,
           .refers = {"blanks"},
           .meaning = "name of one of the blanks"},
          {.key = "ply[].angle",
           .unit = "deg",
           .ranges = {{.least = -360.0, .most = 360.0}},
           .meaning = "angle from x to the warp yarns, about z; the outline stays as it is",
           .members = {to(&Ply::angle)}},
          {.key = "ply[].seed",
           .kind = K::numbers,
           .unit = "mm",
           .fallback = "[0.0, 0.0]",
           .ranges = {place_range},
           .count = 2,
           .meaning = "seed point [x, y], where the blank's own [0, 0] is laid"},
          {.key = "ply[].rotation",
           .unit = "deg",
           .fallback = "0.0",
           .ranges = {{.least = -360.0, .most = 360.0}},
           .meaning = "turn of the blank about its seed point, about z; the yarns stay at their "
                      "angle",
           .members = {to(&Ply::rotation)}},
          {.key = "ply[].z",
           .unit = "mm",
           .otherwise = "on top of the ply below",
           .ranges = {place_range},
           .meaning = "height of the mid-surface"}};
}

Rows contact_rows() {
  const ContactOptions contact;
  return {{.key = "contact",
           .kind = K::table,
           .fallback = "{}",
           .meaning = "friction and contact options"},
          {.key = "contact.friction",
           .fallback = "0.2",
           .ranges = {friction_range},
           .usual = {{.least = 0.0, .most = 1.0}},
           .meaning = "friction coefficient of all pairs, usually 0.1 to 0.4"},
          {.key = "contact.friction_law",
           .kind = K::text,
           .otherwise = "Coulomb's, with contact.friction",
           .refers = {"friction"},
           .meaning = "name of the law in [friction] that holds for all pairs instead of "
                      "contact.friction"},
          {.key = "contact.pair",
           .kind = K::tables,
           .fallback = "[]",
           .meaning = "pairs with a friction of their own, one [[contact.pair]] each; of several "
                      "that fit, the last holds"},
          {.key = "contact.pair[].between",
           .kind = K::names,
           .choices = {"plies", "tools"},
           .refers = {"ply", "tool"},
           .count = 2,
           .meaning = "two names of plies or tools; \"plies\" and \"tools\" stand for all of them"},
          {.key = "contact.pair[].friction",
           .instead = {"friction_law"},
           .ranges = {friction_range},
           .usual = {{.least = 0.0, .most = 1.0}},
           .meaning = "friction coefficient of the pair, usually 0.1 to 0.4"},
          {.key = "contact.pair[].friction_law",
           .kind = K::text,
           .instead = {"friction"},
           .refers = {"friction"},
           .meaning = "name of the law in [friction] that holds for the pair"},
          {.key = "contact.stiffness",
           .fallback = toml(contact.stiffness),
           .ranges = {positive_share},
           .meaning = "contact stiffness as a fraction of the largest stable one",
           .members = {to(&ContactOptions::stiffness)}},
          {.key = "contact.damping",
           .fallback = toml(contact.damping),
           .ranges = {share},
           .meaning = "damping of contacts as a fraction of critical",
           .members = {to(&ContactOptions::damping)}},
          {.key = "contact.skin",
           .unit = "mm",
           .otherwise = "0.3 of the smallest mean element size",
           .ranges = {{.least = 1e-6, .most = 1e3}},
           .meaning = "search distance beyond contact",
           .members = {to(&ContactOptions::skin)}},
          {.key = "contact.self",
           .kind = K::choice,
           .fallback = "\"auto\"",
           .choices = words_of(self_choices),
           .meaning = "contact of each ply with itself, where it folds over; auto: in a stack",
           .members = {to(&ContactOptions::self, self_choices)}}};
}

Rows solver_rows() {
  const SolverOptions solver;
  return {{.key = "solver",
           .kind = K::table,
           .fallback = "{}",
           .meaning = "options of the time stepping"},
          {.key = "solver.duration",
           .unit = "s",
           .fallback = toml(solver.duration),
           .ranges = {{.least = 1e-9, .most = 1e4}},
           .usual = {{.least = 1e-3, .most = 100.0}},
           .meaning = "simulated time of the stroke, or of the programmes of pressures",
           .members = {to(&SolverOptions::duration)}},
          {.key = "solver.dwell",
           .fallback = toml(solver.dwell),
           .ranges = {{.least = 0.0, .most = 10.0}},
           .meaning = "time after the stroke, at most, until forces have settled and plies that "
                      "pressures form rest, as a share of the duration",
           .members = {to(&SolverOptions::dwell)}},
          {.key = "solver.element",
           .kind = K::choice,
           .fallback = "\"auto\"",
           .choices = words_of(element_choices),
           .meaning =
               "plain: the paper's; averaged: does not lock; auto: plain where sides run along "
               "the fibres",
           .members = {to(&SolverOptions::element, element_choices)}},
          {.key = "solver.step_factor",
           .fallback = toml(solver.step_factor),
           .ranges = {positive_share},
           .meaning = "time step as a fraction of the stable one",
           .members = {to(&SolverOptions::step_factor)}},
          {.key = "solver.fibre_softening",
           .fallback = toml(solver.fibre_softening),
           .ranges = {{.least = 1.0, .most = 1e9}},
           .usual = {{.least = 1.0, .most = 1e5}},
           .meaning = "number that divides the fibre stiffness, for larger steps",
           .members = {to(&SolverOptions::fibre_softening)}},
          {.key = "solver.fibre_damping",
           .fallback = toml(solver.fibre_damping),
           .ranges = {share},
           .meaning = "damping of fibres as a fraction of critical of the stiffest mode",
           .members = {to(&SolverOptions::fibre_damping)}},
          {.key = "solver.mass_damping",
           .unit = "1/s",
           .fallback = toml(solver.mass_damping),
           .ranges = {{.least = 0.0, .most = 1e9}},
           .meaning = "deceleration per velocity of all nodes",
           .members = {to(&SolverOptions::mass_damping)}},
          {.key = "solver.mass_scaling",
           .fallback = toml(solver.mass_scaling),
           .ranges = {share},
           .usual = {{.least = 0.0, .most = 0.05}},
           .meaning = "largest share of a ply's mass added at nodes of stiff contacts, for larger "
                      "steps; 0: none",
           .members = {to(&SolverOptions::mass_scaling)}},
          {.key = "solver.element_mass_scaling",
           .fallback = toml(solver.element_mass_scaling),
           .ranges = {share},
           .usual = {{.least = 0.0, .most = 0.5}},
           .meaning = "largest share of a ply's mass added to its small elements at the start, for "
                      "larger steps; 0: none",
           .members = {to(&SolverOptions::element_mass_scaling)}},
          {.key = "solver.max_balance_error",
           .fallback = toml(solver.max_balance_error),
           .ranges = {{.least = 1e-12, .most = 1e6}},
           .meaning = "relative error of the energy balance above which the run stops",
           .members = {to(&SolverOptions::max_balance_error)}},
          {.key = "solver.outputs",
           .kind = K::integer,
           .fallback = fmt::format("{}", solver.outputs),
           .ranges = {{.least = 1.0, .most = 100000.0}},
           .meaning = "number of states written, evenly over the stroke",
           .members = {to(&SolverOptions::outputs)}},
          {.key = "solver.checkpoint_interval",
           .unit = "s",
           .fallback = toml(solver.checkpoint_interval),
           .ranges = {{.least = 0.0, .most = 1e6}},
           .meaning = "wall time between checkpoints, from which `plyform run --resume` goes on",
           .members = {to(&SolverOptions::checkpoint_interval)}}};
}

Rows accuracy_rows() {
  return {{.key = "accuracy",
           .kind = K::table,
           .fallback = "{}",
           .meaning = "how near to a converged run; picks solver.duration, solver.fibre_softening "
                      "and up to 1.4 times larger elements"},
          {.key = "accuracy.shear_deg",
           .unit = "deg",
           .otherwise = "as [solver] and element sizes have it",
           .ranges = {{.least = 0.05, .most = 20.0}},
           .meaning = "root mean square error of the shear angle that is allowed; `plyform run "
                      "--accuracy draft` is 3, standard 1, reference 0.3",
           .members = {to(&AccuracyOptions::shear_error)}},
          {.key = "accuracy.verify",
           .kind = K::boolean,
           .fallback = "false",
           .meaning = "whether siblings with coarser parameters run after the run and give each "
                      "figure its band, as `plyform run --verify`",
           .members = {to(&AccuracyOptions::verify)}},
          {.key = "accuracy.instant",
           .kind = K::boolean,
           .fallback = "false",
           .meaning = "whether each ply is formed alone between the tools, coarse and fast, for a "
                      "first answer to some 4 degrees without forces, as `plyform run --accuracy "
                      "instant`",
           .members = {to(&AccuracyOptions::instant)}}};
}

constexpr FurtherPart further_parts[] = {{load_rows, read_loads},
                                         {process_rows, read_process, check_process}};

Rows all_rows() {
  Rows rows{{.key = "title",
             .kind = K::text,
             .fallback = "\"\"",
             .meaning = "title of the case in results",
             .members = {to(&Case::title)}},
            {.key = "gravity",
             .kind = K::numbers,
             .unit = "mm/s2",
             .fallback = "[0.0, 0.0, 0.0]",
             .ranges = {{.least = -1e7, .most = 1e7}},
             .usual = {{.least = -1e5, .most = 1e5}},
             .count = 3,
             .meaning = "acceleration by gravity, [0, 0, -9810] for plies that lie flat on earth",
             .members = {to(&Case::gravity)}},
            {.key = "symmetry",
             .kind = K::choice,
             .fallback = "\"none\"",
             .choices = words_of(symmetry_choices),
             .meaning = "scene: models the half or quarter that planes of symmetry of the scene "
                        "leave, and shows the whole; alike: also where families of yarns that "
                        "differ by less than 5 % have to be taken as one",
             .members = {to(&Case::symmetry, symmetry_choices)}}};
  append(rows, fabric_rows());
  append(rows, blank_rows());
  append(rows, ply_rows());
  append(rows, ply_temperature_rows());
  append(rows, tool_rows());
  append(rows, shape_rows());
  append(rows, motion_rows());
  append(rows, tool_temperature_rows());
  append(rows, boundary_rows());
  append(rows, attachment_rows());
  append(rows, contact_rows());
  append(rows, friction_law_rows());
  append(rows, solver_rows());
  append(rows, accuracy_rows());
  for (const FurtherPart& part : further_parts)
    append(rows, part.rows());
  return rows;
}

} // namespace

void read_further_parts(const TableView& root, Case& built, Diagnostics& diagnostics) {
  for (const FurtherPart& part : further_parts)
    part.read(root, built, diagnostics);
}

void check_further_parts(const TableView& root, const Case& built, Diagnostics& diagnostics) {
  if (!diagnostics.errors.empty()) return;
  for (const FurtherPart& part : further_parts)
    if (part.check) part.check(root, built, diagnostics);
}

const std::vector<KeyRow>& key_table() {
  static const std::vector<KeyRow> rows = all_rows();
  return rows;
}

} // namespace plyform
