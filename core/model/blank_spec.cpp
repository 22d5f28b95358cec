// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/blank_spec.hpp"

namespace plyform {

void scale_elements(BlankSpec& blank, double by) {
  blank.element_size *= by;
  for (MeshZone& zone : blank.zones)
    zone.element_size *= by;
  if (!blank.sizes) return;
  for (double& size : blank.sizes->size)
    size *= by;
}

} // namespace plyform
