#version 450 core

// Which of the draw's triangles a texel sees.
layout(location = 0) out uint id;

void main() { id = uint(gl_PrimitiveID); }
