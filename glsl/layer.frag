#version 450 core

// What the composition needs to know of the surface's nearest layer: where it faces, how squarely, and its
// colour.
in vec3 p_view;
in vec3 normal_view;
in vec3 tint_here;

layout(location = 0) out vec4 surface;  // unit normal towards the eye, and its cosine to the line of sight
layout(location = 1) out vec4 tint;

void main() {
    vec3 to_eye = normalize(-p_view);
    vec3 normal = normalize(normal_view);
    float facing = dot(normal, to_eye);
    surface = vec4(facing < 0.0 ? -normal : normal, max(abs(facing), 0.001));
    tint = vec4(tint_here, 1.0);
}
