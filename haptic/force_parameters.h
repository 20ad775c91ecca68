// All constants of the forces, with units and sources, and the limits of a device.
#pragma once

namespace cleft {

struct ForceParameters {
  // Before puncture.
  double stiffness = 0.3;       ///< N/mm along the normal; surface_stiffness.h computes it from a field
  double puncture_force = 0.8;  ///< N; a scalpel enters phantom gel at 0.5 to 1.2 N
  double puncture_time = 0.03;  ///< s in which the elastic force falls and drag and resistance rise

  // After puncture.
  double drag = 0.002;  ///< N s/mm, the paper's b in -b v; half of what the devices below render
  double cutting_resistance =
      0.05;  ///< N per mm of depth against the edge's way: 0.5 N at 10 mm, as in the gel
  double resistance_speed =
      5;  ///< mm/s: below it the resistance decreases (tanh), so that a blade at rest is not driven
  double blade_length = 10;  ///< mm from the tip: the part that cuts or touches
  double blade_half_thickness =
      0.2;  ///< mm; at twice this distance from the walls of a wound the blade is free

  // Perception and safety.
  double change = 0.07;  ///< largest change a tick over the force: the just noticeable difference (Pang 1991)
  double floor = 0.02;   ///< N, change in a tick that is always permitted
  double velocity_time = 0.005;    ///< s, time constant of the velocity filter
  double energy_allowance = 0.05;  ///< N mm (mJ) at the beginning of a contact; see passivity.h
  double hand_acceleration = 1e4;  ///< mm/s^2, largest acceleration of a hand
  double moving_mass = 0.045;      ///< kg, least mass that a force accelerates: that of the Touch at its tip
};

/// The limits of stable rendering of a device; N, N/mm, N s/mm, s.
struct DeviceLimits {
  double max_force = 3.3;      ///< of the 3D Systems Touch, as CHAI3D ships them
  double max_stiffness = 0.4;  ///< K < 2 b / T with the device's own damping b (Colgate and Brown 1994)
  double max_damping = 0.004;
  double latency = 0;  ///< from a pose to its force, in addition to the tick
};

}  // namespace cleft
