// Makes two bodies that meet off their centres.
#pragma once
#include <string>

#include "mesh/triangle_mesh.hpp"
#include "model/model.hpp"

namespace pliant::bench {

/// One of the two. Its mesh is scaled to the radius.
struct Partner {
  TriangleMesh mesh;
  double radius = 1;       // [m]
  double mass = 1;         // of the body [kg]
  double stiffness = 1e3;  // of all springs at a vertex together, N k [N/m]
};

/// How they meet. Lengths count in the shorter one of the meshes' mean edges.
struct Encounter {
  double edges_a_step = 0.2;  // how fast they come near each other
  double omega_step = 0.5;    // the step, times the stiffest frequency of both
  double distance = 0.5;      // of their boxes at the start, at least; more for fast bodies, which begin a step apart
  double off_centre = 0.15;   // how far either is beside the line they meet on, in radii of the smaller one
  double far_away = 0;        // how far the place they meet at is from the origin, along each axis [m]
  double stretch = 1;         // of both along their own x axes
  bool left_comes = false;    // alone, and the right one rests; otherwise they have no momentum together
};

struct Meeting {
  ModelAndState start;
  double time_step = 0;  // [s]
  double edge = 0;       // [m]
  double speed = 0;      // [m/s]
};

/// The first body comes from the left along x, the second from the right.
[[nodiscard]] Meeting meeting_of(const Partner& left, const Partner& right, const Encounter& how);

}  // namespace pliant::bench
