// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/case.hpp"

namespace plyform {

bool has_temperature(const Case& data) {
  return data.process.temperature || std::any_of(data.plies.begin(), data.plies.end(),
                                                 [](const Ply& ply) { return ply.temperature; });
}

std::optional<double> start_temperature(const Case& data, const Ply& ply) {
  return ply.temperature ? ply.temperature : data.process.temperature;
}

std::optional<double> tool_temperature(const Case& data, const Tool& tool, double time) {
  if (tool.temperature.empty()) return data.process.temperature;
  return temperature_at(tool.temperature, time);
}

void keep_plies(Case& data, const std::vector<char>& keep) {
  std::vector<Ply> kept;
  std::vector<int> number(data.plies.size(), -1);
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    if (!keep[p]) continue;
    number[p] = static_cast<int>(kept.size());
    kept.push_back(data.plies[p]);
  }
  data.plies = std::move(kept);
  for (Boundary& b : data.boundaries)
    if (b.ply >= 0) b.ply = number[static_cast<std::size_t>(b.ply)];
  for (PressureLoad& load : data.loads)
    load.ply = number[static_cast<std::size_t>(load.ply)];
}

std::vector<Push> pushes(const Case& data) {
  std::vector<Push> found;
  const double time = (1.0 + data.solver.dwell) * data.solver.duration;
  for (std::size_t p = 0; p < data.plies.size() && !data.gravity.isZero(0.0); ++p)
    found.push_back({p, 0.5 * time * time * data.gravity, "gravity", true});
  for (const PressureLoad& load : data.loads) { // as far as a ply flies that nothing holds
    const auto p = static_cast<std::size_t>(load.ply);
    const double density =
        data.fabrics[static_cast<std::size_t>(data.plies[p].fabric)].surface_density;
    const double up = load.side == PlyFace::below ? 1.0 : -1.0;
    found.push_back(
        {p, 0.5 * time * time * up * load.pressure / density * Vec3::UnitZ(), "a pressure", false});
  }
  return found;
}

} // namespace plyform
