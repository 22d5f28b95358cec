// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/results/frame.hpp"
#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Plies that are colder or hotter in a state than their laws are known for, a sentence each.
std::vector<std::string> doubts_of_temperature(const Scene& scene, const Frame& last);

} // namespace plyform
