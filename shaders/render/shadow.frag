#version 450
// The shadow map keeps depth alone.
void main() {}
