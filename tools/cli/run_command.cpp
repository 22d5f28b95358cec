// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "base/thread_pool.hpp"
#include "base/version.hpp"
#include "core/accuracy/error_model.hpp"
#include "core/input/keys/schema.hpp"
#include "core/run/live_picture.hpp"
#include "core/run/progress_file.hpp"
#include "core/setup/outlook.hpp"
#include "core/setup/run_prepared.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/ending_signals.hpp"
#include "tools/cli/progress_line.hpp"
#include "tools/cli/verify_and_correct.hpp"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

namespace plyform {
namespace {

/// Output folder results/NAME. NAME is that of the case's folder, or of its file if it is not
/// case.toml.
std::filesystem::path output_folder(const RunArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  std::filesystem::path file = std::filesystem::absolute(arguments.input.file).lexically_normal();
  if (!file.has_filename()) file = file.parent_path(); // "cases/NAME/"
  if (std::filesystem::is_directory(file))
    return std::filesystem::path("results") / file.filename();
  if (file.filename() == "case.toml")
    return std::filesystem::path("results") / file.parent_path().filename();
  return std::filesystem::path("results") / file.stem();
}

/// Prints shares of computing time, contact of each pair of bodies, and the diagnosis of the model.
void print_work(const WorkReport& w, long steps) {
  fmt::print("  computing time: elements {:.0f} %, contact {:.0f} %, search {:.0f} % ({} times, "
             "every {} steps)\n",
             100.0 * w.elements_share, 100.0 * w.contact_share, 100.0 * w.search_share, w.searches,
             steps / std::max(w.searches, 1L));
  std::vector<std::string> apart;
  for (const PairReport& pair : w.pairs) {
    if (!pair.touched()) {
      apart.push_back(pair.a + " - " + pair.b);
      continue;
    }
    fmt::print("  {:28} {:4.1f} % of the time, {:.3f} mm deep, slid {:.2f} mm at most\n",
               pair.a + " - " + pair.b, 100.0 * pair.time_share, pair.deepest_mm, pair.slip_mm);
  }
  if (!apart.empty()) fmt::print("  never touched: {}\n", joined(apart));
  for (const std::string& what : w.could_be_left_out)
    fmt::print("  could be left out: {}\n", what);
}

/// Prints the fibre volume of a ply, and how the stack fills a closed mould.
void print_fill(const std::string& name, const PlyReport& ply) {
  if (const auto& v = ply.fibre_volume)
    fmt::print("  {:16} fibre volume {:.1f} %, {:.1f} to {:.1f} %", name, 100.0 * v->mean,
               100.0 * v->least, 100.0 * v->largest);
  if (const auto& mould = ply.mould)
    fmt::print(
        "{} of {:.0f} mm2 in the mould, {:.2f} mm wide, it is wider than the stack on {:.0f}, "
        "by {:.2f} mm at most, and at the densest packing on {:.0f}",
        ply.fibre_volume ? std::string(";") : fmt::format("  {:16}", name), mould->area,
        mould->mean_gap, mould->wider, mould->widest, mould->packed);
  if (ply.fibre_volume || ply.mould) fmt::print("\n");
}

/// Prints one line per ply: compressed yarns, shear beyond locking, wrinkles and draw-in.
void print_plausibility(const std::string& name, const PlyReport& ply) {
  fmt::print("  {:16} ", name);
  if (const auto& pressed = ply.pressed)
    fmt::print(
        "pressed {:.1f} %, over 2 / 5 % on {:.1f} / {:.1f} % of the area; excess length {:.1f}, ",
        100.0 * pressed->largest, 100.0 * pressed->share_above_2, 100.0 * pressed->share_above_5,
        pressed->excess_mm);
  fmt::print("wrinkles {:.1f}", ply.wrinkle.height);
  if (ply.bridging && ply.bridging->height > 0.0)
    fmt::print(", bridging {:.1f} on {:.0f} mm2", ply.bridging->height, ply.bridging->area);
  if (ply.draw_in.unknown.empty()) fmt::print(", draw-in {:.1f}", ply.draw_in.mean());
  fmt::print(" mm");
  if (ply.beyond_locking_share)
    fmt::print("; beyond locking on {:.1f} %", 100.0 * *ply.beyond_locking_share);
  fmt::print("\n");
  print_fill(name, ply);
  for (const Opening& o : ply.openings) {
    fmt::print("  {:16} opening between {} {:.1f} % at most, at ({:.4g}, {:.4g}, {:.4g}) mm", name,
               o.family, 100.0 * o.largest, o.at.x(), o.at.y(), o.at.z());
    if (o.limit)
      fmt::print("; over its limit of {:g} % on {:.1f} % of the area, {:.0f} mm2", 100.0 * *o.limit,
                 100.0 * o.beyond_share, o.beyond_mm2);
    fmt::print("\n");
  }
}

/// Prints where the stitches of a ply are broken, a line each direction.
void print_stitches(const std::string& name, const std::vector<BrokenStitches>& stitches) {
  for (const BrokenStitches& s : stitches)
    if (s.area > 0.0)
      fmt::print(
          "  {:16} {} broken on {:.3g} % of its length, {:.4g} mm2; the largest patch, {:.4g} "
          "mm2, about ({:.0f}, {:.0f}, {:.0f}) mm\n",
          name, s.name, 100.0 * s.share, s.area, s.patch_area, s.patch_at.x(), s.patch_at.y(),
          s.patch_at.z());
    else
      fmt::print("  {:16} {} broken nowhere\n", name, s.name);
}

/// Prints the force of a tool, or of a gripper, spring or clamp.
template <class Body>
void print_force(const Body& body, const KnownForce& known) {
  if (known.to_end())
    fmt::print("  {:16} force {:8.{}f} N, displacement {:7.2f} mm\n", body.name, body.force_N,
               std::abs(body.force_N) < 10.0 ? 3 : 1, body.stroke_mm);
  else
    fmt::print("  {:16} force not known after {:.2f} mm, where tools press the plies; displacement "
               "{:7.2f} mm\n",
               body.name, known.stroke_mm, body.stroke_mm);
}

/// How far a run is: its stroke, or the time where nothing has one.
std::string reached_text(double time_s, double stroke_mm) {
  return stroke_mm != 0.0 ? fmt::format("{:.2f} mm of stroke", stroke_mm)
                          : fmt::format("{:.4g} s", time_s);
}

void print_outcome(const RunResult& r, const std::filesystem::path& folder) {
  const Energies& e = r.last.energy;
  fmt::print("{} at {} after {} steps in {:.1f} s\n", r.summary.status,
             reached_text(r.last.time, r.last.stroke_mm), r.summary.steps, r.summary.wall_time_s);
  for (const PlyFrame& ply : r.last.plies) {
    double shear = 0.0, tension = 0.0;
    for (const double angle : ply.shear_deg)
      shear = std::max(shear, std::abs(angle));
    for (const FamilyFrame& family : ply.families)
      for (const double of_triangle : family.tension)
        tension = std::max(tension, of_triangle);
    fmt::print("  {:16} largest shear {:5.1f} deg, largest tension {:6.2f} N per yarn\n", ply.name,
               shear, tension);
  }
  for (std::size_t p = 0; p < r.summary.plies.size(); ++p)
    print_plausibility(r.last.plies[p].name, r.summary.plies[p]);
  for (std::size_t p = 0; p < r.summary.plies.size(); ++p)
    print_stitches(r.last.plies[p].name, r.summary.plies[p].stitches);
  for (std::size_t t = 0; t < r.last.tools.size(); ++t)
    print_force(r.last.tools[t],
                t < r.summary.known_forces.size() ? r.summary.known_forces[t] : KnownForce{});
  for (const auto& boundary : r.last.boundaries)
    print_force(boundary, KnownForce{});
  fmt::print("  energy balance error {:.2e}, kinetic over shear energy {:.2e}\n", e.balance_error(),
             e.kinetic_over_shear());
  if (r.summary.largest_added_mass > 0.0)
    fmt::print("  mass scaling: {:.2g} % of a ply's mass added at most\n",
               100.0 * r.summary.largest_added_mass);
  if (r.summary.element_added_mass > 0.0)
    fmt::print("  small elements: {:.2g} % of a ply's mass added at most\n",
               100.0 * r.summary.element_added_mass);
  const ContactReport& c = r.summary.contact;
  fmt::print("  penetration {:.3f} mm into tools, {:.3f} mm between plies; triangles crossing: {} "
             "between plies, {} within\n",
             c.max_tool_penetration_mm, c.max_ply_penetration_mm, c.intersections_between_plies,
             c.intersections_within_plies);
  const AccuracyReport& a = r.summary.accuracy;
  fmt::print("  {}\n", describe_accuracy({a.inertia_deg, a.softening_deg, a.mesh_deg},
                                         a.promised_deg, a.coarsening, a.unknown));
  print_verification(r.summary.verification);
  for (const std::string& line : r.summary.assumed)
    fmt::print("  assumed: {}\n", line);
  print_work(r.summary.work, r.summary.steps);
  for (const std::string& what : r.summary.doubts)
    fmt::print("  doubt: {}\n", what);
  for (const std::string& what : advice_of(r.summary))
    fmt::print("  better: {}\n", what);
  fmt::print("results are in {}\n", folder.string());
}

/// Says on standard error how a run ended that is not simply done, and returns the exit code.
int tell_end(const Summary& summary, const std::filesystem::path& folder) {
  std::fflush(stdout); // where both go into one file
  if (summary.status == "stopped") {
    fmt::print(stderr, "plyform: {}\n         the last good state is in {}\n", summary.message,
               folder.string());
    return exit_stopped;
  }
  if (summary.status == "interrupted")
    fmt::print(stderr,
               "plyform: {}\n         the state reached is in {}; the same command with --resume "
               "goes on\n",
               summary.message, folder.string());
  if (summary.status == "doubtful" || summary.status == "instant")
    fmt::print(stderr, "plyform: {}: {}\n", summary.status, summary.message);
  return ended(summary.status) ? exit_done : exit_other;
}

/// Whether the run whose summary this is was of this case, with the same settings and files, by
/// this version: as a checkpoint's identity, from what the summary says of its case.
bool same_case(const nlohmann::json& summary, const PreparedCase& prepared) {
  if (!summary.is_object() || summary.value("version", nlohmann::json()) != version()) return false;
  nlohmann::json given = nlohmann::json::object();
  for (const auto& [key, value] : prepared.given)
    given[key] = value;
  // as it is written: bytes that are no UTF-8 become U+FFFD
  const auto text = [](const nlohmann::json& of) {
    return of.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  };
  return text(summary.value("case", nlohmann::json())) == text(given);
}

/// Whether the run in this folder has come to its end; says so. Throws std::invalid_argument if it
/// was of another case.
bool ended_before(const std::filesystem::path& folder, const PreparedCase& prepared) {
  const std::filesystem::path file = folder / "summary.json";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return false;
  std::string reason;
  const std::optional<std::string> content = read_file(file, most_mesh_bytes, reason);
  if (!content) throw std::runtime_error(fmt::format("{}: {}", file.string(), reason));
  if (!same_case(nlohmann::json::parse(*content, nullptr, false), prepared))
    throw std::invalid_argument(
        fmt::format("{}: is of another case, of other settings or of another version of plyform; "
                    "run it anew, without --resume, or give another folder",
                    file.string()));
  fmt::print("the run in {} has ended: there is nothing to resume\n", folder.string());
  return true;
}

/// Where the run in this folder goes on; says so. Nothing if it has no checkpoint.
std::optional<Resume> find_checkpoint(ResultWriter& writer, const std::filesystem::path& folder,
                                      const std::string& identity) {
  std::optional<Resume> found = writer.go_on(identity);
  if (found)
    fmt::print(stderr, "goes on after {}, from the checkpoint in {}\n",
               reached_text(found->last.time, found->last.stroke_mm), folder.string());
  return found;
}

/// The summary of a run that a signal ended while its results could not be written any more (a
/// limit of the size of files): of the last state that was.
void leave_summary(ResultWriter& writer, const PreparedCase& prepared, const Frame& reached,
                   const std::string& why) {
  Summary summary;
  summary.title = prepared.value->title;
  summary.given = prepared.given;
  summary.version = version();
  summary.status = "interrupted";
  summary.message =
      fmt::format("interrupted after step {}, time {:.6g} s of {:.6g} s, by {}: {}", reached.step,
                  reached.time, prepared.value->solver.duration, ending_signal(), why);
  summary.steps = reached.step;
  try {
    writer.write_summary(reached, summary);
  } catch (const std::runtime_error&) { // nothing can be written; the caller says so
  }
}

/// Says what a run with meshes from the scene will take, and whether any is within the budget.
bool within_budget(const PreparedCase& prepared, const RunArguments& arguments, int threads,
                   bool from_scene) {
  if (arguments.budget == 0.0 && !from_scene) return true;
  const Outlook ahead = watched_outlook(prepared, threads);
  if (from_scene) fmt::print("about {:.0f} steps, {:.2g} s\n", ahead.steps, ahead.seconds);
  std::fflush(stdout);
  if (arguments.budget == 0.0 || ahead.seconds <= arguments.budget) return true;
  double triangles = 0.0;
  for (const BlankMesh& mesh : prepared.meshes)
    triangles += static_cast<double>(mesh.triangles.size());
  fmt::print(stderr,
             "plyform: error: --budget {:g}: this run would take about {:.2g} s, for {:.0f} steps "
             "of {:.0f} triangles; give it as much, a lower --accuracy, larger elements or a "
             "shorter solver.duration\n",
             arguments.budget, ahead.seconds, ahead.steps, triangles);
  return false;
}

/// Runs the case and writes its results; `trace`, unless null, gets what `verify` asks of the run.
RunResult run_and_write(const PreparedCase& prepared, int threads, ResultWriter& writer,
                        const std::optional<Resume>& resume, Trace* trace, ProgressFile& file,
                        LivePicture& picture) {
  ProgressLine line;
  file.begin(RunPhase::forming, "forms the plies");
  Frame reached = resume ? resume->last : Frame{};
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) {
    writer.write_frame(frame);
    reached = frame;
  };
  hooks.progress = [&](const Progress& p) {
    line.show(p);
    file.show(p, p.fraction, writer.states());
  };
  hooks.watch = {[&] { return picture.asked(); }, [&](const Frame& f) { picture.draw(f); }};
  hooks.interrupt = &interrupted();
  hooks.checkpoint = {
      [&](const std::string& state) { writer.write_checkpoint(prepared.identity, state); },
      prepared.value->solver.checkpoint_interval};
  hooks.resume = resume ? &*resume : nullptr;
  if (trace) watch(hooks, *trace, true);
  try {
    RunResult result = run_prepared(prepared, threads, hooks);
    if (result.summary.status == "interrupted") result.summary.message += ", by " + ending_signal();
    line.end();
    writer.write_final(result.last, result.summary);
    return result;
  } catch (const std::runtime_error& error) {
    line.end();
    if (!ending_signal().empty() && !reached.plies.empty())
      leave_summary(writer, prepared, reached, error.what());
    throw;
  }
}

} // namespace

