// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/verification/whole_run.hpp"

#include "base/format.hpp"
#include "core/mesh/mesh_ply.hpp"
#include "core/results/field_difference.hpp"
#include "core/solver/scene.hpp"
#include "core/verification/siblings.hpp"

#include <algorithm>

namespace plyform {

std::optional<WholeRun> run_whole(const Case& whole, const RunResult& shown, ErrorPart band,
                                  int threads, const VerifyHooks& hooks) {
  constexpr double share = 1e-3;     // of an element
  constexpr double more_waves = 0.3; // of a wrinkle's height
  if (hooks.begins) hooks.begins("whole, started off its symmetry", 1, 1);
  Scene scene = make_scene(whole, {}, threads);
  WholeRun found;
  found.moved_mm = share * scene.element_size;
  move_first_tool(whole, found.moved_mm * Vec3(0.8, 0.6, 0.0), scene);
  RunHooks run;
  run.interrupt = hooks.interrupt;
  if (hooks.progress) run.progress = [&](const Progress& p) { hooks.progress(p, p.fraction); };
  const RunResult all = run_scene(scene, threads, run);
  if (!ended(all.summary.status)) return std::nullopt;
  found.shear_deg = shear_error(all.last, shown.last).rms;
  double most = -1.0;
  for (std::size_t p = 0; p < all.summary.plies.size(); ++p) {
    const double there = all.summary.plies[p].wrinkle.height,
                 here = shown.summary.plies[p].wrinkle.height;
    if (!(there - here > most)) continue;
    most = there - here;
    found.ply = all.last.plies[p].name, found.wrinkle_mm = there, found.shown_wrinkle_mm = here;
  }
  found.breaks = most > std::max(least_wrinkle, more_waves * found.shown_wrinkle_mm) ||
                 (band && found.shear_deg > 2.0 * *band);
  return found;
}

std::string doubt_of_symmetry(const WholeRun& whole) {
  if (!whole.breaks) return {};
  return fmt::format(
      "do not trust the symmetry: the whole, started {:.2g} mm off it, differs by "
      "{:.2g} degrees rms in its shear and has wrinkles of {:.2g} mm in {} where {:.2g} "
      "are shown; symmetry = \"none\" models the whole",
      whole.moved_mm, whole.shear_deg, whole.wrinkle_mm, whole.ply, whole.shown_wrinkle_mm);
}

} // namespace plyform
