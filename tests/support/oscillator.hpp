// What a method does to an oscillator, stage by stage as methods of its kind are defined. This is an oracle for steps on bodies.
#pragma once
#include <vector>

#include "dynamics/integrator.hpp"

namespace pliant {

/// An oscillator x'' = -omega^2 x.
struct Oscillator {
  long double omega = 1;     // [1/s]
  long double x = 0, v = 0;  // [m], [m/s]
};

/// The oscillator after a step of the length h [s].
inline Oscillator after_step(const RungeKutta& method, const Oscillator& start, long double h) {
  Oscillator end = start;
  std::vector<Oscillator> stages;
  for (int i = 0; i < method.stages; ++i) {
    Oscillator stage = start;
    for (int j = 0; j < i; ++j) {
      const long double weight = h * method.a[i * method.stages + j];
      stage.x += weight * stages[j].v;
      stage.v -= weight * start.omega * start.omega * stages[j].x;
    }
    end.x += h * method.b[i] * stage.v;
    end.v -= h * method.b[i] * start.omega * start.omega * stage.x;
    stages.push_back(stage);
  }
  return end;
}

inline Oscillator after_step(const Nystrom& method, const Oscillator& start, long double h) {
  Oscillator end = start;
  end.x += h * start.v;
  std::vector<long double> accelerations;
  for (int i = 0; i < method.stages; ++i) {
    long double x = start.x + method.c[i] * h * start.v;
    for (int j = 0; j < i; ++j) x += h * h * method.a[i * method.stages + j] * accelerations[j];
    accelerations.push_back(-start.omega * start.omega * x);
    end.x += h * h * method.b[i] * (1 - method.c[i]) * accelerations[i];
    end.v += h * method.b[i] * accelerations[i];
  }
  return end;
}

}  // namespace pliant
