// Linear blend skinning: row-major 3x4 matrices, three vec4 a joint.
#ifndef BONE_ROWS
#define BONE_ROWS 198
#endif
layout(std140) uniform Bones { vec4 bone_rows[BONE_ROWS]; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uvec4 joints;
layout(location = 3) in vec4 weights;

// The rows of this vertex's matrix, world from bind pose.
void blend_rows(out vec4 r0, out vec4 r1, out vec4 r2) {
    r0 = vec4(0.0);
    r1 = vec4(0.0);
    r2 = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        int row = 3 * int(joints[i]);
        r0 += weights[i] * bone_rows[row];
        r1 += weights[i] * bone_rows[row + 1];
        r2 += weights[i] * bone_rows[row + 2];
    }
}

void skin(out vec3 world_position, out vec3 world_normal) {
    vec4 r0;
    vec4 r1;
    vec4 r2;
    blend_rows(r0, r1, r2);
    vec4 p = vec4(position, 1.0);
    world_position = vec3(dot(r0, p), dot(r1, p), dot(r2, p));
    world_normal = vec3(dot(r0.xyz, normal), dot(r1.xyz, normal), dot(r2.xyz, normal));
}
