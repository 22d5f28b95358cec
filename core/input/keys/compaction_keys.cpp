// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/compaction_keys.hpp"

#include "core/input/keys/key_member.hpp"
#include "core/model/compaction.hpp"
#include "core/model/usual_ranges.hpp"

namespace plyform {

using K = KeyKind;

Rows compaction_rows() {
  const Range thickness{.least = 1e-4, .most = 100.0}, pressure{.least = 0.0, .most = 1e3};
  const Range usual_thickness{.least = 0.02, .most = 20.0},
      usual_pressure{.least = 0.0, .most = usual_compaction_pressure};
  const std::string table = "fabrics.NAME.compaction";
  return {
      {.key = "fabrics.NAME.fibre_density",
       .unit = "g/cm3",
       .otherwise = "not known: no fibre volume in results",
       .ranges = {{.least = 0.1, .most = 25.0}},
       .usual = {{.least = 0.9, .most = 3.0}},
       .meaning = "density of the fibres themselves: 2.55 of E glass, 1.76 to 1.8 of carbon, "
                  "1.44 of aramid",
       .members = {to(&Fabric::fibre_density)}},
      {.key = table,
       .kind = K::table,
       .otherwise = "not known: plies do not give way, and are as thick as before forming",
       .meaning = "pressure against thickness of one ply: what closes a mould"},
      {.key = table + ".table",
       .kind = K::pairs,
       .unit = "mm, N/mm2",
       .instead = {"stiffness"},
       .ranges = {thickness, pressure},
       .usual = {usual_thickness, usual_pressure},
       .least_items = 2,
       .meaning = "[thickness, pressure] of one ply between flat plates, from [thickness of the "
                  "fabric, 0] down to its densest packing"},
      {.key = table + ".stiffness",
       .unit = "N/mm2",
       .instead = {"table"},
       .ranges = {{.least = 0.0, .most = 1e9, .open_least = true}},
       .meaning = "s of p = s (V^n - V0^n), V the fibre volume fraction (Toll and Manson 1995); "
                  "needs exponent, densest and fibre_density"},
      {.key = table + ".exponent",
       .otherwise = "none",
       .ranges = {{.least = 1.0, .most = 40.0}},
       .usual = {{.least = 3.0, .most = 20.0}},
       .meaning = "n of it"},
      {.key = table + ".densest",
       .otherwise = "none",
       .ranges = {{.least = 0.01, .most = densest_packing}},
       .usual = {{.least = 0.4, .most = 0.85}},
       .meaning = "fibre volume fraction at the densest packing, where it ends"},
      {.key = table + ".unloading",
       .kind = K::pairs,
       .unit = "mm, N/mm2",
       .otherwise = "back as it came",
       .ranges = {thickness, pressure},
       .usual = {usual_thickness, usual_pressure},
       .least_items = 2,
       .meaning = "[thickness, pressure] as it opens again, in the order of table, from "
                  "[thickness that is left, 0] to where loading ended"},
      {.key = table + ".nesting",
       .unit = "mm",
       .fallback = "0.0",
       .ranges = {{.least = 0.0, .most = 10.0}},
       .usual = {{.least = 0.0, .most = 1.0}},
       .meaning = "how much thinner two plies on each other are than twice one, as they nest"}};
}

} // namespace plyform
