#version 450 core

// One workgroup an eye: its cube map is drawn into shared memory, and only the eye's record leaves.
// The map is a maximum of 1 / depth_axial, so that triangles may come in any order; they come in
// shells from near to far, so that what is hidden already is left out by the box. What a texel sees
// is found by drawing once more, for the triangle that has the texel's very depth.
layout(local_size_x = 128) in;

const uint kThreads = gl_WorkGroupSize.x;
const uint kMostPx = 16u;
const uint kBlock = 16u;          // triangles
const float kLeastAxial = 1e-12;  // corners nearer than this to the plane through the eye count as behind it
const float kSlack = 3e-4;        // share of a face by which boxes are widened, against rounding
const float kFirstShell = 0.02;   // world units
const float kShellRatio = 1.6;
const int kShells = 11;           // the last is without end
const uint kNone = 0xFFFFFFFFu;
#define kInfinity uintBitsToFloat(0x7F800000u)

struct TriangleBlock {
    float corner[9][kBlock];  // x y z of the first, second, third
    float normal[3][kBlock];  // unit; zero for padding
    uint id[kBlock];
};
struct BoxBlock {
    float low[3][kBlock];
    float high[3][kBlock];
};
struct Record {
    float force[3];
    float jacobian[6];  // xx yy zz xy xz yz
    float nearest;
    float clearance;
    float back_fraction;
    float hit_fraction;  // -1: the driver cut the work short
};
layout(std430, binding = 0) readonly buffer Eyes { vec4 eyes[]; };
layout(std430, binding = 1) readonly buffer Triangles { TriangleBlock triangles[]; };
layout(std430, binding = 2) readonly buffer BlockBoxes { BoxBlock block_boxes[]; };  // one a group
layout(std430, binding = 3) readonly buffer GroupBoxes { BoxBlock group_boxes[]; };  // one for 16 groups
layout(std430, binding = 4) readonly buffer FirstBlocks { uint first_block[]; };     // of a group
layout(std430, binding = 5) readonly buffer Normals { float normals[]; };            // of a triangle
layout(std430, binding = 6) readonly buffer Weights { float weights[]; };            // of a face's texels
layout(std430, binding = 7) writeonly buffer Records { Record records[]; };

uniform int face_px;
uniform uint groups;
uniform uint patience;  // iterations of the last loop, which a driver that cuts loops short cannot reach
uniform float near_plane;
uniform float ahead_cosine;
uniform float grazing_cosine;
uniform mat3 face_from_world[6];

shared uint depth[6u * kMostPx * kMostPx];  // bits of 1 / depth_axial; 0 where nothing is seen
shared uint seen[6u * kMostPx * kMostPx];   // the lowest triangle at that depth
shared uint listed[kThreads];               // groups that may show
shared uint listed_count;
shared uint is_cut_short;
shared float sums[12][kThreads];

uint thread = gl_LocalInvocationIndex;
vec3 eye = eyes[gl_WorkGroupID.x].xyz;

float center(int i) { return (2.0 * float(i) + 1.0) / float(face_px) - 1.0; }
uint texel_index(int face, int row, int column) { return uint((face * face_px + row) * face_px + column); }

// World space, with axial length 1.
vec3 texel_direction(int i) {
    int at = i % (face_px * face_px);
    return vec3(center(at % face_px), center(at / face_px), 1.0) * face_from_world[i / (face_px * face_px)];
}

// First column and row, last column and row of the centres between two corners on a face.
ivec4 texels_between(vec2 low, vec2 high) {
    vec2 middle = vec2(0.5 * float(face_px) - 0.5);
    vec2 first = ceil(0.5 * float(face_px) * low + middle - kSlack * float(face_px));
    vec2 last = floor(0.5 * float(face_px) * high + middle + kSlack * float(face_px));
    return ivec4(max(first, vec2(0.0)), min(last, vec2(float(face_px - 1))));
}

// Whether a box, seen from the eye, holds a texel's centre at which nothing is nearer than all of it.
bool may_show(vec3 low, vec3 high) {
    for (int face = 0; face < 6; ++face) {
        vec3 a = face_from_world[face] * low;
        vec3 b = face_from_world[face] * high;
        vec3 lo = min(a, b);
        vec3 hi = max(a, b);
        if (hi.z <= 0.0) continue;
        precise float near_inverse = lo.z > kLeastAxial ? 1.0 / lo.z : 1.0 / kLeastAxial;
        float far_inverse = 1.0 / hi.z;
        // Clamped: the products of a box about the eye's own plane overflow an integer.
        vec2 first = clamp(lo.xy * mix(vec2(far_inverse), vec2(near_inverse), lessThan(lo.xy, vec2(0.0))), -2.0, 2.0);
        vec2 last = clamp(hi.xy * mix(vec2(far_inverse), vec2(near_inverse), greaterThan(hi.xy, vec2(0.0))), -2.0, 2.0);
        ivec4 rect = texels_between(first, last);
        uint bound = floatBitsToUint(near_inverse * 1.00001);
        for (int row = rect.y; row <= rect.w; ++row) {
            for (int column = rect.x; column <= rect.z; ++column)
                if (depth[texel_index(face, row, column)] <= bound) return true;
        }
    }
    return false;
}

