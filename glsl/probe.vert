#version 450 core
#extension GL_ARB_shader_viewport_layer_array : require

// Two triangles without any buffer: one covers layer 1 at depth_axial 4, one its lower half at 2.
void main() {
    const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(3, -1), vec2(-1, 3),
                                   vec2(-9, 0), vec2(9, 0), vec2(0, -9));
    float w = gl_VertexID < 3 ? 4.0 : 2.0;
    gl_Layer = 1;
    gl_Position = vec4(corners[gl_VertexID] * w, 1.0, w);
}
