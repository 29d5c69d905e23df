// Writes where forces see vertex i on axis k: its position and displacement in the body's unit of length, rounded to `real`. Both are
// relative to a reference of the body. Forces depend on differences alone, so a common reference costs nothing and saves digits.
// `rest` is the rest position, `relative` the displacement less the reference [m]. The array is of single numbers because shaders
// branch to reach a component of a vector.
void place(uint slot, uint i, uint k, double inverse_unit, double rest, double relative) {
  placement[number_of(position_at(slot, vertex_count, i), k)] = real(inverse_unit * (rest + relative));
  placement[number_of(displacement_at(slot, vertex_count, i), k)] = real(inverse_unit * relative);
}
