// Earth's air as a medium, for outdoor scenes of some kilometres up to 100.
#pragma once

#include <tyndall/tyndall.h>

namespace tyndall {

/// Clear weather: molecules and aerosols as Bruneton and Neyret 2008 have them, of which densities fall to 1/e in 8 and
/// in 1.2 km.
struct Atmosphere {
  double metre = 1;    ///< world units that a metre is, > 0
  Vec3 up = {0, 1, 0}; ///< any length but 0
  double seaLevel = 0; ///< its height along up, world units
  double haze = 1;     ///< of aerosols, times as much; >= 0
};

/// The air as a Medium: Rayleigh and Cornette-Shanks scattering and the aerosols' absorption, in two layers. Rays to
/// the sky end after 100 km. What breaks a rule makes a medium that render() refuses.
///
/// The ground is flat: of a level ray of 100 km at sea level the molecules' optical depth is 3 % and the aerosols' 22 %
/// more than over a round Earth, of one of 30 km 0.3 % and 2 %. Ozone, which is far above, dims only the sun's light.
Medium airOf(const Atmosphere& atmosphere);

/// The share of the sun's light that the air above a height (world units along Atmosphere::up) lets through, ozone and
/// a round Earth's longer ways included: what to multiply Light::colour by, which airOf()'s medium does not dim before
/// it reaches the scene. elevation: of the sun over the horizon, radians; 0 below it. From 0 to 11 km: to 1 % of the
/// optical depth from 10 degrees on, 4 % at the horizon (Smith and Smith 1972, "Numerical evaluation of Chapman's
/// grazing incidence integral").
Rgb sunThroughAir(const Atmosphere& atmosphere, double height, double elevation);

} // namespace tyndall
