// What all shaders of one picture share. Mirrored by FrameUniforms in render/frame_uniforms.hpp.
// World: metres, y up. Lights are linear; colours named display_ are as shown (gamma applied).
layout(std140) uniform Frame {
    mat4 clip_from_world;
    mat4 shadow_from_world;   // to [0, 1]^3 of the shadow map
    vec4 eye;                 // world
    vec4 key_direction;       // unit, toward the light
    vec4 fill_direction;
    vec4 rim_direction;
    vec4 key_light;
    vec4 fill_light;
    vec4 rim_light;
    vec4 sky_light;
    vec4 ground_light;
    vec4 toon_key;            // lights of drawn surfaces: key and ambient add to about 1
    vec4 toon_sky;
    vec4 toon_ground;
    vec4 display_top;         // backdrop
    vec4 display_glow;
    vec4 display_horizon;
    vec4 floor_centre;        // linear
    vec4 floor_edge;
    vec4 floor_key_tint;      // key light on the floor, without the ambient share
    vec4 floor_sky_tint;      // ambient share
    vec4 display_ring;        // a: how far a ring covers the floor (0: it only adds light)
    vec4 rings[4];            // radius, brightness, half width of the line, strength of its glow
    vec4 picture;             // x, y, width, height in pixels
    vec4 tone;                // exposure; 1 on the stage, 0 on a transparent backdrop; phase of the
                              // dither; pixels of 0.04 m at 1 m distance
    vec4 counts;              // of the blobs; 1: light is shown as it is, without the tone curve;
                              // size of the floor, 1 for few dancers; 1: the floor has shadows
    vec4 show;                // 1 / width^2 of the pool of light and of the backdrop's glow; edge
                              // of a tile; seconds; light of the haze
    vec4 tiles[4];            // display_ light that tiles of each kind add
    vec4 lamps[12];           // of each beam: world, brightness
    vec4 beam_ends[12];       // world, number of its colour
    vec4 beam_colours[3];     // display_
};

// Soft shadows of all dancers.
layout(std140) uniform Blobs { vec4 blobs[1012]; };  // x, z, 1 / radius^2, strength

const float kFadeStart = 1.6;  // metres from the middle of a floor of size 1: it begins to fade
const float kFadeEnd = 4.6;    // and here it is the backdrop

// What a surface throws back of light that grazes it: most of it in its own colour, so that dark
// cloth has no white edge.
vec3 thrown_back(vec3 light, vec3 albedo) { return light * (0.2 + 0.8 * sqrt(albedo)); }

// Narkowicz 2015, "ACES filmic tone mapping curve", after exposure.
vec3 tone_mapped(vec3 light) {
    vec3 x = light * tone.x;
    if (counts.y > 0.5) {
        return clamp(x, 0.0, 1.0);
    }
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

vec3 encoded(vec3 light) { return pow(light, vec3(1.0 / 2.2)); }

// Ordered noise, +-0.5 / 255: hides the steps of dark gradients. (Roberts 2018, "R2 sequence"; half
// the cost of interleaved gradient noise.) From the corner of the picture, so that a picture does
// not depend on its place in the target.
float dither(vec2 fragment) {
    return fract(dot(fragment, vec2(0.754877666, 0.569840296)) - tone.z) / 255.0 - 0.5 / 255.0;
}

// Colour of the backdrop. p.x: from the middle, p.y: from the upper edge; in picture heights.
vec3 backdrop(vec2 p) {
    vec3 base = mix(display_top.rgb, display_horizon.rgb, clamp(2.06 * p.y, 0.0, 1.0));
    vec2 d = p - vec2(0.0, 0.32);
    float glow = 0.69 * exp(-dot(d, d) / 0.31 * show.x) * (1.0 - smoothstep(0.31, 0.60, p.y));
    return mix(base, display_glow.rgb, glow);
}

vec2 backdrop_place(vec2 ndc) {
    return vec2(0.5 * ndc.x * picture.z / picture.w, 0.5 - 0.5 * ndc.y);
}

// Light that the soft blobs under the joints leave, [0.15, 1].
float blob_shadow(vec2 at) {
    float left = 1.0;
    for (int i = 0; i < int(counts.x); ++i) {
        vec2 d = at - blobs[i].xy;
        left *= 1.0 - blobs[i].w * exp(-dot(d, d) * blobs[i].z);
    }
    return mix(1.0, max(left, 0.15), counts.w);
}

// Share of the floor that mirrors what is above it: the flatter the view, the more.
float mirror_share(vec3 at) {
    float grazing = 1.0 - normalize(eye.xyz - at).y;
    float grazing2 = grazing * grazing;
    return 0.10 + 0.5 * grazing2 * grazing2 * grazing;
}

// Whether the floor shows an image of a point: not of what sinks into it, and only where the line
// of sight meets the disc, whose edge is of straight pieces.
bool floor_mirrors(vec3 at) {
    vec2 meets = mix(eye.xz, at.xz, eye.y / (eye.y + max(at.y, 0.0)));
    return at.y >= 0.0 && length(meets) < 0.99 * kFadeEnd * counts.z;
}

// How far the floor has become the backdrop, [0, 1].
float floor_fade(float radius) { return smoothstep(kFadeStart, kFadeEnd, radius / counts.z); }

// Floor as shown, before rings; `lit` is 1 without shadow.
vec3 floor_colour(float from_middle, float lit) {
    float radius = from_middle / counts.z;
    float pool = exp(-0.22 * radius * radius * show.x);
    vec3 albedo = mix(floor_edge.rgb, floor_centre.rgb, pool);
    vec3 light = floor_key_tint.rgb * (lit * mix(0.3, 1.0, pool)) + floor_sky_tint.rgb;
    return encoded(albedo * light);
}
