// SPDX-License-Identifier: GPL-3.0-or-later
// Layout: a line that names the kind of file, the number of bytes of the rest (8 bytes), its
// checksum (8 bytes), the rest.
#include "core/results/checkpoint_file.hpp"

#include "base/archive.hpp"
#include "base/format.hpp"
#include "base/names.hpp"
#include "base/text.hpp"
#include "base/write_whole.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace plyform {

namespace fs = std::filesystem;

namespace {

/// All of a checkpoint but the solver's state, which comes last.
template <class Archive>
void visit_head(Archive& a, std::string& identity, WriterState& writer) {
  StateIndex& states = writer.states;
  visit(a, identity, states.plies, states.tools, states.boundaries, states.time, states.stroke,
        states.step, states.shape, states.history);
  visit(a, writer.history, writer.xdmf.names, writer.xdmf.grids, writer.last_time,
        writer.last_step);
}

constexpr std::string_view first_line = "plyform checkpoint 6\n";
constexpr std::size_t head_bytes = first_line.size() + 2 * sizeof(std::uint64_t);

[[noreturn]] void damaged(const fs::path& path, const std::string& what) {
  throw std::runtime_error(fmt::format(
      "{}: {}; the run cannot go on: run it anew, without --resume", path.string(), what));
}

/// Text of StateIndex::shape with the numbers left out: names, and where tools and boundaries
/// begin.
std::string shape_without_numbers(const std::string& shape) {
  std::string names;
  for (std::size_t from = 0; from < shape.size();) {
    const std::size_t end = std::min(shape.find('\n', from), shape.size());
    const std::string line = shape.substr(from, end - from);
    names += line.substr(0, line.find('/')) + "\n";
    from = end + 1;
  }
  return names;
}

/// What is wrong with the writer's part of a checkpoint; empty if nothing is. Files are named,
/// found and written by it.
std::string fault_of(const WriterState& writer) {
  const StateIndex& states = writer.states;
  const std::size_t frames = states.step.size();
  if (frames == 0 || states.time.size() != frames || states.stroke.size() != frames)
    return "its states are not as many as their times";
  for (std::size_t i = 0; i < frames; ++i)
    if (!std::isfinite(states.time[i]) || !std::isfinite(states.stroke[i]) ||
        (i > 0 && (states.time[i] <= states.time[i - 1] || states.step[i] <= states.step[i - 1])))
      return "its states are not in order of time";
  if (writer.last_time != states.time.back() || writer.last_step != states.step.back())
    return "its last state is not the last of its states";
  std::string shape;
  for (const std::string& name : states.plies)
    shape += name + "\n";
  shape += "tools\n";
  for (const std::string& name : states.tools)
    shape += name + "\n";
  shape += "boundaries\n";
  for (const std::string& name : states.boundaries)
    shape += name + "\n";
  if (shape != shape_without_numbers(states.shape)) return "its names are not those of its meshes";
  for (const auto* names : {&states.plies, &states.tools, &states.boundaries})
    for (const std::string& name : *names)
      if (const std::string fault = fault_of_file_name(name); !fault.empty())
        return fmt::format("its name \"{}\" {}", shown(name), fault);
  std::vector<std::string> drawn = states.plies;
  drawn.insert(drawn.end(), states.tools.begin(), states.tools.end());
  if (writer.xdmf.names != drawn || writer.xdmf.grids.size() != drawn.size())
    return "its pictures are not those of its bodies";
  for (const Series& series : states.history) {
    const StateNumber& what = series.what;
    if (series.values.size() != frames) return "its numbers are not as many as its states";
    if (!fault_of_file_name(what.name).empty() ||
        (!what.body.empty() && !fault_of_file_name(what.body).empty()) || what.label.empty() ||
        what.word.empty() || what.unit.empty() || what.location < Location::node ||
        what.location > Location::run || what.scale < Scale::from_zero ||
        what.scale > Scale::magnitude)
      return "its numbers are not described";
  }
  const auto rows = std::count(writer.history.begin(), writer.history.end(), '\n');
  return static_cast<std::size_t>(rows) == frames + 1 ? "" : "its history has other states";
}

/// All of a checkpoint's bytes, once they are known to be of its kind, whole and unchanged.
std::string_view rest_of(const fs::path& path, std::string_view all) {
  if (!all.starts_with(first_line) || all.size() < head_bytes)
    damaged(path, "is no checkpoint of this version of plyform");
  std::uint64_t size = 0, sum = 0;
  LoadArchive head(all.substr(first_line.size()));
  visit(head, size, sum);
  const std::string_view rest = all.substr(head_bytes);
  if (size != rest.size()) damaged(path, "is damaged: it is longer or shorter than it says");
  if (checkpoint_sum(rest) != sum) damaged(path, "is damaged");
  return rest;
}

} // namespace

std::uint64_t checkpoint_sum(std::string_view bytes, std::uint64_t sum) {
  for (const char c : bytes)
    sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return sum;
}

void write_checkpoint_file(const fs::path& path, std::string identity, WriterState writer,
                           std::string_view solver) {
  SaveArchive rest;
  visit_head(rest, identity, writer);
  std::uint64_t size = solver.size();
  visit(rest, size); // as before any text; the state itself, most of the file, is not copied
  std::uint64_t bytes = rest.text().size() + solver.size(),
                sum = checkpoint_sum(solver, checkpoint_sum(rest.text()));
  SaveArchive sums;
  visit(sums, bytes, sum);
  write_whole(path, {first_line, sums.text(), rest.text(), solver});
}

std::optional<Checkpoint> read_checkpoint_file(const fs::path& path, const std::string& identity) {
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  std::string reason;
  constexpr std::size_t most = std::size_t{1} << 34; // bytes: of 10 million triangles
  const std::optional<std::string> content = read_file(path, most, reason, first_line);
  if (!content) damaged(path, reason);
  Checkpoint found;
  LoadArchive archive(rest_of(path, *content));
  try {
    visit_head(archive, found.identity, found.writer);
    visit(archive, found.solver);
  } catch (const std::runtime_error& fault) {
    damaged(path, fmt::format("is damaged: it {}", fault.what()));
  }
  if (archive.left() > 0) damaged(path, "is damaged: more follows its state");
  if (found.identity != identity)
    throw std::runtime_error(fmt::format(
        "{}: is of another case, or of other settings, files or another version of plyform; give "
        "the same ones as before, or run it anew, without --resume",
        path.string()));
  if (const std::string fault = fault_of(found.writer); !fault.empty())
    damaged(path, "is damaged: " + fault);
  return found;
}

} // namespace plyform
