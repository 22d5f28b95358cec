// SPDX-License-Identifier: GPL-3.0-or-later
// What a program may write over: its own outputs of before, never what it reads or what others have
// written. The Python programs' counterpart is tools/base/outputs.py.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace plyform {

/// An output that would take the place of a file that is not its own; the message ends with the
/// remedy. The program then ends with exit code 2.
class WouldOverwrite : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The first of the other files that writing `output` would replace: itself, under any name, or the
/// file that has its temporary name. Nothing if there is none.
std::optional<std::filesystem::path>
file_overwritten(const std::filesystem::path& output,
                 const std::vector<std::filesystem::path>& others);

/// Throws WouldOverwrite if there is such a file.
void keep_files(const std::filesystem::path& output,
                const std::vector<std::filesystem::path>& others);

/// Throws WouldOverwrite if `output` is a file that does not have `mark` in its first 64 KiB, by
/// which plyform's own of this name is known. Of what is empty nothing is lost.
void keep_foreign(const std::filesystem::path& output, std::string_view mark);

/// Throws WouldOverwrite if `folder` is a link: what is written would be written where it leads.
void keep_out_of_link(const std::filesystem::path& folder);

} // namespace plyform
