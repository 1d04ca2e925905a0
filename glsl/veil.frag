#version 450 core

// The surface's nearest layer over the picture: a veil that is thin where it faces the eye and thick at
// its rim, with a line where it ends, bends or passes in front of itself.
layout(binding = 0) uniform sampler2D surface;  // normal and facing cosine; 0 where there is none
layout(binding = 1) uniform sampler2D depth;    // near / depth_axial: affine over any plane
layout(binding = 2) uniform sampler2D tints;    // the surface's colour

uniform vec3 ink;  // of lines
uniform float line_px;
uniform float strength;
uniform float jump;  // relative step in depth that counts as an edge

layout(location = 0) out vec4 color;

// How much a line runs through here: an edge between the two neighbours at +-offset.
float edge(ivec2 at, ivec2 offset) {
    ivec2 last = textureSize(depth, 0) - 1;
    ivec2 front = clamp(at + offset, ivec2(0), last);
    ivec2 back = clamp(at - offset, ivec2(0), last);
    float here = texelFetch(depth, at, 0).r;
    float ahead = texelFetch(depth, front, 0).r;
    float behind = texelFetch(depth, back, 0).r;
    float step = abs(ahead + behind - 2.0 * here) / max(max(ahead, behind), max(here, 1e-9));
    vec3 normal_ahead = texelFetch(surface, front, 0).xyz;
    vec3 normal_behind = texelFetch(surface, back, 0).xyz;
    bool is_bend = dot(normal_ahead, normal_behind) < 0.5 && dot(normal_ahead, normal_ahead) > 0.5 &&
                   dot(normal_behind, normal_behind) > 0.5;
    return step > jump ? 1.0 : is_bend ? 0.55 : 0.0;
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int far = int(line_px + 0.5);
    int slant = int(line_px * 0.7071 + 0.5);
    float line = max(max(edge(at, ivec2(far, 0)), edge(at, ivec2(0, far))),
                     max(edge(at, ivec2(slant, slant)), edge(at, ivec2(slant, -slant))));
    vec4 here = texelFetch(surface, at, 0);
    vec3 tint = texelFetch(tints, at, 0).rgb;
    vec3 shade = vec3(0.0);
    float alpha = 0.0;
    if (here.w > 0.0) {
        float light = 0.5 + 0.5 * dot(here.xyz, normalize(vec3(-0.4, 0.6, 0.7)));
        shade = tint * (0.62 + 0.45 * light);
        alpha = mix(0.30, 0.75, pow(1.0 - here.w, 2.0));
    }
    float cover = 0.85 * line;
    color = strength * vec4(mix(shade * alpha, ink, cover), mix(alpha, 1.0, cover));  // premultiplied
}
