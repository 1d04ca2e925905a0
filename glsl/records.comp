#version 450 core

// One workgroup an eye: its cube map is drawn into shared memory, and only the eye's record leaves.
// The map is a maximum of 1 / depth_axial, so that triangles may come in any order. Groups of blocks
// of triangles whose boxes may show give blocks, on faces where these may show; those give pieces,
// triangles that may hold a texel's centre, and large pieces give patches that teams of threads share:
// what few threads find is gathered until there is some for all. What a texel sees is found by
// drawing once more, for the triangle that has the texel's very depth.
#ifndef kThreads  // of a workgroup, said where the shader is compiled, and how many texels a map has
#define kThreads 256u
#define kTexels 1536u
#endif
layout(local_size_x = kThreads) in;

const uint kBlock = 16u;          // triangles
const float kLeastAxial = 1e-12;  // corners nearer than this to the plane through the eye count as behind it
const float kSlack = 3e-4;        // share of a face by which boxes are widened, against rounding
const uint kNone = 0xFFFFFFFFu;
const uint kGathered = 2u * kThreads;
const uint kFaces = 6u;
const int kSmall = 6;     // texels that one thread looks at by itself
const uint kTeam = 16u;   // threads that share a larger patch
const uint kWords = 16u;  // of such a patch
const uint kPatches = 32u;
const uint kLanes = 32u;  // sums that are kept side by side
const int kSums = 12;
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
uniform uint first_eye;  // of this dispatch
uniform uint patience;  // iterations of the last loop, which a driver that cuts loops short cannot reach
uniform float near_plane;
uniform float ahead_cosine;
uniform float grazing_cosine;
uniform mat3 face_from_world[6];

shared uint depth[kTexels];           // bits of 1 / depth_axial; 0 where nothing is seen
shared uint seen[kTexels];            // the lowest triangle at that depth
shared uint groups_listed[kThreads];  // that may show on a face: number, and the face in three bits
shared uint group_count;
shared uint blocks[kGathered];  // likewise
shared uint block_count;
shared uvec2 pieces[kGathered];  // block and lane; face and texels to look at
shared uint piece_count;
shared float scratch[kPatches * kWords];  // large patches; sums at the end
shared uint patch_count;
shared uint ahead_bits;
shared uint is_cut_short;

uint thread = gl_LocalInvocationIndex;
vec3 eye = eyes[first_eye + gl_WorkGroupID.x].xyz;

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

// Whether a box, seen from the eye, holds a texel's centre on a face at which nothing is nearer than
// all of it.
bool may_show(vec3 low, vec3 high, uint face) {
    vec3 a = face_from_world[face] * low;
    vec3 b = face_from_world[face] * high;
    vec3 lo = min(a, b);
    vec3 hi = max(a, b);
    if (hi.z <= 0.0) return false;
    precise float near_inverse = lo.z > kLeastAxial ? 1.0 / lo.z : 1.0 / kLeastAxial;
    float far_inverse = 1.0 / hi.z;
    // Clamped: the products of a box about the eye's own plane overflow an integer.
    vec2 first = clamp(lo.xy * mix(vec2(far_inverse), vec2(near_inverse), lessThan(lo.xy, vec2(0.0))), -2.0, 2.0);
    vec2 last = clamp(hi.xy * mix(vec2(far_inverse), vec2(near_inverse), greaterThan(hi.xy, vec2(0.0))), -2.0, 2.0);
    ivec4 rect = texels_between(first, last);
    uint bound = floatBitsToUint(near_inverse * 1.00001);
    for (int row = rect.y; row <= rect.w; ++row) {
        for (int column = rect.x; column <= rect.z; ++column)
            if (depth[texel_index(int(face), row, column)] <= bound) return true;
    }
    return false;
}

bool group_may_show(uint group, uint face) {
    uint b = group / kBlock;
    uint i = group % kBlock;
    return may_show(vec3(group_boxes[b].low[0][i], group_boxes[b].low[1][i], group_boxes[b].low[2][i]) - eye,
                    vec3(group_boxes[b].high[0][i], group_boxes[b].high[1][i], group_boxes[b].high[2][i]) - eye, face);
}

