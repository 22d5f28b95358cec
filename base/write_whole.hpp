// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are written whole or not at all.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <system_error>

namespace plyform {

/// Writes `content` to `path` + ".tmp" and renames it to `path` when it is complete. Throws
/// std::runtime_error naming the path and the system's reason; the temporary file is then removed.
void write_whole(const std::filesystem::path& path, std::string_view content);
/// Likewise all parts, one after the other.
void write_whole(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

/// The same for what a run can do without: not waited for until it is on the disk, and no error;
/// returns whether it was written.
bool write_if_possible(const std::filesystem::path& path, std::string_view content);

/// Throws std::runtime_error: "PATH: cannot WHAT: the system's reason".
[[noreturn]] void throw_cannot(const std::filesystem::path& path, const char* what,
                               const std::error_code& error);

} // namespace plyform
