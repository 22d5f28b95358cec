// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/cli/verify_and_correct.hpp"

#include "core/results/replace_run.hpp"
#include "core/setup/part_of_scene.hpp"
#include "core/setup/run_prepared.hpp"
#include "core/setup/size_ahead.hpp"
#include "core/verification/correction.hpp"
#include "core/verification/verify.hpp"
#include "core/verification/whole_run.hpp"
#include "tools/cli/progress_line.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

std::string part_text(const ErrorPart& part) {
  return part ? fmt::format("{:.2g}", *part) : std::string("not measured");
}

void print_figure(const VerifiedFigure& f) {
  if (!f.no_band.empty()) {
    fmt::print("    {:32} {:8.4g} {:3} has no band: {}\n", f.name, f.value, f.unit, f.no_band);
    return;
  }
  fmt::print("    {:32} {:8.4g} {:3} {}: mesh {}, inertia {}, softened fibres {}, chance {}\n",
             f.name, f.value, f.unit,
             f.band ? fmt::format("+- {:.2g}", *f.band) : std::string("has no band"),
             part_text(f.mesh), part_text(f.inertia), part_text(f.softening), part_text(f.chance));
}

void print_whole(const WholeRun& w) {
  fmt::print(
      "    the whole, started {:.2g} mm off its symmetry, differs by {:.2g} deg rms in shear, "
      "and has wrinkles of {:.2g} mm in {} where {:.2g} are shown: {}\n",
      w.moved_mm, w.shear_deg, w.wrinkle_mm, w.ply, w.shown_wrinkle_mm,
      w.breaks ? "waves break the symmetry" : "the symmetry holds");
}

void print_parting(const Parting& p) {
  fmt::print("    twins, which differ by nothing to speak of, go different ways from {:.3g} s "
             "on{}: first ply {} at ({:.4g}, {:.4g}, {:.4g}) mm, {:.2g} mm apart; "
             "its shear ends {:.2g} deg apart, rms\n",
             p.time_s,
             p.stroke_mm != 0.0 ? fmt::format(", at {:.4g} mm of stroke", p.stroke_mm) : "", p.ply,
             p.at_mm.x(), p.at_mm.y(), p.at_mm.z(), p.apart_mm, p.shear_deg);
}

/// The cost parameters of the second run, over those of the first.
std::string factors_text(const AskedAccuracy& asked) {
  std::string text;
  const auto add = [&](double factor, const char* what) {
    if (factor != 1.0)
      text += fmt::format("{}{} times {}", text.empty() ? "" : ", ", fmt::format("{:.2f}", factor),
                          what);
  };
  add(asked.element_size, "the element size");
  add(asked.duration, "the duration");
  add(asked.softening, "the softening of fibres");
  return text;
}

void print_asked(const AskedAccuracy& asked) {
  fmt::print("    asked for {:.2g} deg, measured {:.2g}: ", asked.wanted_deg, asked.measured_deg);
  if (asked.kept())
    fmt::print("kept\n");
  else if (!asked.corrected)
    fmt::print("missed, not corrected: {}\n", asked.why_not);
  else
    fmt::print("missed; run again with {}, to {:.2g} deg. Shear moved by {:.2g} deg rms; the first "
               "run is in {}\n",
               factors_text(asked), asked.expected_deg, asked.moved_deg, asked.first_run);
}