bool block_may_show(uint group, uint i, uint face) {
    return may_show(
        vec3(block_boxes[group].low[0][i], block_boxes[group].low[1][i], block_boxes[group].low[2][i]) - eye,
        vec3(block_boxes[group].high[0][i], block_boxes[group].high[1][i], block_boxes[group].high[2][i]) - eye, face);
}

// Exactly opposite for exchanged corners, so that nothing shows between two triangles.
vec3 edge(vec3 p, vec3 q) {
    precise vec3 e = vec3(p.y * q.z - q.y * p.z, p.z * q.x - q.z * p.x, p.x * q.y - q.x * p.y);
    return e;
}

vec3 corner(uint block, uint lane, uint first) {
    return vec3(triangles[block].corner[first][lane], triangles[block].corner[first + 1u][lane],
                triangles[block].corner[first + 2u][lane]) - eye;
}

// A triangle on a face: its edges and 1 / depth_axial, each affine there, and the texels to look at.
struct Patch {
    vec3 side0;
    vec3 side1;
    vec3 side2;
    vec3 gradient;
    float most;  // nothing of it is nearer
    uint id;
    uint place;
};

uint packed_place(int face, ivec4 rect) {
    return uint(face | rect.x << 4 | rect.y << 8 | rect.z << 12 | rect.w << 16);
}
int face_of(uint place) { return int(place & 15u); }
ivec4 rect_of(uint place) {
    return ivec4(place >> 4 & 15u, place >> 8 & 15u, place >> 12 & 15u, place >> 16 & 15u);
}

// At one texel: into the map, or, when `naming`, its name where the map has its depth.
void cover(Patch p, int row, int column, bool naming) {
    float u = center(column);
    float v = center(row);
    precise float s0 = p.side0.x * u + p.side0.y * v + p.side0.z;
    precise float s1 = p.side1.x * u + p.side1.y * v + p.side1.z;
    precise float s2 = p.side2.x * u + p.side2.y * v + p.side2.z;
    precise float inverse = min(p.gradient.x * u + p.gradient.y * v + p.gradient.z, p.most);
    if (!(min(min(s0, s1), s2) >= 0.0 && inverse > 0.0)) return;
    uint bits = floatBitsToUint(inverse);
    uint at = texel_index(face_of(p.place), row, column);
    if (naming) {
        if (depth[at] == bits) atomicMin(seen[at], p.id);
    } else if (bits > depth[at]) {
        atomicMax(depth[at], bits);
    }
}

void keep(Patch p, uint slot) {
    uint at = slot * kWords;
    for (int k = 0; k < 3; ++k) {
        scratch[at + k] = p.side0[k];
        scratch[at + 3 + k] = p.side1[k];
        scratch[at + 6 + k] = p.side2[k];
        scratch[at + 9 + k] = p.gradient[k];
    }
    scratch[at + 12] = p.most;
    scratch[at + 13] = uintBitsToFloat(p.id);
    scratch[at + 14] = uintBitsToFloat(p.place);
}

Patch kept(uint slot) {
    uint at = slot * kWords;
    return Patch(vec3(scratch[at], scratch[at + 1], scratch[at + 2]),
                 vec3(scratch[at + 3], scratch[at + 4], scratch[at + 5]),
                 vec3(scratch[at + 6], scratch[at + 7], scratch[at + 8]),
                 vec3(scratch[at + 9], scratch[at + 10], scratch[at + 11]), scratch[at + 12],
                 floatBitsToUint(scratch[at + 13]), floatBitsToUint(scratch[at + 14]));
}

