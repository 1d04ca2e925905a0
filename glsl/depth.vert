#version 450 core
#extension GL_ARB_shader_viewport_layer_array : require

// One draw puts the triangles that may show on one face of one eye's cube map into that face's layer.
layout(location = 0) in vec3 p_world;
layout(location = 1) in uint layer;  // 6 * eye + face; a step per draw, by its base instance

layout(std430, binding = 0) readonly buffer Eyes { vec4 eyes[]; };

uniform float near_plane;
uniform mat3 face_from_world[6];

void main() {
    vec3 p_face = face_from_world[layer % 6u] * (p_world - eyes[layer / 6u].xyz);
    gl_Layer = int(layer);
    // Reversed-Z, infinite far plane: the depth buffer holds near_plane / depth_axial.
    gl_Position = vec4(p_face.xy, near_plane, p_face.z);
}
