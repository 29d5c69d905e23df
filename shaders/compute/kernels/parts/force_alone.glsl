// What a force kernel is that only stores what it sums: it loads nothing beside, does not damp and moves no vertex.
struct Pending {
  bool nothing;
};

Pending before_force(uint i, uint k, IN(Share) s) {
  Pending p;
  p.nothing = true;
  return p;
}

struct Damping {  // it does not damp
  bool nothing;
};

Damping damping_by(IN(Share) s, double force_squared) {
  Damping d;
  d.nothing = true;
  return d;
}

bool settles() { return false; }
void settle(uint i, uint k, IN(Share) s, IN(dvec3) position) {}
