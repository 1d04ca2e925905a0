#version 450 core

// The triangle that a texel sees: the visible set V(x) of the paper.
layout(location = 0) out uint id;

void main() { id = uint(gl_PrimitiveID); }
