// What a body owes: motions that were cut short leave its springs with energy, and contacts that did not settle may give some.
#ifndef DEBT_GLSL
#define DEBT_GLSL
#include "../language.glsl"
SHARED_BEGIN

struct Debt {
  double energy;     // that is still owed [J]
  double lost[3];    // momentum that the body gave for it to what does not move, in the latest step [Ns]
  uint is_for_cuts;  // 1: cuts made some of it
  uint padding;
};

// The energies of a body's motion [J], and what it owes.
struct Means {
  double deformation;  // kinetic energy of the velocities less the rigid motion
  double rigid;        // kinetic energy of the rigid motion, if it may be taken; else 0
  double due;
};

// What a body keeps of its velocities, so that the energy due is gone: first of the deformation's, then of the rigid motion's.
FN double kept_of_deformation(IN(Means) m) { return m.deformation > m.due ? sqrt(double(1) - m.due / m.deformation) : double(0); }
FN double kept_of_rigid_motion(IN(Means) m) {
  double left = max(m.due - m.deformation, double(0));
  if (left == double(0) || m.rigid == double(0)) return double(1);
  return m.rigid > left ? sqrt(double(1) - left / m.rigid) : double(0);
}
FN double owed_after(IN(Means) m) { return max(m.due - m.deformation - m.rigid, double(0)); }

SHARED_END
#endif
