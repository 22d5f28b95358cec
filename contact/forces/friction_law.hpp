// SPDX-License-Identifier: GPL-3.0-or-later
// What two faces that slide on each other resist with, where it is more than one coefficient.
//
//   v     mm/s      slip speed in the process;  p  N/mm^2  normal pressure;  y  mm  slip of a step
//   eta   N s/mm^2  viscosity of the matrix between them, at the film's rate v / h if it thins, by
//                   f(T) where it follows the temperature
//   T     degC      temperature of the film: the mean of those of both bodies there, as one side of
//                   it has that of the one and the other that of the other
//   h     mm        thickness of the film
//   H     mm        eta v / p, the Hersey number: a length
//   f_a   -         factor by the angle between the fibres of both faces
//   f_s   -         factor by the way slid since they touched: a peak at the start
//   f_w   -         factor by the way slid since the start, also before the faces parted: they wear
//                   in, as coatings and loose fibrils do
//   tau_t N/mm^2    tack, by the same way
//
//   Coulomb           tau = f_a f_s f_w mu p + tau_t
//   over Hersey's     tau = f_a f_s mu(H) p + tau_t
//   film              tau = f_a f_s (tau_0 + eta v / h) + tau_t                              (L)
//
// beyond the last Hersey number of a curve mu stays what it is there (Coulomb), or rises in
// proportion to H, which is a film of thickness H / mu (ten Thije et al., Composites A 42:950,
// 2011; Harrison et al., World J. Eng. 7:5, 2010: one curve for all pressures, speeds and
// temperatures). A film bears shear whatever presses the faces, and also where they have opened by
// less than its thickness, as it sticks to both.
//
// (L) is the bound of (T) of contact/forces/contact_law.hpp with the speed of the end of the step:
// of the stretch S that the spring k_t would have without slip
//
//   k_t (S - y) = tau(y / dt),  dt: s, the time that the step takes in the process          (I)
//
// whose left side falls and whose right side rises with y, so that it has one answer. It is
// backward Euler's rule of a spring and a dashpot in series: stable at any step, and the spring
// alone counts for the stable one.
//
// Where mu falls with H, as on the left of a Stribeck curve, friction at the speed of the moment
// would set every spring swinging, that of the contact, a number of the solver, first of all: such
// a law alone says nothing of the motion of what is elastic. What was measured is the friction of
// steady sliding, which surfaces take a while to find: they answer a sudden change of speed with a
// rise, and come to the steady value while the speed stays (Dieterich, J. Geophys. Res. 84, 1979;
// Ruina, ibid. 88, 1983, both of rock). With the falls of mu up to a Hersey number, and the speed u
// at which the place slid lately,
//
//   F(H) = int_0^H max(-dmu/dH, 0) dH,  du/dt = (|v| - u) / T                               (M)
//   tau = f_a f_s p (mu(H(v)) + 2 F(H(v)) - 2 F(H(u))) + tau_t, at least 0                  (R)
//
// which is (L) when v = u, and rises with v at a given u by |dmu/dH|. A spring k under it slides
// steadily if k T > -dtau/dv, whatever the step; a mass on it, if also T is longer than its swing
// over 2 pi. T is memory_share of the duration, as tools' forces are told over such a time
// (core/solver/force_filter.hpp). Laws that only rise do not ask for u.
#pragma once

#include "contact/simd/contact_points.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plyform {

/// A point of a curve.
struct CurvePoint {
  double at, value;
};

/// Straight pieces through points in ascending order, level beyond both ends.
double on_pieces(std::span<const CurvePoint> points, double at);
/// Straight pieces in a plot of logarithms, all points above 0; level beyond both ends.
double on_log_pieces(std::span<const CurvePoint> points, double at);

/// A function of positive numbers, sampled so finely over each octave that straight pieces do, as
/// the laws ask for it many times a step.
class OctaveTable {
public:
  struct Answer {
    double value, slope;
  };
  OctaveTable() = default;
  /// Of f from 2^low to 2^high; below straight to `at_zero`.
  OctaveTable(const std::function<double(double)>& f, int low, int high, double at_zero);
  /// Beyond the highest level, or in proportion.
  Answer at(double x, bool proportional) const;
  /// How far f has fallen in all from 0 on, F of (M); level beyond the highest.
  OctaveTable falls() const;

private:
  static constexpr int pieces = 32; ///< of an octave: 1e-4 of the value
  int low_ = 0;
  double least_ = 0.0, most_ = 0.0, at_zero_ = 0.0;
  std::vector<double> value_;
};

/// f(T) of (L).
struct FilmFlow {
  std::function<double(double celsius)> factor; ///< empty: 1 at all temperatures
  double least = 0.0, most = 0.0;               ///< degC, between which it is known
};

/// Numbers of (L), as they are given.
struct FrictionLawSpec {
  enum class Kind { coulomb, hersey, film };
  std::string name; ///< in the case
  Kind kind = Kind::coulomb;
  double coefficient = 0.0;      ///< mu of Coulomb's law
  std::vector<CurvePoint> curve; ///< mu over H (mm); empty: by the formula
  /// mu = boundary exp(-H / transition) + hydrodynamic H^exponent, H in mm
  double boundary = 0.0, transition = 0.0, hydrodynamic = 0.0, exponent = 1.0;
  bool film_beyond = false;                ///< mu in proportion to H beyond the curve
  double viscosity = 0.0;                  ///< eta, N s/mm^2
  std::vector<CurvePoint> viscosity_curve; ///< eta over rate (1/s), instead
  FilmFlow flow{};                         ///< on the viscosity
  double film = 0.0;                       ///< h, mm; 0: not given
  double yield = 0.0;                      ///< tau_0, N/mm^2
  std::vector<CurvePoint> over_angle;      ///< f_a over rad, 0 to pi/2; empty: 1
  std::vector<CurvePoint> over_slip;       ///< f_s over mm; empty: 1
  std::vector<CurvePoint> over_wear;       ///< f_w over mm, of Coulomb's law; empty: 1
  std::vector<CurvePoint> tack;            ///< tau_t over mm; empty: none

