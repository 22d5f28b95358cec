// SPDX-License-Identifier: GPL-3.0-or-later
// The largest pressure that a sheet of rubber bears. A sphere blown up from the radius R to l R by
// a pressure p, of rubber with the equibiaxial load N(l) per width before forming, has
//
//   p = 2 N(l) / (R l^2)                                                                    (P)
//
// whose maximum, the limit point, a neo-Hookean sheet has at l = 7^(1/6) = 1.38: beyond it more
// stretch bears less pressure, and under a pressure that does not fall no balance exists before
// the sheet meets a tool. A sheet of another shape has one near it (L. R. G. Treloar, The Physics
// of Rubber Elasticity, 3rd ed. (1975), section 5.4; A. Needleman, Int. J. Solids Struct. 13 (1977)
// 409-421).
#pragma once

#include "core/solver/layup.hpp"

#include <string>

namespace plyform {

/// What a fault or a doubt says of a ply under a pressure whose rubber is stretched somewhere to
/// where (P) falls, with a remedy; empty of others.
std::string beyond_limit_pressure(const Layup& layup, std::size_t ply);

} // namespace plyform
