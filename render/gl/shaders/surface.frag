in vec4 uv;
in vec2 base_uv;
in vec4 tint;
#ifdef PAINTED
in float open;
#endif

#ifdef HAS_BASE
uniform sampler2D base_map;
#endif
#ifdef HAS_MOTION
uniform sampler2D motion_map;
#endif

// Where the textures are read: moved by share where a mask says how far.
vec4 both_uv() {
#ifdef HAS_MOTION
    return moved_uv(uv, texture(motion_map, slot_uv(SLOT_MOTION, uv)).b);
#else
    return uv;
#endif
}

// A slot's place: the base's where its transform is the same.
#ifdef HAS_MOTION
#define AT(slot) slot_uv(slot, both)
#define AT_BASE slot_uv(SLOT_BASE, both)
#else
#define AT(slot) slot_uv(slot, both)
#define AT_BASE base_uv
#endif

vec4 shown_as_linear(vec4 texel) {
#ifdef FAST
    // Textures hold shown colours there: their squares are as good as linear (gamma 2).
    return vec4(texel.rgb * texel.rgb, texel.a);
#else
    return texel;  // the sampler has done it
#endif
}

#ifdef DEPTH

void main() {
#if defined(ALPHA_MASK)
    float alpha = base_colour.a * tint.a;
#ifdef HAS_BASE
    alpha *= texture(base_map, base_uv).a;
#endif
    if (alpha < shading.w) {
        discard;
    }
#endif
}

#else

in vec3 world;
in vec3 world_normal;
uniform float mirror;
#ifdef FAST
in vec4 light;
in vec3 added;
#endif
#ifdef HAS_NORMAL
#ifdef FAST
in vec3 key_here;
#else
in vec4 world_tangent;
#endif
uniform sampler2D normal_map;
#endif
#ifdef HAS_MATCAP
in vec2 matcap_uv;
uniform sampler2D matcap_map;
#endif
#ifdef HAS_SHADE
uniform sampler2D shade_map;
#endif
#ifdef HAS_SHIFT
uniform sampler2D shift_map;
#endif
#ifdef HAS_EMISSIVE
uniform sampler2D emissive_map;
#endif
#ifdef HAS_RIM
uniform sampler2D rim_map;
#endif
#ifdef HAS_OCCLUSION
uniform sampler2D occlusion_map;
#endif
#ifdef HAS_METALLIC
uniform sampler2D metallic_map;
#endif
out vec4 colour;

