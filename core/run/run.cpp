// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/run.hpp"

#include "base/format.hpp"
#include "base/time_left.hpp"
#include "core/model/mirror.hpp"
#include "core/model/motion.hpp"
#include "core/run/checkpoint.hpp"
#include "core/run/densest_packing.hpp"
#include "core/run/finish_run.hpp"
#include "core/run/output_state.hpp"
#include "core/run/pressed_stack.hpp"
#include "core/run/whole_frame.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/step.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plyform {
namespace {

constexpr int check_every = 100; // steps between checks of the energy balance and progress reports
constexpr std::size_t most_watched = 100'000; // facets of a tool that those who watch get

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

/// Energy (N mm) below which the balance is not checked, since its error is then a ratio of
/// rounding errors: a hundredth of the stack's kinetic energy at the peak speed of the fastest
/// driven tool or grip, plus the work of the force of each pushed tool, gripper and spring, of the
/// weight and of pressures over a tenth of a millimetre.
double balance_floor(const Scene& s) {
  double mass = 0.0, force_controlled = 0.0;
  for (const PlyBody& ply : s.plies)
    for (double m : ply.membrane.node_mass)
      mass += m;
  for (const PressureLoad& load : s.data.loads)
    for (const double area : s.plies[static_cast<std::size_t>(load.ply)].membrane.node_area)
      force_controlled += 0.1 * load.pressure * area;
  for (const ToolState& t : s.tools)
    force_controlled += 0.1 * std::abs(t.force_on);
  for (const Boundary& b : s.data.boundaries)
    force_controlled += 0.1 * (b.is<TensionSpring>() ? b.as<TensionSpring>().preload : force_of(b));
  force_controlled += 0.1 * mass * s.data.gravity.norm();
  const double peak_speed =
      peak_speed_ratio * longest_strokes(s.data).at_full_speed / s.data.solver.duration;
  return 1e-6 + force_controlled + 0.01 * 0.5 * mass * peak_speed * peak_speed;
}

std::optional<Stop> check_balance(const Scene& s, const Energies& e, double floor) {
  const double error = e.balance_error();
  const double limit = s.data.solver.max_balance_error;
  if (std::isfinite(error) && (e.largest() < floor || std::abs(error) <= limit))
    return std::nullopt;
  return Stop{
      fmt::format("stopped at step {}, time {:.6g} s: energy balance error {:.3g} passes "
                  "solver.max_balance_error = {:.3g}; a smaller solver.step_factor may help",
                  s.step, s.time, error, limit)};
}

/// Number of the latest output state that is due: outputs are spaced evenly over the stroke, or
/// over the time if nothing is driven, a pressure acts or anything has a programme.
int outputs_due(const Scene& s) {
  const double stroke = whole_stroke(s.data);
  const bool by_time = stroke == 0.0 || !s.data.loads.empty() ||
                       std::any_of(s.data.tools.begin(), s.data.tools.end(),
                                   [](const Tool& tool) { return !tool.programme.empty(); }) ||
                       std::any_of(s.data.boundaries.begin(), s.data.boundaries.end(),
                                   [](const Boundary& b) { return !programme_of(b).empty(); });
  const double done = by_time ? s.time / s.data.solver.duration : current_stroke(s) / stroke;
  const int due = static_cast<int>(std::floor(done * s.data.solver.outputs + 1e-9));
  return std::min(due, s.data.solver.outputs - 1); // the last one is due at the end
}

/// Share of a whole run that is done, its dwell included, which may end earlier.
double share_done(const Scene& s) {
  return s.time / (s.data.solver.duration * (1.0 + s.data.solver.dwell));
}

Progress progress_of(const Scene& s, const Energies& e, double elapsed, double remaining) {
  Progress p;
  p.fraction = std::min(1.0, s.time / s.data.solver.duration);
  p.stroke_mm = current_stroke(s);
  p.step = s.step;
  p.elapsed_s = elapsed;
  p.remaining_s = remaining;
  p.kinetic_over_shear = e.kinetic_over_shear();
  p.balance_error = e.balance_error();
  return p;
}

/// One run: the loop over its steps.
class Run {
public:
  Run(Scene& scene, int threads, const RunHooks& hooks)
      : s_(scene), pool_(threads), hooks_(hooks) {}