/// The second run: in its own folder until it has ended, then in the place of the first.
void run_again(const PreparedCase& prepared, const VerifyOptions& options,
               const CorrectedCase& corrected, RunResult& result) {
  const AskedAccuracy& asked = corrected.asked;
  fmt::print(
      stderr,
      "asked for {:.2g} deg of shear, measured {:.2g}: runs again with {}; some {:.2g} times "
      "the work\n",
      asked.wanted_deg, asked.measured_deg, factors_text(asked),
      std::pow(asked.element_size, -3.0) * asked.duration / std::sqrt(asked.softening));
  const std::filesystem::path second_folder = options.folder / "second_run";
  ResultWriter writer(second_folder);
  ProgressLine line;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) { writer.write_frame(frame); };
  options.file->begin(RunPhase::correcting,
                      "the accuracy asked for was missed: runs again with finer parameters");
  hooks.progress = [&](const Progress& p) {
    line.show(p, "runs again");
    options.file->show(p, p.fraction, writer.states());
  };
  hooks.interrupt = options.interrupt;
  const PreparedCase finer{.value = corrected.data,
                           .meshes = {}, // as the corrected case asks for
                           .coarsening = prepared.coarsening * asked.element_size,
                           .identity = {},
                           .given = prepared.given,
                           .errors = {},
                           .warnings = {},
                           .notes = prepared.notes,
                           .fixed = {}};
  RunResult second = run_prepared(finer, options.threads, hooks);
  line.end();
  Summary& summary = second.summary;
  AskedAccuracy said = asked;
  if (ended(summary.status)) {
    said.corrected = true;
    said.first_run = (options.folder / "first_run").string();
    summary.verification =
        after_correction(result.summary.verification, said,
                         {result.last, result.summary.plies, 0.0, {}, result.summary.flies},
                         {second.last, summary.plies});
    writer.write_final(second.last, summary);
    replace_run(options.folder, second_folder, said.first_run);
    result = std::move(second);
    return;
  }
  writer.write_final(second.last, summary);
  said.why_not = fmt::format("the second run was {}: {}; what it reached is in {}", summary.status,
                             summary.message, second_folder.string());
  result.summary.verification.asked = said;
}

/// Runs the whole of a part, and doubts the part if waves break its symmetry.
void look_at_whole(const PreparedCase& prepared, int threads, const VerifyHooks& hooks,
                   RunResult& result) {
  Summary& summary = result.summary;
  summary.verification.whole =
      run_whole(whole_of(prepared), result, summary.verification.shear.band, threads, hooks);
  if (!summary.verification.whole) return;
  const std::string doubt = doubt_of_symmetry(*summary.verification.whole);
  if (doubt.empty()) return;
  summary.doubts.push_back(doubt);
  summary.work.missing.insert(summary.work.missing.begin(), doubt);
  if (summary.status == "done") summary.status = "doubtful", summary.message = doubt;
}

} // namespace

void verify_and_correct(const PreparedCase& prepared, const VerifyOptions& options,
                        ResultWriter& writer, RunResult& result) {
  const Case& data = *prepared.value;
  ProgressLine line;
  std::string words;
  VerifyHooks hooks;
  hooks.begins = [&](const std::string& sibling, std::size_t number, std::size_t of) {
    line.end();
    words = fmt::format("verifies, {} of {}: a {}", number, of, sibling);
    fmt::print(stderr, "{}\n", words);
    options.file->begin(RunPhase::verifying, words);
  };
  hooks.progress = [&](const Progress& p, double fraction) {
    line.show(p, words.substr(0, words.find(':')));
    options.file->show(p, fraction, writer.states());
  };
  hooks.interrupt = options.interrupt;
  const std::optional<Verification> verification =
      verify(data, result, options.trace, options.threads, hooks, prepared.meshes);
  line.end();
  if (!verification) {
    fmt::print(stderr, "plyform: interrupted: the results are complete, without bands\n");
    return;
  }
  result.summary.verification = *verification;
  if (prepared.whole) look_at_whole(prepared, options.threads, hooks, result);
  line.end();
  if (!(data.accuracy.shear_error > 0.0)) {
    writer.write_summary(result.last, result.summary);
    return;
  }
  CorrectedCase corrected = corrected_case(data, *verification, prepared.fixed);
  AskedAccuracy& asked = corrected.asked;
  const bool again = corrected.changed();
  if (again && !options.any_size &&
      too_large(size_ahead(corrected.data, options.threads), machine_memory()))
    asked.why_not = "the second run would be too large for this machine, or take more than a day; "
                    "--yes-large makes it";
  result.summary.verification.asked = asked;
  writer.write_summary(result.last, result.summary); // complete, whatever becomes of the second
  if (!again || !asked.why_not.empty()) return;
  run_again(prepared, options, corrected, result);
  if (!result.summary.verification.asked->corrected)
    writer.write_summary(result.last, result.summary);
}

void print_verification(const Verification& v) {
  if (v.figures.empty()) return;
  fmt::print("  verified by siblings, which took {:.2g} of the time of the run:\n", v.cost);
  for (const VerifiedFigure& f : v.figures)
    print_figure(f);
  if (v.asked) print_asked(*v.asked);
  if (v.whole) print_whole(*v.whole);
  for (const Parting& parting : v.partings)
    print_parting(parting);
  for (const std::string& what : v.left_out)
    fmt::print("    left out: {}\n", what);
}

} // namespace plyform