// A small piece at once; a large one is kept for a team of threads.
void draw(uvec2 piece, bool naming) {
    uint block = piece.x / kBlock;
    uint lane = piece.x % kBlock;
    vec3 p0 = corner(block, lane, 0u);
    vec3 p1 = corner(block, lane, 3u);
    vec3 p2 = corner(block, lane, 6u);
    vec3 n = vec3(triangles[block].normal[0][lane], triangles[block].normal[1][lane], triangles[block].normal[2][lane]);
    precise float height = n.x * p0.x + n.y * p0.y + n.z * p0.z;
    if (!(abs(height) > near_plane)) return;
    float turn = height < 0.0 ? -1.0 : 1.0;
    precise vec3 e0 = turn * edge(p1, p2);
    precise vec3 e1 = turn * edge(p2, p0);
    precise vec3 e2 = turn * edge(p0, p1);
    precise vec3 gradient = n / height;  // of 1 / depth_axial
    mat3 m = face_from_world[face_of(piece.y)];
    vec3 depths = vec3((m * p0).z, (m * p1).z, (m * p2).z);
    float near = min(min(depths.x, depths.y), depths.z);
    precise vec3 q0 = m * e0;
    precise vec3 q1 = m * e1;
    precise vec3 q2 = m * e2;
    precise vec3 g = m * gradient;
    precise float most = near > kLeastAxial ? 1.0 / near : 1.0 / kLeastAxial;
    Patch p = Patch(q0, q1, q2, g, most, triangles[block].id[lane], piece.y);
    ivec4 rect = rect_of(piece.y);
    if ((rect.z - rect.x + 1) * (rect.w - rect.y + 1) > kSmall) {
        uint slot = atomicAdd(patch_count, 1u);
        if (slot < kPatches) {
            keep(p, slot);
            return;
        }
    }
    for (int row = rect.y; row <= rect.w; ++row) {
        for (int column = rect.x; column <= rect.z; ++column) cover(p, row, column, naming);
    }
}

void draw_kept(bool naming) {
    uint count = min(patch_count, kPatches);
    for (uint slot = thread / kTeam; slot < count; slot += kThreads / kTeam) {
        Patch p = kept(slot);
        ivec4 rect = rect_of(p.place);
        int columns = rect.z - rect.x + 1;
        int texels = columns * (rect.w - rect.y + 1);
        for (int i = int(thread % kTeam); i < texels; i += int(kTeam))
            cover(p, rect.y + i / columns, rect.x + i % columns, naming);
    }
}

void draw_pieces(bool naming) {
    uint count = piece_count;
    for (uint first = 0u; first < count; first += kThreads)
        if (first + thread < count) draw(pieces[first + thread], naming);
    barrier();
    draw_kept(naming);
    barrier();
    if (thread == 0u) piece_count = patch_count = 0u;
    barrier();
}

// The texels whose centres a triangle may hold on a face; none: first after last.
ivec4 texels_of(int face, vec3 p0, vec3 p1, vec3 p2) {
    const ivec4 none = ivec4(1, 1, 0, 0);
    mat3 m = face_from_world[face];
    vec3 a = m * p0;
    vec3 b = m * p1;
    vec3 c = m * p2;
    if (max(max(a.z, b.z), c.z) <= 0.0) return none;
    if (min(min(a.z, b.z), c.z) > kLeastAxial) {
        vec2 low = min(min(a.xy / a.z, b.xy / b.z), c.xy / c.z);
        vec2 high = max(max(a.xy / a.z, b.xy / b.z), c.xy / c.z);
        return texels_between(clamp(low, -2.0, 2.0), clamp(high, -2.0, 2.0));
    }
    // Beyond one of the four planes of the face's pyramid with all three corners.
    vec2 over = min(min(a.xy - a.z, b.xy - b.z), c.xy - c.z);
    vec2 under = min(min(-a.xy - a.z, -b.xy - b.z), -c.xy - c.z);
    if (any(greaterThan(over, vec2(0.0))) || any(greaterThan(under, vec2(0.0)))) return none;
    return texels_between(vec2(-1.0), vec2(1.0));
}

void list_piece(uint listed, uint lane) {
    uint block = listed / 8u;
    int face = int(listed % 8u);
    ivec4 rect = texels_of(face, corner(block, lane, 0u), corner(block, lane, 3u), corner(block, lane, 6u));
    if (rect.z < rect.x || rect.w < rect.y) return;
    pieces[atomicAdd(piece_count, 1u)] = uvec2(block * kBlock + lane, packed_place(face, rect));
}

