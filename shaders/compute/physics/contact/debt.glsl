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

// The energies of the motion of a body, or of several as one [J], and what is owed.
struct Means {
  double deformation;  // kinetic energy of the velocities less the rigid motion
  double rigid;        // kinetic energy of the rigid motion, if it may be taken; else 0
  double missed;       // the part of that energy in ways not made: m v . missing / (2 h), summed
  double due;
};

// What remains of velocities, so that the energy due is gone: first of the deformation's, then of the rigid motion's.
FN double kept_of_deformation(IN(Means) m) {
  if (m.due == double(0)) return double(1);
  return m.deformation > m.due ? sqrt(double(1) - m.due / m.deformation) : double(0);
}
// Of a rigid motion that may be taken no more remains than was made.
FN double kept_of_rigid_motion(IN(Means) m) {
  if (!(m.rigid > double(0))) return double(1);
  double left = max(m.due - m.deformation, double(0));
  double paid = m.rigid > left ? sqrt(double(1) - left / m.rigid) : double(0), made = double(1) - m.missed / m.rigid;
  return max(min(paid, min(made, double(1))), double(0));
}
FN double owed_after(IN(Means) m) { return max(m.due - m.deformation - m.rigid, double(0)); }

SHARED_END
#endif