  RunResult result() {
    begin();
    std::optional<Stop> stop = steps();
    if (stop) go_back(*stop);
    finish(s_, state_, modelled(), result_, pool_, elapsed());
    return std::move(result_);
  }

private:
  double elapsed() const { return state_.elapsed + seconds_since(begin_); }

  void begin() {
    floor_ = balance_floor(s_);
    tool_surfaces_ = tool_surfaces(s_, pool_);
    for (const TriMesh& surface : tool_surfaces_)
      watched_surfaces_.push_back(surface.triangles.size() <= most_watched ? surface : TriMesh{});
    if (hooks_.resume) {
      try {
        load_state(hooks_.resume->state, s_, state_);
      } catch (const std::runtime_error& fault) {
        throw std::runtime_error(fmt::format("the checkpoint is damaged: it {}; the run cannot go "
                                             "on: run it anew, without --resume",
                                             fault.what()));
      }
      result_.last = hooks_.resume->last;
      if (is_part()) take_part(result_.last);
      check_last(hooks_.resume->last);
      result_.last.energy = state_.good.energy;
      begun_at_ = share_done(s_);
      next_mark_ = 1 + static_cast<int>(s_.time / s_.data.solver.duration * hooks_.marks.count);
      return;
    }
    start(s_, pool_);
    keep(s_, state_.energy, state_.good);
  }

  bool is_part() const { return !s_.data.part_at.empty(); }

  /// The last output state of what is modelled; result_.last is what is shown of it.
  const Frame& modelled() const { return is_part() ? part_ : result_.last; }

  /// What is shown of a state of what is modelled.
  Frame shown(Frame frame) {
    if (!is_part()) return frame;
    if (!whole_) whole_.emplace(s_.data, frame);
    Frame whole = whole_->of(std::move(frame));
    add_wrinkles(s_, pool_, whole);
    return whole;
  }

  /// Of a run that goes on: the part in the place of the state that was shown.
  void take_part(const Frame& last) {
    part_ = make_frame(s_, tool_surfaces_, {}, pool_);
    part_.time = last.time, part_.stroke_mm = last.stroke_mm, part_.step = last.step;
    part_.energy = state_.good.energy;
    whole_.emplace(s_.data, part_);
  }

  /// The last output state before a resume must be of this scene.
  void check_last(const Frame& last) const {
    const auto told = std::count_if( // planes of symmetry are not
        s_.data.boundaries.begin(), s_.data.boundaries.end(),
        [](const Boundary& b) { return !b.is<SymmetryPlane>(); });
    bool fits = last.plies.size() == s_.plies.size() && last.tools.size() == s_.tools.size() &&
                last.boundaries.size() == static_cast<std::size_t>(told) && last.step <= s_.step;
    for (std::size_t p = 0; fits && p < s_.plies.size(); ++p) {
      const std::vector<Triangle>& own = s_.plies[p].membrane.triangles;
      const std::size_t nodes = s_.plies[p].x0.size(), parts = parts_of(s_.data);
      fits = last.plies[p].name == s_.plies[p].name &&
             last.plies[p].x0.size() == (whole_ ? whole_->nodes(p) : nodes) &&
             last.plies[p].triangles.size() == parts * own.size() &&
             std::equal(own.begin(), own.end(), last.plies[p].triangles.begin());
    }
    if (!fits)
      throw std::runtime_error("the last state in results.h5 is not of this case, so that the run "
                               "cannot go on; run it anew, without --resume");
  }

  void write(bool last) {
    const bool first = state_.outputs_written < 0;
    state_.outputs_written = outputs_due(s_);
    if (hooks_.glance && !last) return hooks_.glance(s_);
    const double stroke = first ? 0.0 : result_.last.stroke_mm,
                 time = first ? 0.0 : result_.last.time;
    follow_known_forces(s_, stroke, time, state_.known_forces);
    follow_astray_forces(s_, state_.astray);
    Frame frame = make_frame(s_, tool_surfaces_, state_.energy, pool_);
    follow_packing(s_, frame, state_.packing);
    if (is_part()) part_ = frame;
    result_.last = shown(std::move(frame));
    if (hooks_.frame) hooks_.frame(result_.last);
  }