void draw_blocks(bool naming) {
    uint count = block_count * kBlock;
    for (uint first = 0u; first < count; first += kThreads) {
        uint i = first + thread;
        if (i < count) list_piece(blocks[i / kBlock], i % kBlock);
        barrier();
        uint gathered = piece_count;
        barrier();
        if (gathered >= kThreads) draw_pieces(naming);
    }
    if (thread == 0u) block_count = 0u;
    barrier();
}

void draw_groups(bool naming) {
    uint count = group_count * kBlock;
    for (uint first = 0u; first < count; first += kThreads) {
        uint i = first + thread;
        if (i < count) {
            uint group = groups_listed[i / kBlock] / 8u;
            uint face = groups_listed[i / kBlock] % 8u;
            uint block = first_block[group] + i % kBlock;
            if (block < first_block[group + 1u] && block_may_show(group, i % kBlock, face))
                blocks[atomicAdd(block_count, 1u)] = block * 8u + face;
        }
        barrier();
        uint gathered = block_count;
        barrier();
        if (gathered >= kThreads) draw_blocks(naming);
    }
}

// Everything into the map, or its names.
void sweep(bool naming) {
    for (uint first = 0u; first < groups * kFaces; first += kThreads) {
        if (thread == 0u) group_count = 0u;
        barrier();
        uint group = (first + thread) / kFaces;
        uint face = (first + thread) % kFaces;
        if (group < groups && group_may_show(group, face))
            groups_listed[atomicAdd(group_count, 1u)] = group * 8u + face;
        barrier();
        draw_groups(naming);
    }
    draw_blocks(naming);
    draw_pieces(naming);
}

// The threads' sums, in a fixed order, to the front of each row of `scratch`; the last is a maximum.
void add_up(float sum[kSums]) {
    for (uint part = 0u; part < kThreads / kLanes; ++part) {
        for (int k = 0; k < kSums && thread / kLanes == part; ++k) {
            uint at = uint(k) * kLanes + thread % kLanes;
            float before = part == 0u ? 0.0 : scratch[at];
            scratch[at] = k < kSums - 1 ? before + sum[k] : max(before, sum[k]);
        }
        barrier();
    }
    for (uint step = kLanes / 2u; step > 0u; step /= 2u) {
        for (int k = 0; k < kSums && thread < step; ++k) {
            uint at = uint(k) * kLanes + thread;
            float other = scratch[at + step];
            scratch[at] = k < kSums - 1 ? scratch[at] + other : max(scratch[at], other);
        }
        barrier();
    }
}

// What this thread's texels add to the record: force, Jacobian, hits, hits from behind; and 1 / nearest.
void sum_texels() {
    float sum[kSums] = float[](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
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
    add_up(sum);
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

float total(int k) { return scratch[uint(k) * kLanes]; }

void main() {
    for (uint i = thread; i < kTexels; i += kThreads) {
        depth[i] = 0u;
        seen[i] = kNone;
    }
    if (thread == 0u) block_count = piece_count = patch_count = ahead_bits = is_cut_short = 0u;
    barrier();
    for (int pass = 0; pass < 2; ++pass) sweep(pass == 1);

    // Software drivers end a thread's loops, silently, after some 65,000 iterations: this one too, then.
    uint rest = 0u;
    while (rest < patience) ++rest;
    if (rest != patience) is_cut_short = 1u;

    sum_texels();
    Record record;
    for (int k = 0; k < 3; ++k) record.force[k] = total(k);
    for (int k = 0; k < 6; ++k) record.jacobian[k] = total(3 + k);
    record.hit_fraction = is_cut_short != 0u ? -1.0 : total(9);
    record.back_fraction = total(9) > 0.0 ? total(10) / total(9) : 0.0;
    record.nearest = total(11) > 0.0 ? 1.0 / total(11) : kInfinity;

    vec3 force = vec3(record.force[0], record.force[1], record.force[2]);
    float strength = length(force);
    if (strength > 0.0) atomicMax(ahead_bits, floatBitsToUint(look_ahead(force / strength)));
    barrier();
    record.clearance = ahead_bits > 0u ? 1.0 / uintBitsToFloat(ahead_bits) : kInfinity;
    if (thread == 0u) records[first_eye + gl_WorkGroupID.x] = record;
}