int run_command(const RunArguments& arguments) {
  PreparedCase prepared = load_case(arguments.input);
  if (!prepared.value) return exit_case_wrong;
  const int threads = arguments.threads > 0 ? arguments.threads : available_cores();
  const std::filesystem::path folder = output_folder(arguments);
  ResultWriter writer(folder);
  std::optional<ProgressFile> file(std::in_place, folder, arguments.input.file);
  file->begin(RunPhase::checking, "looks at the case");
  catch_ending_signals();
  const bool goes_on = arguments.resume && std::filesystem::exists(folder / "checkpoint") &&
                       std::filesystem::exists(folder / size_file_name);
  std::optional<LivePicture> picture(std::in_place, folder);
  std::vector<PlySizes> sizes =
      load_meshes(arguments.input, prepared, threads,
                  {.known = goes_on ? folder : "", .file = &*file, .picture = &*picture})
          .sizes;
  if (!prepared.value) return exit_case_wrong;
  if (!within_budget(prepared, arguments, threads, !sizes.empty())) return exit_case_wrong;
  writer.keep_sizes(std::move(sizes));
  std::optional<Resume> resume;
  if (arguments.resume) {
    resume = find_checkpoint(writer, folder, prepared.identity);
    if (!resume && ended_before(folder, prepared)) return exit_done;
  }
  const bool verified = arguments.verify || prepared.value->accuracy.verify;
  VerifyOptions options{folder, threads, arguments.input.yes_large, &interrupted(), &*file};
  RunResult result = run_and_write(prepared, threads, writer, resume,
                                   verified ? &options.trace : nullptr, *file, *picture);
  picture.reset();
  if (verified && ended(result.summary.status) && !prepared.value->accuracy.instant)
    verify_and_correct(prepared, options, writer, result);
  file.reset();
  print_outcome(result, folder);
  const int code = tell_end(result.summary, folder);
  if (arguments.report && !report_of_run(folder.string()) && code == exit_done) return exit_other;
  return code;
}

} // namespace plyform
