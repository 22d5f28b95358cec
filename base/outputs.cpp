// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/outputs.hpp"

#include "base/format.hpp"

#include <fstream>
#include <string>

namespace plyform {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t head_bytes = 1U << 16U; // headings and attributes stand in the first few KB

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored) ||
         fs::equivalent(a, b, ignored);
}

} // namespace

std::optional<fs::path> file_overwritten(const fs::path& output,
                                         const std::vector<fs::path>& others) {
  fs::path temporary = output;
  temporary += ".tmp";
  for (const fs::path& other : others)
    if (same_file(output, other) || same_file(temporary, other)) return other;
  return std::nullopt;
}

void keep_files(const fs::path& output, const std::vector<fs::path>& others) {
  if (const std::optional<fs::path> lost = file_overwritten(output, others))
    throw WouldOverwrite(fmt::format("{}: would overwrite {}, which is read; give another folder",
                                     output.string(), lost->string()));
}

void keep_foreign(const fs::path& output, std::string_view mark) {
  std::error_code ignored;
  if (!fs::is_regular_file(output, ignored)) return;
  std::string head(head_bytes, '\0');
  std::ifstream file(output, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  if (head.empty() || head.find(mark) != std::string::npos) return;
  throw WouldOverwrite(fmt::format("{}: would overwrite it, and it is no file of a run of plyform; "
                                   "move it away, or give another folder",
                                   output.string()));
}

void keep_out_of_link(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_symlink(folder, ignored))
    throw WouldOverwrite(fmt::format("{}: is a link: would overwrite files where it leads; remove "
                                     "it, or give another folder",
                                     folder.string()));
}

} // namespace plyform
