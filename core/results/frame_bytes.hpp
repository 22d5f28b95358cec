// SPDX-License-Identifier: GPL-3.0-or-later
// A frame as bytes, for the way from one process to another on the same machine.
#pragma once

#include "core/results/result_writer.hpp"

#include <string>
#include <string_view>

namespace plyform {

std::string frame_to_bytes(Frame frame);

/// Throws std::runtime_error unless the bytes are exactly those of a frame.
Frame frame_from_bytes(std::string_view bytes);

} // namespace plyform
