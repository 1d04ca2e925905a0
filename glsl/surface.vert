#version 450 core

// The model's surface in a picture, every corner with its own normal.
layout(location = 0) in vec3 p_world;
layout(location = 1) in vec3 normal_world;
layout(location = 2) in vec3 tint_of_corner;

uniform mat4 clip_from_view;
uniform mat4 view_from_world;

out vec3 p_view;
out vec3 normal_view;
out vec3 tint_here;

void main() {
    vec4 p = view_from_world * vec4(p_world, 1.0);
    p_view = p.xyz;
    normal_view = mat3(view_from_world) * normal_world;
    tint_here = tint_of_corner;
    gl_Position = clip_from_view * p;
}
