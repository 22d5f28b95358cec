// SPDX-License-Identifier: GPL-3.0-or-later
// All of FCL, without the warnings of its headers.
#pragma once

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#include <fcl/fcl.h>
#pragma GCC diagnostic pop