  bool has_rates() const { return kind != Kind::coulomb; }
  /// Whether it is Coulomb's law with one coefficient.
  bool plain() const {
    return !has_rates() && over_angle.empty() && over_slip.empty() && over_wear.empty() &&
           tack.empty();
  }
  /// mm, thickness of the film that needs no pressure; 0: there is none.
  double film_thickness() const;
  double hersey(double number) const;     ///< mu at a Hersey number (mm)
  double viscosity_at(double rate) const; ///< N s/mm^2, at 1/s, where f(T) is 1
  /// f(T); 1 at NaN, a temperature that is not known.
  double flow_at(double celsius) const {
    return flow.factor && !std::isnan(celsius) ? flow.factor(celsius) : 1.0;
  }
};

/// Where a run was in the range of a curve: all of it that slid, by its work.
struct RangeSeen {
  double least = 1e300, most = -1e300;         ///< of mm, 1/s or degC
  double work = 0.0, below = 0.0, above = 0.0; ///< N mm: all; outside the curve's two ends
  void add(double at, double work_here, const CurvePoint& first, const CurvePoint& last);
  void add(const RangeSeen& more);
  bool finite() const { return std::isfinite(least + most + work + below + above); }
};

/// Of a contact, since the start: Hersey numbers, rates of the film, and its temperatures where its
/// viscosity follows them.
struct SlidingSeen {
  RangeSeen hersey, rate, temperature;
  double unsteady = 0.0; ///< N mm, of the work, where (R) is off the curve by more than a tenth
  bool finite() const {
    return hersey.finite() && rate.finite() && temperature.finite() && std::isfinite(unsteady);
  }
  void add(const SlidingSeen& more) {
    unsteady += more.unsteady;
    hersey.add(more.hersey);
    rate.add(more.rate);
    temperature.add(more.temperature);
  }
};

/// A law ready to be asked.
class FrictionLaw {
public:
  explicit FrictionLaw(FrictionLawSpec spec);
  const FrictionLawSpec& spec() const { return spec_; }
  bool has_rates() const { return spec_.has_rates(); }
  /// Whether its friction falls with the speed anywhere.
  bool falls() const { return falls_.has_value(); }
  /// Whether it keeps a number of each place, SlidingPlace::kept: the speed u of (M), mm/s, of a
  /// law that falls, or the way slid, mm, of one that wears.
  bool keeps() const { return falls() || !spec_.over_wear.empty(); }
  /// Before a place is asked for. u of one whose faces have just met is the speed at which they
  /// slide then. per_dt: 1/s, as of `stuck`.
  void begin(const SlidingPlace& place, double per_dt) const;
  /// After a step in which it slid by y (mm): (M), exact for a speed that stays, of memory T (s).
  void follow(const SlidingPlace& place, double y, double per_dt, double memory) const;
  /// f_a at an angle (rad).
  double by_angle(double angle) const;
  /// tau at a speed (mm/s) and its slope by that: (R), or (L) without place.kept. viscosity:
  /// f(T).
  OctaveTable::Answer traction(const SlidingPlace& place, double speed, double viscosity) const;
  /// S - y of (I), mm. per_dt: 1/s, inverse of dt; 0 where no time has passed: all of it is kept.
  double stuck(const SlidingPlace& place, double per_dt, double viscosity) const;
  /// Notes what a slip of y (mm) went by.
  void note(const SlidingPlace& place, double y, double per_dt, double viscosity,
            SlidingSeen& seen) const;

private:
  /// mu at H, or what (R) has in its place, and its slope.
  OctaveTable::Answer coefficient(const SlidingPlace& place, double number, double viscosity,
                                  double pressure) const;
  /// eta v, N/mm.
  double drag(double speed, double viscosity) const;

  FrictionLawSpec spec_;
  OctaveTable flow_;   ///< eta times rate, N/mm^2, over the rate, 1/s; or eta v over v without h
  OctaveTable hersey_; ///< mu over mm
  std::optional<OctaveTable> falls_; ///< F over mm; nothing: mu does not fall
};

/// T of (M) over the duration of a run.
constexpr double memory_share = 1.0 / 200.0;

using FrictionLawPtr = std::shared_ptr<const FrictionLaw>;

/// For checkpoints: base/archive.hpp.
template <class F>
void each_member(RangeSeen& seen, F&& f) {
  auto& [least, most, work, below, above] = seen;
  f("least", least);
  f("most", most);
  f("work", work);
  f("below", below);
  f("above", above);
}
template <class F>
void each_member(SlidingSeen& seen, F&& f) {
  auto& [hersey, rate, temperature, unsteady] = seen;
  f("hersey", hersey);
  f("rate", rate);
  f("temperature", temperature);
  f("unsteady", unsteady);
}

} // namespace plyform
