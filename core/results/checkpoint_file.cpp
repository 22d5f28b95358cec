// SPDX-License-Identifier: GPL-3.0-or-later
// Layout: a line that names the first_line of file, the checksum of the rest (8 bytes), the rest.
#include "core/results/checkpoint_file.hpp"

#include "core/base/archive.hpp"
#include "core/base/text.hpp"

#include <cstdint>
#include <fmt/format.h>
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
        states.step, states.shape);
  visit(a, writer.history, writer.xdmf.names, writer.xdmf.grids, writer.last_time,
        writer.last_step);
}

constexpr std::string_view first_line = "plyform checkpoint 1\n";

/// FNV-1a, 64 bits (Fowler, Noll, Vo; RFC 9923). sum: of the bytes before these.
std::uint64_t checksum(std::string_view bytes, std::uint64_t sum = 14695981039346656037ULL) {
  for (const char c : bytes)
    sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return sum;
}

[[noreturn]] void damaged(const fs::path& path, const std::string& what) {
  throw std::runtime_error(fmt::format(
      "{}: {}; the run cannot go on: run it anew, without --resume", path.string(), what));
}

} // namespace

void write_checkpoint_file(const fs::path& path, std::string identity, WriterState writer,
                           std::string_view solver) {
  SaveArchive head;
  visit_head(head, identity, writer);
  std::uint64_t size = solver.size();
  visit(head, size); // as before any text; the state itself, most of the file, is not copied
  std::uint64_t sum = checksum(solver, checksum(head.text()));
  SaveArchive sums;
  visit(sums, sum);
  write_whole(path, {first_line, sums.text(), head.text(), solver});
}

std::optional<Checkpoint> read_checkpoint_file(const fs::path& path, const std::string& identity) {
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  std::string reason;
  const std::optional<std::string> content = read_text(path, reason);
  if (!content) damaged(path, reason);
  const std::string_view all = *content;
  std::uint64_t sum = 0;
  if (!all.starts_with(first_line) || all.size() < first_line.size() + sizeof(sum))
    damaged(path, "is no checkpoint of this version of plyform");
  LoadArchive head(all.substr(first_line.size(), sizeof(sum)));
  visit(head, sum);
  const std::string_view rest = all.substr(first_line.size() + sizeof(sum));
  if (checksum(rest) != sum) damaged(path, "is damaged");
  Checkpoint found;
  LoadArchive archive(rest);
  visit_head(archive, found.identity, found.writer);
  visit(archive, found.solver);
  if (found.identity != identity)
    throw std::runtime_error(fmt::format(
        "{}: is of another case, or of other settings, files or another version of plyform; give "
        "the same ones as before, or run it anew, without --resume",
        path.string()));
  return found;
}

} // namespace plyform
