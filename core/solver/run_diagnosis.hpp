// SPDX-License-Identifier: GPL-3.0-or-later
// What a run did with its time, pair by pair, and what it modelled too much or too little.
#pragma once

#include "core/results/result_writer.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Of a scene at its end and its last frame. `contact`: the audit's counts.
WorkReport report_work(const Scene& scene, const Frame& last, const ContactReport& contact);

} // namespace plyform
