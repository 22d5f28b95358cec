// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/viscous_keys.hpp"

#include "core/input/keys/key_member.hpp"
#include "core/model/viscous_shear.hpp"

namespace plyform {

using K = KeyKind;

Rows viscous_shear_rows(const std::string& table) {
  const Range rate{.least = 1e-9, .most = 1e6}, torque{.least = 0.0, .most = 1e9};
  return {{.key = table + ".viscosity",
           .kind = K::numbers,
           .unit = "N mm s",
           .otherwise = "none: torque does not depend on the rate of shear",
           .instead = {"viscous"},
           .ranges = {{.least = -1e9, .most = 1e9}},
           .usual = {{.least = -1e3, .most = 1e3}},
           .least_items = 1,
           .most_items = 8,
           .meaning = "coefficients c0, c2, c4 ... of the viscous torque of one unit cell beside "
                      "the elastic one, (c0 + c2 g^2 + c4 g^4 ...) times the rate of shear in 1/s "
                      "of the process, g the shear angle in rad"},
          {.key = table + ".viscous",
           .kind = K::tables,
           .otherwise = "none",
           .instead = {"viscosity"},
           .most_items = 32,
           .meaning = "viscous torque over angle and rate, a curve each rate; linear between rates "
                      "from no torque at rest, and on beyond the last"},
          {.key = table + ".viscous[].rate",
           .unit = "1/s",
           .ranges = {rate},
           .usual = {{.least = 1e-4, .most = 100.0}},
           .meaning = "rate of shear of the curve, in rad per second of the process; ascending",
           .members = {to(&RateCurve::rate)}},
          {.key = table + ".viscous[].table",
           .kind = K::pairs,
           .unit = "deg, N mm",
           .ranges = {{.least = 0.0, .most = 90.0, .open_most = true}, torque},
           .least_items = 1,
           .meaning = "[shear angle, viscous torque of one unit cell] at that rate, what comes "
                      "beside the elastic torque; ascending from 0 degrees, constant beyond"},
          {.key = table + ".relaxation",
           .kind = K::pairs,
           .unit = "N mm, s",
           .otherwise = "none",
           .ranges = {{.least = 1e-9, .most = 1e9}, {.least = 1e-6, .most = 1e9}},
           .usual = {{.least = 1e-6, .most = 1e3}, {.least = 1e-4, .most = 1e6}},
           .least_items = 1,
           .most_items = 8,
           .meaning =
               "[G, theta] of Maxwell branches beside both: torque of one unit cell by shear "
               "angle at once, and the time of the process in which it relaxes"},
          {.key = table + ".measured_rates",
           .kind = K::numbers,
           .unit = "1/s",
           .otherwise = "not known; of viscous tables their first and last rate",
           .ranges = {rate},
           .usual = {{.least = 1e-6, .most = 100.0}},
           .count = 2,
           .meaning = "lowest and highest rate of shear at which the law was measured; results say "
                      "where the highest is exceeded, forces do not depend on it"}};
}

} // namespace plyform