vec3 to_screen(vec3 linear) {
#ifdef FAST
    return sqrt(linear);
#else
    // IEC 61966-2-1
    vec3 c = clamp(linear, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
#endif
}

#ifdef HAS_NORMAL
vec3 mapped_normal(vec4 both) {
    vec3 s = texture(normal_map, AT(SLOT_NORMAL)).xyz * 2.0 - 1.0;
    return normalize(vec3(s.xy * matcap_factor.a, s.z));
}
#endif

#ifdef FAST
// Cosine to the key light. A normal map turns it against the vertices' light alone: the light is
// brought into the surface's own axes at the vertices, so no normal is made here.
float key_cosine(vec4 both) {
#ifdef HAS_NORMAL
    return dot(mapped_normal(both), key_here);
#else
    return light.a;
#endif
}
#else
vec3 fragment_normal(vec4 both) {
    vec3 n = normalize(world_normal);
#ifdef HAS_NORMAL
    vec3 t = normalize(world_tangent.xyz - n * dot(n, world_tangent.xyz) + vec3(1e-9));
    vec3 b = cross(n, t) * world_tangent.w;
    vec3 s = mapped_normal(both);
    n = normalize(t * s.x + b * s.y + n * s.z);
#endif
    return gl_FrontFacing ? n : -n;
}
#endif

#ifdef TOON
vec3 toon_colour(vec3 base, vec3 shade, vec4 both) {
#ifdef FAST
    // The inner side of cloth and hair is lit as its outer side turned over.
    float cosine = gl_FrontFacing ? key_cosine(both) : -key_cosine(both);
    float up = 0.5;
#else
    vec3 n = fragment_normal(both);
    // Without the shadow map: faces are drawn to be shaded by their own form alone.
    float cosine = dot(n, key_direction.xyz);
    float up = 0.5 + 0.5 * n.y;
#endif
    float s = cosine + shading.x;
#ifdef HAS_SHIFT
    s += texture(shift_map, AT(SLOT_SHIFT)).r * shading.z;
#endif
    float toony = shading.y;
    s = clamp((s + 1.0 - toony) / max(2.0 - 2.0 * toony, 1e-4), 0.0, 1.0);
    vec3 around = mix(mix(toon_ground.rgb, toon_sky.rgb, up),
                      0.5 * (toon_ground.rgb + toon_sky.rgb),
                      shade_colour.a);
    vec3 result = mix(shade, base, s) * toon_key.rgb + base * around;
#if defined(RIM) || defined(HAS_MATCAP)
    vec3 edge = vec3(0.0);
#ifdef RIM
#ifdef FAST
    edge = added;
#else
    vec3 v = normalize(vec3(eye.x, eye.y * mirror, eye.z) - world);
    float grazing = clamp(1.0 - dot(n, v) + rim.y, 0.0, 1.0);
    edge = rim_colour.rgb * pow(grazing, max(rim.x, 1e-5));
#endif
#endif
#ifdef HAS_MATCAP
#ifdef FAST
    vec2 ball = matcap_uv;
#else
    vec3 to_eye = normalize(vec3(eye.x, eye.y * mirror, eye.z) - world);
    vec3 side = normalize(vec3(to_eye.z, 0.0, -to_eye.x));
    vec2 ball = vec2(dot(side, n), -dot(cross(side, to_eye), n)) * 0.495 + 0.5;
#endif
    edge += matcap_factor.rgb * shown_as_linear(texture(matcap_map, ball)).rgb;
#endif
#ifdef HAS_RIM
    edge *= shown_as_linear(texture(rim_map, AT(SLOT_RIM))).rgb;
#endif
    result += edge * mix(vec3(1.0), toon_key.rgb + around, rim_colour.a);
#endif
    return result;
}
#endif

#ifdef LIT
vec3 lit_colour(vec3 base, vec4 both) {
    float metallic = other.x;
    float roughness = rim.w;
#ifdef HAS_METALLIC
    vec3 texel = texture(metallic_map, AT(SLOT_METALLIC)).rgb;
    metallic *= texel.b;
    roughness *= texel.g;
#endif
#ifndef PAINTED
    float open = 1.0;
#endif
#ifdef HAS_OCCLUSION
    open = 1.0 + emissive.a * (texture(occlusion_map, AT(SLOT_OCCLUSION)).r - 1.0);
#endif
    // A metal mirrors what is around it in its own colour: without a picture of that, a share of
    // the diffuse light stands for it.
    vec3 albedo = base * mix(1.0, 0.6, metallic);
#ifdef FAST
    vec3 received = light.rgb;
#ifdef HAS_NORMAL
    received += key_light.rgb * (max(key_cosine(both), 0.0) - max(light.a, 0.0));
#endif
    return albedo * max(received, 0.0) * open + added;
#else
    vec3 n = fragment_normal(both);
    vec3 v = normalize(vec3(eye.x, eye.y * mirror, eye.z) - world);
    float lit = key_visibility(world + 0.012 * n);
    vec3 h = normalize(v + key_direction.xyz);
    float alpha = max(roughness * roughness, 0.01);
    float nh = max(dot(n, h), 0.0);
    float lh = max(dot(key_direction.xyz, h), 0.05);
    float d = nh * nh * (alpha * alpha - 1.0) + 1.0;
    vec3 mirrored = mix(vec3(0.04), base, metallic);
    vec3 fresnel = mirrored + (1.0 - mirrored) * pow(1.0 - lh, 5.0);
    float facing = max(dot(n, key_direction.xyz), 0.0);
    float spread = alpha * alpha / (4.0 * d * d * lh * lh * (alpha + 0.5));
    vec3 edge = 0.25 * rim_of(n, v, open);
#ifdef PAINTED
    edge = thrown_back(edge, albedo);
#endif
    return albedo * diffuse_light(n, open, lit) +
           key_light.rgb * fresnel * (facing * spread * lit) + edge;
#endif
}
#endif

void main() {
#ifndef FAST
    if (mirror < 0.0 && !floor_mirrors(world)) {
        discard;
    }
#endif
    vec4 both = both_uv();
    vec4 base = base_colour * tint;
#ifdef HAS_BASE
    base *= shown_as_linear(texture(base_map, AT_BASE));
#endif
#if defined(ALPHA_MASK)
    if (base.a < shading.w) {
        discard;
    }
    base.a = 1.0;
#elif !defined(ALPHA_BLEND)
    base.a = 1.0;
#endif
#ifdef OUTLINE
    vec3 result = outline_colour.rgb;
#endif
#ifdef TOON
    vec3 shade = shade_colour.rgb * tint.rgb;
#ifdef HAS_SHADE
    shade *= shown_as_linear(texture(shade_map, AT(SLOT_SHADE))).rgb;
#endif
    vec3 shaded = toon_colour(base.rgb, shade, both);
#ifdef OUTLINE
    result *= mix(vec3(1.0), shaded, outline_colour.a);
#else
    vec3 result = shaded;
#endif
#elif defined(LIT)
    vec3 result = lit_colour(base.rgb, both);
#else
    vec3 result = base.rgb;
#endif
#ifndef OUTLINE
    vec3 glow = emissive.rgb;
#ifdef HAS_EMISSIVE
    glow *= shown_as_linear(texture(emissive_map, AT(SLOT_EMISSIVE))).rgb;
#endif
    result += glow;
#endif
#ifdef LIT
    colour = vec4(to_screen(tone_mapped(result)), base.a);
#else
    colour = vec4(to_screen(min(result, 1.0)), base.a);
#endif
    colour.rgb *= base.a;
}

#endif
