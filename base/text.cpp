// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.hpp"

#include <algorithm>
#include <numeric>
#include <system_error>

namespace plyform {
namespace {

/// Levenshtein distance, case-insensitive.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

} // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 64; // characters: no word known is as long
  std::string nearest;
  if (word.size() > longest) return nearest;
  std::size_t least = 2 + word.size() / 4; // beyond this distance it is not a misspelling
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least && distance < candidate.size()) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text; // not fmt::join: GCC 12 warns of an overflow inside fmt 9 there
  for (const std::string& word : words)
    text += (text.empty() ? "" : between) + word;
  return text;
}

std::optional<std::string> read_text(const std::filesystem::path& file, std::string& reason) {
  return read_file(file, most_case_bytes, reason);
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_symlink(file, error)) return file.parent_path();
  const std::filesystem::path target = std::filesystem::canonical(file, error);
  return error ? file.parent_path() : target.parent_path();
}

} // namespace plyform
