// SPDX-License-Identifier: GPL-3.0-or-later
// The one reader of files that users bring. What is opened is a regular file and no larger than
// files of its kind are: a pipe, a device or a file of the kernel may have no end, or never begin.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace plyform {

// Bytes that are read of a file at most, by its kind.
constexpr std::size_t most_case_bytes = std::size_t{4} << 20; ///< each value takes 500 bytes here
constexpr std::size_t most_curve_bytes = std::size_t{64} << 20;
constexpr std::size_t most_drawing_bytes = std::size_t{256} << 20;
constexpr std::size_t most_mesh_bytes = std::size_t{1} << 30; ///< 20 million facets of binary STL

/// The content of a regular file of at most `most` bytes; or nothing, and the reason: "is a pipe,
/// not a file", "cannot be opened: No such file or directory".
/// begin: bytes that it must begin with, or no more than these are read.
std::optional<std::string> read_file(const std::filesystem::path& file, std::size_t most,
                                     std::string& reason, std::string_view begin = {});

/// Why a file is not to be opened by a library that opens it itself; empty if it can be.
std::string fault_of_file(const std::filesystem::path& file, std::size_t most);

} // namespace plyform
