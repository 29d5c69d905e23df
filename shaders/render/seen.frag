#version 450
// Which triangle a sample sees, counted from 1.
layout(location = 0) out uint seen;

void main() { seen = uint(gl_PrimitiveID) + 1u; }
