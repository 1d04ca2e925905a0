#version 450 core

// Cuts a capsule out of its box by the ray through the pixel, and lights it.
in vec3 p_view;
flat in vec3 a;
flat in vec3 b;
flat in float radius;
flat in vec3 color_a;
flat in vec3 color_b;
flat in float lift;

uniform float near_plane;
uniform float opacity;

layout(location = 0) out vec4 color;

// Distance along `ray` from `from` to the ball about `middle`; -1e9 for a miss.
float to_ball(vec3 from, vec3 ray, vec3 middle) {
    vec3 gap = from - middle;
    float along = dot(ray, gap);
    float rest = along * along - dot(gap, gap) + radius * radius;
    return rest < 0.0 ? -1e9 : -along - sqrt(rest);
}

void main() {
    if (!gl_FrontFacing) discard;
    // The ray starts on the box: from the eye, a thin tube would drown in rounding.
    vec3 ray = normalize(p_view);
    float span = length(b - a);
    vec3 axis = span > 0.0 ? (b - a) / span : vec3(0.0);
    vec3 ray_across = ray - axis * dot(ray, axis);
    vec3 gap = p_view - a;
    vec3 gap_across = gap - axis * dot(gap, axis);
    float square = dot(ray_across, ray_across);
    float half_linear = dot(ray_across, gap_across);
    float rest = half_linear * half_linear - square * (dot(gap_across, gap_across) - radius * radius);
    if (rest < 0.0) discard;
    float t = (-half_linear - sqrt(rest)) / max(square, 1e-12);
    float share = dot(gap + t * ray, axis);
    if (share <= 0.0) t = to_ball(p_view, ray, a);
    if (share > span) t = to_ball(p_view, ray, b);
    if (t < -1e8) discard;

    vec3 hit = p_view + t * ray;
    share = clamp(dot(hit - a, axis), 0.0, span);
    vec3 normal = (hit - a - share * axis) / radius;
    vec3 base = mix(color_a, color_b, span > 0.0 ? share / span : 0.0);
    float light = 0.62 + 0.38 * max(dot(normal, normalize(vec3(-0.4, 0.6, 0.7))), 0.0);
    float shine = pow(max(dot(reflect(ray, normal), normalize(vec3(-0.4, 0.6, 0.7))), 0.0), 24.0);
    float rim = smoothstep(0.55, 0.25, dot(normal, -ray));  // a darker edge, for print
    color = vec4(mix(base * light + 0.25 * shine, base * 0.35, 0.8 * rim), opacity);
    gl_FragDepth = near_plane / (-hit.z - lift);
}