bool block_may_show(uint group, uint block) {
    vec3 low = vec3(block_boxes[group].low[0][block], block_boxes[group].low[1][block], block_boxes[group].low[2][block]);
    vec3 high =
        vec3(block_boxes[group].high[0][block], block_boxes[group].high[1][block], block_boxes[group].high[2][block]);
    return may_show(low - eye, high - eye);
}

bool group_may_show(uint group, float from, float to) {
    uint b = group / kBlock;
    uint i = group % kBlock;
    vec3 low = vec3(group_boxes[b].low[0][i], group_boxes[b].low[1][i], group_boxes[b].low[2][i]) - eye;
    vec3 high = vec3(group_boxes[b].high[0][i], group_boxes[b].high[1][i], group_boxes[b].high[2][i]) - eye;
    float away = length(max(max(low, -high), vec3(0.0)));
    return away >= from && away < to && may_show(low, high);
}

// Exactly opposite for exchanged corners, so that nothing shows between two triangles.
vec3 edge(vec3 p, vec3 q) {
    precise vec3 e = vec3(p.y * q.z - q.y * p.z, p.z * q.x - q.z * p.x, p.x * q.y - q.x * p.y);
    return e;
}

vec3 corner(uint block, uint lane, uint first) {
    return vec3(triangles[block].corner[first][lane], triangles[block].corner[first + 1u][lane],
                triangles[block].corner[first + 2u][lane]);
}

// Into the map, or, when `naming`, its name to the texels that have its depth.
void draw(uint block, uint lane, bool naming) {
    vec3 p0 = corner(block, lane, 0u) - eye;
    vec3 p1 = corner(block, lane, 3u) - eye;
    vec3 p2 = corner(block, lane, 6u) - eye;
    vec3 n = vec3(triangles[block].normal[0][lane], triangles[block].normal[1][lane], triangles[block].normal[2][lane]);
    precise float height = n.x * p0.x + n.y * p0.y + n.z * p0.z;
    if (!(abs(height) > near_plane)) return;
    float turn = height < 0.0 ? -1.0 : 1.0;
    precise vec3 e0 = turn * edge(p1, p2);
    precise vec3 e1 = turn * edge(p2, p0);
    precise vec3 e2 = turn * edge(p0, p1);
    precise vec3 gradient = n / height;  // of 1 / depth_axial
    for (int face = 0; face < 6; ++face) {
        mat3 m = face_from_world[face];
        vec3 a = m * p0;
        vec3 b = m * p1;
        vec3 c = m * p2;
        float near = min(min(a.z, b.z), c.z);
        if (max(max(a.z, b.z), c.z) <= 0.0) continue;
        vec2 low = vec2(-1.0);
        vec2 high = vec2(1.0);
        precise float most = 1.0 / kLeastAxial;  // nothing of it is nearer
        if (near > kLeastAxial) {
            most = 1.0 / near;
            low = min(min(a.xy / a.z, b.xy / b.z), c.xy / c.z);
            high = max(max(a.xy / a.z, b.xy / b.z), c.xy / c.z);
            if (any(greaterThan(low, vec2(1.0))) || any(lessThan(high, vec2(-1.0)))) continue;
            low = max(low, vec2(-2.0));
            high = min(high, vec2(2.0));
        } else {
            // Beyond one of the four planes of the face's pyramid with all three corners.
            vec2 over = min(min(a.xy - a.z, b.xy - b.z), c.xy - c.z);
            vec2 under = min(min(-a.xy - a.z, -b.xy - b.z), -c.xy - c.z);
            if (any(greaterThan(over, vec2(0.0))) || any(greaterThan(under, vec2(0.0)))) continue;
        }
        ivec4 rect = texels_between(low, high);
        precise vec3 q0 = m * e0;
        precise vec3 q1 = m * e1;
        precise vec3 q2 = m * e2;
        precise vec3 g = m * gradient;
        for (int row = rect.y; row <= rect.w; ++row) {
            float v = center(row);
            for (int column = rect.x; column <= rect.z; ++column) {
                float u = center(column);
                precise float s0 = q0.x * u + q0.y * v + q0.z;
                precise float s1 = q1.x * u + q1.y * v + q1.z;
                precise float s2 = q2.x * u + q2.y * v + q2.z;
                precise float inverse = min(g.x * u + g.y * v + g.z, most);
                if (!(min(min(s0, s1), s2) >= 0.0 && inverse > 0.0)) continue;
                uint bits = floatBitsToUint(inverse);
                uint at = texel_index(face, row, column);
                if (naming) {
                    if (depth[at] == bits) atomicMin(seen[at], triangles[block].id[lane]);
                } else if (bits > depth[at]) {
                    atomicMax(depth[at], bits);
                }
            }
        }
    }
}

