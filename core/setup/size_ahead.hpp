// SPDX-License-Identifier: GPL-3.0-or-later
// What a case will take, estimated before any mesh is made: triangles, memory, time.
#pragma once

#include "core/model/case.hpp"

namespace plyform {

struct SizeAhead {
  double triangles = 0.0; ///< of all plies; those of mesh files are not known and left out
  double bytes = 0.0;     ///< of memory, about
  double seconds = 0.0;   ///< of wall time, about
  int largest = 0;        ///< index of the blank with the most triangles
};

/// threads: that share the work.
SizeAhead size_ahead(const Case& data, int threads);

/// Bytes of memory, about, that a run with so many triangles of all plies takes at its peak.
double bytes_for(double triangles);

/// Bytes of memory that this machine has.
double machine_memory();

/// More than half of the memory, or more than a day: nobody starts that by mistake and is happy.
bool too_large(const SizeAhead& size, double memory);

} // namespace plyform
