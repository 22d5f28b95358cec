// SPDX-License-Identifier: GPL-3.0-or-later
// Text functions: reading a file, joining words, suggesting a word for a misspelt one.
#pragma once

#include "base/read_file.hpp"
#include "base/words.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// The word of `known` nearest to `word` by edit distance; empty if that exceeds 1 + length / 4.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// "a, b, c", or with other text between them.
std::string joined(const std::vector<std::string>& words, const std::string& between = ", ");

/// The content of a case or fabric file, as of read_file.
std::optional<std::string> read_text(const std::filesystem::path& file, std::string& reason);

/// The folder that a file lies in, from which the paths in it are seen; of a symbolic link that of
/// the file that it leads to.
std::filesystem::path folder_of(const std::filesystem::path& file);

} // namespace plyform
