// SPDX-License-Identifier: GPL-3.0-or-later
#define PLYFORM_LANES 8
#include "contact/simd/point_face_body.hpp"

namespace plyform {

void point_face_kernel_avx512(const PointFaceKernelPairs& pairs, PointFaceDistance* distances) {
  measure_point_faces(pairs, distances);
}

} // namespace plyform
