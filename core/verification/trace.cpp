// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/verification/trace.hpp"

#include "core/results/field_difference.hpp"
#include "core/run/output_state.hpp"
#include "core/solver/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plyform {
namespace {

constexpr std::array starts_of_twins{12, 15, 16, 17}; // marks: core/verification/siblings.cpp

/// The node of any ply that is furthest from where it is in the other run.
struct Furthest {
  std::size_t ply = 0, node = 0;
  double apart = 0.0;
};

template <class Positions>
Furthest furthest(std::size_t plies, const Positions& one, const Positions& other) {
  Furthest most;
  for (std::size_t p = 0; p < plies; ++p)
    for (std::size_t n = 0; n < std::min(one(p).size(), other(p).size()); ++n)
      if (const double apart = (one(p)[n] - other(p)[n]).norm(); apart > most.apart)
        most = {p, n, apart};
  return most;
}

/// Mean element size of all plies: side of a square of two triangles, mm.
double element_size(const Frame& frame) {
  double area = 0.0, triangles = 0.0;
  for (const PlyFrame& ply : frame.plies) {
    for (const double of_triangle : areas_before(ply))
      area += of_triangle;
    triangles += static_cast<double>(ply.triangles.size());
  }
  return std::sqrt(2.0 * area / std::max(triangles, 1.0));
}

} // namespace

void watch(RunHooks& hooks, Trace& trace, bool with_states) {
  trace.assign(trace_marks, {});
  hooks.marks.count = trace_marks;
  hooks.marks.reached = [&trace, with_states](int number, const Scene& scene,
                                              const std::function<std::string()>& state) {
    Moment& moment = trace[static_cast<std::size_t>(number - 1)];
    moment.time = scene.time, moment.stroke_mm = current_stroke(scene), moment.step = scene.step;
    for (const PlyBody& ply : scene.plies)
      moment.x.push_back(ply.x);
    if (with_states &&
        std::find(starts_of_twins.begin(), starts_of_twins.end(), number) != starts_of_twins.end())
      moment.state = state();
  };
}

const Moment* moment_at(const Trace& trace, double share) {
  const auto number = static_cast<std::size_t>(std::lround(share * trace_marks));
  return number >= 1 && number <= trace.size() ? &trace[number - 1] : nullptr;
}

std::optional<Parting> parting_of(const Trace& one, const Frame& one_end, const Trace& other,
                                  const Frame& other_end) {
  constexpr double parted = 0.1; // of an element; twins begin with 0.001
  const double limit = parted * element_size(one_end);
  const std::size_t plies = one_end.plies.size();
  Parting found;
  const auto set = [&](const Furthest& far, double time, double stroke, const Vec3& at) {
    found.ply = one_end.plies[far.ply].name;
    found.time_s = time, found.stroke_mm = stroke, found.apart_mm = far.apart, found.at_mm = at;
    found.shear_deg = shear_error(only_ply(one_end, far.ply), only_ply(other_end, far.ply)).rms;
  };
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i) {
    const auto &a = one[i].x, &b = other[i].x;
    if (a.size() != plies || b.size() != plies) continue;
    using Of = std::function<const std::vector<Vec3>&(std::size_t)>;
    const Furthest far = furthest<Of>(
        plies, [&a](std::size_t p) -> const std::vector<Vec3>& { return a[p]; },
        [&b](std::size_t p) -> const std::vector<Vec3>& { return b[p]; });
    if (!(far.apart > limit)) continue;
    set(far, one[i].time, one[i].stroke_mm, a[far.ply][far.node]);
    return found;
  }
  using Of = std::function<const std::vector<Vec3>&(std::size_t)>;
  const Furthest far = furthest<Of>(
      plies, [&](std::size_t p) -> const std::vector<Vec3>& { return one_end.plies[p].x; },
      [&](std::size_t p) -> const std::vector<Vec3>& { return other_end.plies[p].x; });
  if (!(far.apart > limit)) return std::nullopt;
  set(far, one_end.time, one_end.stroke_mm, one_end.plies[far.ply].x[far.node]);
  return found;
}

} // namespace plyform
