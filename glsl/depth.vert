#version 450 core
#extension GL_ARB_shader_viewport_layer_array : require

// One instance draws the whole solid into one face of one eye's cube map.
layout(location = 0) in vec3 p_world;

layout(std430, binding = 0) readonly buffer Eyes { vec4 eyes[]; };

uniform float near_plane;
uniform mat3 face_from_world[6];

void main() {
    int eye = gl_InstanceID / 6;
    int face = gl_InstanceID % 6;
    vec3 p_face = face_from_world[face] * (p_world - eyes[eye].xyz);
    gl_Layer = gl_InstanceID;
    // Reversed-Z, infinite far plane: the depth buffer holds near_plane / depth_axial.
    gl_Position = vec4(p_face.xy, near_plane, p_face.z);
}
