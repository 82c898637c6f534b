// What the shaders of one surface share. Mirrored by SurfaceUniforms in render/surface_material.hpp.
// Colours are linear; in FAST shaders squares of shown colours (gamma 2).
layout(std140) uniform Surface {
    vec4 base_colour;
    vec4 shade_colour;    // a: GI equalization
    vec4 emissive;        // a: occlusion strength
    vec4 rim_colour;      // a: how far light tints the rim
    vec4 matcap_factor;   // a: normal scale
    vec4 outline_colour;  // a: how far light tints the outline
    vec4 shading;         // shift, toony, scale of the shift texture, alpha cutoff
    vec4 rim;             // fresnel power, lift; width of the outline; roughness
    vec4 other;           // metallic; scroll speed u, v; rotation speed
    vec4 uv_rows[20];     // two a slot: rows of its transform; x, y, offset; w of the first: uv set
};
// Slots in the order of SurfaceSlot.
#define SLOT_BASE 0
#define SLOT_SHADE 1
#define SLOT_SHIFT 2
#define SLOT_NORMAL 3
#define SLOT_EMISSIVE 4
#define SLOT_OCCLUSION 5
#define SLOT_METALLIC 6
#define SLOT_RIM 7
#define SLOT_OUTLINE 8
#define SLOT_MOTION 9

uniform float seconds;  // of stream time, for moving textures

vec2 slot_uv(int slot, vec4 both) {
    vec4 row0 = uv_rows[2 * slot];
    vec4 row1 = uv_rows[2 * slot + 1];
    vec2 uv = row0.w > 0.5 ? both.zw : both.xy;
    return vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
}

// VRMC_materials_mtoon: scroll and rotation about the middle, before each slot's own transform.
vec4 moved_uv(vec4 both, float share) {
    float angle = other.w * seconds * share;
    mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    vec2 by = fract(other.yz * seconds) * share;
    return vec4(turn * (both.xy - 0.5) + 0.5 + by, turn * (both.zw - 0.5) + 0.5 + by);
}