  /// Between two steps.
  void save_if_due(bool interrupted) {
    const RunHooks::Checkpoint& checkpoint = hooks_.checkpoint;
    if (!checkpoint.save || s_.step == 0) return;
    if (!interrupted && seconds_since(saved_) < checkpoint.interval) return;
    checkpoint.save(save_state(s_, now()));
    saved_ = Clock::now();
  }

  void tell_progress() {
    if (!hooks_.progress) return;
    const double seconds = seconds_since(begin_);
    left_.show(seconds, share_done(s_) - begun_at_);
    // a run that goes on has less to do than all of it
    const double whole = 1.0 - begun_at_;
    const double left = left_.left(seconds, whole).value_or(0.0);
    hooks_.progress(progress_of(s_, state_.energy, elapsed(), left));
  }

  RunState now() const {
    RunState state = state_;
    state.elapsed = elapsed();
    return state;
  }

  /// Between two steps; of a run that goes on, the marks that are left.
  void tell_marks() {
    const RunHooks::Marks& marks = hooks_.marks;
    if (!marks.reached || marks.count == 0) return;
    const double share = s_.time / s_.data.solver.duration * marks.count;
    for (; next_mark_ <= marks.count && share >= next_mark_ * (1.0 - 1e-12); ++next_mark_)
      marks.reached(next_mark_, s_, [this] { return save_state(s_, now()); });
  }

  std::optional<Stop> steps() {
    for (;;) {
      const bool interrupted = hooks_.interrupt && hooks_.interrupt->load();
      save_if_due(interrupted);
      tell_marks();
      if (auto stop = compute_forces(s_, pool_)) return stop;
      const bool ended = dwell_ends(state_.dwell, s_, pool_), last = interrupted || ended;
      const bool output = last || outputs_due(s_) > state_.outputs_written;
      if (s_.step == 0) s_.start_energy = current_energies(s_, pool_).residual();
      if (output || s_.step % check_every == 0) {
        state_.energy = current_energies(s_, pool_);
        if (auto stop = check_balance(s_, state_.energy, floor_)) return stop;
        keep(s_, state_.energy, state_.good);
        tell_progress();
      }
      if (output) write(last);
      if (hooks_.watch.asked && hooks_.watch.asked())
        hooks_.watch.drawn(shown(make_frame(s_, watched_surfaces_, state_.energy, pool_)));
      if (interrupted && !ended) {
        result_.summary.status = "interrupted";
        result_.summary.message = fmt::format("interrupted at step {}, time {:.6g} s of {:.6g} s",
                                              s_.step, s_.time, s_.data.solver.duration);
      }
      if (last) return std::nullopt;
      move_plies(s_, pool_);
    }
  }

  void go_back(const Stop& stop) {
    result_.summary.status = "stopped";
    result_.summary.message = stop.message;
    if (!state_.good.plies.empty()) restore(s_, state_.good);
    state_.energy = state_.good.energy;
    if (s_.step != result_.last.step || state_.outputs_written < 0) write(true);
  }

  Scene& s_;
  ThreadPool pool_;
  const RunHooks& hooks_;
  Clock::time_point begin_ = Clock::now(), saved_ = begin_;
  double floor_ = 0.0;    ///< of the check of the energy balance
  double begun_at_ = 0.0; ///< share_done at the start, of a run that goes on
  TimeLeft left_;
  int next_mark_ = 1;
  std::vector<TriMesh> tool_surfaces_, watched_surfaces_;
  RunState state_;
  RunResult result_;
  std::optional<WholeFrame> whole_; ///< of a part (Case::part_at)
  Frame part_;
};

} // namespace

RunResult run_case(const Case& data, int threads, const RunHooks& hooks,
                   const std::vector<BlankMesh>& meshes) {
  Scene s = make_scene(data, meshes, threads);
  return run_scene(s, threads, hooks);
}

RunResult run_scene(Scene& s, int threads, const RunHooks& hooks) {
  return Run(s, threads, hooks).result();
}

} // namespace plyform
