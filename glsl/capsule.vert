#version 450 core

// One instance is a box round a capsule; a ball is a capsule of length 0. The fragment shader cuts it out.
struct Capsule {
    vec4 a_radius;  // world
    vec4 b_lift;    // lift: how much nearer it counts as being, so that it hides what lies before it
    vec4 color_a;
    vec4 color_b;
};
layout(std430, binding = 0) readonly buffer Capsules { Capsule capsules[]; };

uniform mat4 clip_from_view;
uniform mat4 view_from_world;

out vec3 p_view;
flat out vec3 a;
flat out vec3 b;
flat out float radius;
flat out vec3 color_a;
flat out vec3 color_b;
flat out float lift;

void main() {
    Capsule capsule = capsules[gl_InstanceID];
    a = (view_from_world * vec4(capsule.a_radius.xyz, 1.0)).xyz;
    b = (view_from_world * vec4(capsule.b_lift.xyz, 1.0)).xyz;
    radius = capsule.a_radius.w;
    color_a = capsule.color_a.rgb;
    color_b = capsule.color_b.rgb;
    lift = capsule.b_lift.w;

    float span = length(b - a);
    vec3 along = span > 0.0 ? (b - a) / span : vec3(1.0, 0.0, 0.0);
    vec3 side = normalize(cross(along, abs(along.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    mat3 frame = mat3(along, side, cross(along, side));

    // Two triangles for each of the box's faces, counter-clockwise seen from outside.
    const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    int axis = gl_VertexID / 6 % 3;
    float way = gl_VertexID < 18 ? 1.0 : -1.0;
    vec2 corner = corners[gl_VertexID % 6];
    vec3 box;
    box[axis] = way;
    box[(axis + 1) % 3] = way * corner.x;
    box[(axis + 2) % 3] = corner.y;

    p_view = 0.5 * (a + b) + frame * (box * vec3(0.5 * span + radius, radius, radius));
    gl_Position = clip_from_view * vec4(p_view, 1.0);
}
