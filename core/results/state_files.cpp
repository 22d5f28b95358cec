// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "base/write_whole.hpp"
#include "core/results/result_fields.hpp"

#include <stdexcept>
#include <system_error>

namespace plyform {

namespace fs = std::filesystem;

namespace {

template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items)
    names.push_back(item.name);
  return names;
}

/// Names and mesh sizes of plies and tools as text, to check that they do not change during a run.
std::string shape_of(const Frame& frame) {
  std::string shape;
  for (const PlyFrame& ply : frame.plies)
    shape += fmt::format("{}/{}/{}\n", ply.name, ply.x0.size(), ply.triangles.size());
  shape += "tools\n";
  for (const ToolFrame& tool : frame.tools)
    shape +=
        fmt::format("{}/{}/{}\n", tool.name, tool.surface.x.size(), tool.surface.triangles.size());
  shape += "boundaries\n";
  for (const BoundaryFrame& boundary : frame.boundaries)
    shape += boundary.name + "\n";
  return shape;
}

} // namespace

void StateFiles::append(const Frame& frame) {
  StateIndex next = index_;
  const std::size_t number = frames();
  if (number == 0) {
    std::error_code error;
    fs::create_directory(directory_ / "states", error);
    if (error) throw_cannot(directory_ / "states", "create the folder", error);
    next.plies = names_of(frame.plies);
    next.tools = names_of(frame.tools);
    next.boundaries = names_of(frame.boundaries);
    next.shape = shape_of(frame);
    write_constants(directory_ / constants_file(), frame);
  }
  if (next.shape != shape_of(frame))
    throw std::logic_error((directory_ / "results.h5").string() +
                           ": names or sizes differ from the first frame's");
  write_state(directory_ / state_file(number), frame, number);
  next.time.push_back(frame.time);
  next.stroke.push_back(frame.stroke_mm);
  next.step.push_back(frame.step);
  append_state(next.history, frame);
  write_linked(directory_ / "results.h5", next);
  index_ = std::move(next);
}

void StateFiles::go_on(const StateIndex& index) {
  for (std::size_t i = 0; i <= index.step.size(); ++i) {
    const fs::path file = i == 0 ? constants_file() : state_file(i - 1);
    std::error_code ignored;
    if (!fs::is_regular_file(fs::symlink_status(directory_ / file, ignored)))
      throw std::runtime_error(
          fmt::format("{} is missing or no file, so that the run cannot go on; run it "
                      "anew, without --resume",
                      (directory_ / file).string()));
  }
  write_linked(directory_ / "results.h5", index);
  remove_states(directory_, index.step.size());
  index_ = index;
}

void StateFiles::merge() {
  write_merged(directory_ / "results.h5", index_);
}

void remove_states(const fs::path& directory, std::size_t first) {
  const fs::path folder = directory / "states";
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool written = name.ends_with(".h5") || name.ends_with(".h5.tmp");
    const bool kept = first > 0 && (entry.path().filename() == constants_file().filename() ||
                                    name < state_file(first).filename().string());
    if (!written || kept) continue;
    fs::remove(entry.path(), error);
    if (error) throw_cannot(entry.path(), "remove the file of a former run", error);
  }
  if (first > 0) return;
  fs::remove(folder, error);
  if (error && error != std::errc::directory_not_empty) // stays if anything else is in it
    throw_cannot(folder, "remove the folder of a former run", error);
}

} // namespace plyform
