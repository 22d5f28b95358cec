// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/kept_sizes.hpp"

#include "base/format.hpp"
#include "base/read_file.hpp"
#include "base/write_whole.hpp"
#include "core/results/checkpoint_file.hpp"
#include "core/results/size_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <elf.h>
#include <link.h>

namespace plyform {
namespace {

constexpr std::uintmax_t most_bytes = 200'000'000; // of all that is kept
constexpr std::size_t most_words = 4096;

/// The build id that the linker gave to the program or library this function is in; empty if none.
std::string build_id() {
  std::string id;
  const auto look = [](dl_phdr_info* info, std::size_t, void* found) -> int {
    const auto here = reinterpret_cast<ElfW(Addr)>(&build_id);
    bool ours = false;
    for (int k = 0; k < info->dlpi_phnum; ++k) {
      const auto& part = info->dlpi_phdr[k];
      const ElfW(Addr) begin = info->dlpi_addr + part.p_vaddr;
      ours = ours || (part.p_type == PT_LOAD && here >= begin && here < begin + part.p_memsz);
    }
    if (!ours) return 0;
    for (int k = 0; k < info->dlpi_phnum; ++k) {
      const auto& part = info->dlpi_phdr[k];
      if (part.p_type != PT_NOTE) continue;
      const auto* at = reinterpret_cast<const char*>(info->dlpi_addr + part.p_vaddr);
      const char* end = at + part.p_memsz;
      while (at + sizeof(ElfW(Nhdr)) <= end) {
        ElfW(Nhdr) note;
        std::memcpy(&note, at, sizeof note);
        const auto padded = [](std::size_t n) { return (n + 3) / 4 * 4; };
        const char* content = at + sizeof note + padded(note.n_namesz);
        if (note.n_type == NT_GNU_BUILD_ID)
          static_cast<std::string*>(found)->assign(content, note.n_descsz);
        at = content + padded(note.n_descsz);
      }
    }
    return 1;
  };
  dl_iterate_phdr(look, &id);
  return id;
}

/// Nothing where there is no home or no build id.
std::filesystem::path file_of(const std::string& identity) {
  const auto value = [](const char* name) {
    const char* text = std::getenv(name);
    return std::filesystem::path(text ? text : "");
  };
  std::filesystem::path folder = value("XDG_CACHE_HOME");
  if (!folder.is_absolute()) folder = value("HOME") / ".cache";
  static const std::string build = build_id();
  if (!folder.is_absolute() || build.empty()) return {};
  return folder / "plyform" /
         fmt::format("{:016x}", checkpoint_sum(identity, checkpoint_sum(build)));
}

/// Removes the oldest files until the others take less than most_bytes.
void make_room(const std::filesystem::path& folder) {
  struct Kept {
    std::filesystem::file_time_type time;
    std::filesystem::path path;
    std::uintmax_t bytes;
  };
  std::error_code none;
  std::vector<Kept> files;
  std::uintmax_t all = 0;
  for (std::filesystem::directory_iterator at(folder, none), end; at != end; at.increment(none)) {
    const std::uintmax_t bytes = at->file_size(none);
    if (none) continue;
    files.push_back({at->last_write_time(none), at->path(), bytes});
    all += bytes;
  }
  std::sort(files.begin(), files.end(),
            [](const Kept& a, const Kept& b) { return a.time < b.time; });
  for (const Kept& file : files) {
    if (all <= most_bytes) return;
    std::filesystem::remove(file.path, none);
    all -= file.bytes;
  }
}

/// What stands beside the sizes: the sum of their bytes, then what their scout has left unseen.
std::filesystem::path words_beside(std::filesystem::path file) {
  return file += ".words";
}

std::string words_of(const std::string& sizes, const std::string& ended) {
  return fmt::format("{:016x}\n{}", checkpoint_sum(sizes), ended);
}

} // namespace

std::optional<Scouted> kept_sizes(const std::string& identity, std::size_t plies) {
  const std::filesystem::path file = file_of(identity);
  std::error_code none;
  if (file.empty() || !std::filesystem::exists(file, none)) return std::nullopt;
  std::string reason;
  const std::optional<std::string> words = read_file(words_beside(file), most_words, reason);
  if (!words || words->find('\n') == std::string::npos) return std::nullopt;
  Scouted kept;
  kept.ended = words->substr(words->find('\n') + 1);
  try {
    const std::vector<PlySizes> found = read_sizes(file);
    if (found.size() != plies || words_of(text_of(found), kept.ended) != *words)
      return std::nullopt;
    for (const PlySizes& ply : found)
      kept.sizes.push_back(ply.sizes);
  } catch (const std::runtime_error&) { // damaged: it is found anew
    return std::nullopt;
  }
  return kept;
}

void keep_sizes(const std::string& identity, const Scouted& scouted) {
  const std::filesystem::path file = file_of(identity);
  if (file.empty()) return;
  std::error_code none;
  std::filesystem::create_directories(file.parent_path(), none);
  std::vector<PlySizes> plies;
  for (std::size_t p = 0; p < scouted.sizes.size(); ++p)
    plies.push_back({fmt::format("{}", p), scouted.sizes[p]});
  const std::string sizes = text_of(plies);
  if (write_if_possible(words_beside(file), words_of(sizes, scouted.ended)) &&
      write_if_possible(file, sizes))
    make_room(file.parent_path());
}

} // namespace plyform