// Draws the groups whose boxes are at least `from` and less than `to` away. Sixteen threads take a block.
void sweep(float from, float to, bool naming) {
    for (uint first = 0u; first < groups; first += kThreads) {
        if (thread == 0u) listed_count = 0u;
        barrier();
        uint group = first + thread;
        if (group < groups && group_may_show(group, from, to)) listed[atomicAdd(listed_count, 1u)] = group;
        barrier();
        uint count = listed_count * kBlock;
        for (uint i = thread / kBlock; i < count; i += kThreads / kBlock) {
            uint shown = listed[i / kBlock];
            uint block = first_block[shown] + i % kBlock;
            if (block < first_block[shown + 1u] && block_may_show(shown, i % kBlock))
                draw(block, thread % kBlock, naming);
        }
        barrier();
    }
}

// What this thread's texels add to the record: force, Jacobian, hits, hits from behind; and 1 / nearest.
void sum_texels() {
    float sum[12] = float[](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    int per_face = face_px * face_px;
    for (int i = int(thread); i < 6 * per_face; i += int(kThreads)) {
        if (depth[i] == 0u) continue;
        vec3 direction = texel_direction(i);
        float inverse_length = inversesqrt(dot(direction, direction));
        vec3 d = direction * inverse_length;
        float inverse = uintBitsToFloat(depth[i]) * inverse_length;  // 1 / distance_radial
        float weight = weights[i % per_face];
        float share = weight * inverse;
        if (seen[i] == kNone) is_cut_short = 1u;  // not drawn twice alike
        uint id = seen[i] == kNone ? 0u : 3u * seen[i];
        vec3 n = vec3(normals[id], normals[id + 1u], normals[id + 2u]);
        float facing = dot(n, d);
        vec3 g = n * (share * inverse / max(abs(facing), grazing_cosine));
        if (facing < 0.0) g = -g;
        sum[0] -= share * d.x;
        sum[1] -= share * d.y;
        sum[2] -= share * d.z;
        sum[3] += d.x * g.x;
        sum[4] += d.y * g.y;
        sum[5] += d.z * g.z;
        sum[6] += 0.5 * (d.x * g.y + d.y * g.x);
        sum[7] += 0.5 * (d.x * g.z + d.z * g.x);
        sum[8] += 0.5 * (d.y * g.z + d.z * g.y);
        sum[9] += weight;
        sum[10] += facing > 0.0 ? weight : 0.0;
        sum[11] = max(sum[11], inverse);
    }
    for (int k = 0; k < 12; ++k) sums[k][thread] = sum[k];
}

// 1 / (least distance ahead) of this thread's texels.
float look_ahead(vec3 ahead) {
    float greatest = 0.0;
    for (int i = int(thread); i < 6 * face_px * face_px; i += int(kThreads)) {
        vec3 direction = texel_direction(i);
        float along = dot(direction, ahead);
        if (along >= ahead_cosine * length(direction)) greatest = max(greatest, uintBitsToFloat(depth[i]) / along);
    }
    return greatest;
}

void main() {
    for (uint i = thread; i < 6u * uint(face_px * face_px); i += kThreads) {
        depth[i] = 0u;
        seen[i] = kNone;
    }
    if (thread == 0u) is_cut_short = 0u;
    barrier();

    float from = 0.0;
    float to = kFirstShell;
    for (int shell = 0; shell < kShells; ++shell) {
        // Shells overlap, lest rounding leave a group between two.
        sweep(0.9999 * from, shell + 1 < kShells ? to : kInfinity, false);
        from = to;
        to *= kShellRatio;
    }
    sweep(0.0, kInfinity, true);

    // Software drivers end a thread's loops, silently, after some 65,000 iterations: this one too, then.
    uint rest = 0u;
    while (rest < patience) ++rest;
    if (rest != patience) is_cut_short = 1u;

    sum_texels();
    barrier();
    for (uint step = kThreads / 2u; step > 0u; step /= 2u) {
        if (thread < step) {
            for (int k = 0; k < 11; ++k) sums[k][thread] += sums[k][thread + step];
            sums[11][thread] = max(sums[11][thread], sums[11][thread + step]);
        }
        barrier();
    }
    Record record;
    for (int k = 0; k < 3; ++k) record.force[k] = sums[k][0];
    for (int k = 0; k < 6; ++k) record.jacobian[k] = sums[3 + k][0];
    record.hit_fraction = is_cut_short != 0u ? -1.0 : sums[9][0];
    record.back_fraction = sums[9][0] > 0.0 ? sums[10][0] / sums[9][0] : 0.0;
    record.nearest = sums[11][0] > 0.0 ? 1.0 / sums[11][0] : kInfinity;
    barrier();

    vec3 force = vec3(record.force[0], record.force[1], record.force[2]);
    float strength = length(force);
    sums[0][thread] = strength > 0.0 ? look_ahead(force / strength) : 0.0;
    barrier();
    for (uint step = kThreads / 2u; step > 0u; step /= 2u) {
        if (thread < step) sums[0][thread] = max(sums[0][thread], sums[0][thread + step]);
        barrier();
    }
    record.clearance = sums[0][0] > 0.0 ? 1.0 / sums[0][0] : kInfinity;
    if (thread == 0u) records[gl_WorkGroupID.x] = record;
}
