layout(location = 4) in vec4 tangent;
layout(location = 5) in vec4 uv_both;
layout(location = 6) in vec4 vertex_colour;

uniform float mirror;  // 1, or -1 for the reflection in the floor
#ifdef DEPTH
uniform mat4 clip_from_light;
#endif
#if defined(OUTLINE) && defined(HAS_OUTLINE)
uniform sampler2D outline_map;
#endif

out vec4 uv;       // both sets
out vec2 base_uv;  // as the base texture's slot takes them
out vec4 tint;     // vertex colour
#ifdef PAINTED
out float open;
#endif
#ifndef DEPTH
out vec3 world;
out vec3 world_normal;
#ifdef FAST
out vec4 light;  // rgb: what a lit surface gets; a: cosine to the key light
out vec3 added;  // rim
#endif
#ifdef HAS_NORMAL
#ifdef FAST
out vec3 key_here;  // the key light's direction along tangent, bitangent and normal
#else
out vec4 world_tangent;
#endif
#endif
#ifdef HAS_MATCAP
out vec2 matcap_uv;
#endif
#endif

void main() {
    vec4 r0;
    vec4 r1;
    vec4 r2;
    blend_rows(r0, r1, r2);
    vec4 p = vec4(position, 1.0);
    vec3 at = vec3(dot(r0, p), dot(r1, p), dot(r2, p));
    vec3 n = normalize(vec3(dot(r0.xyz, normal), dot(r1.xyz, normal), dot(r2.xyz, normal)));
    uv = uv_both;
#ifdef ANIMATED
    uv = moved_uv(uv, 1.0);
#endif
    base_uv = slot_uv(SLOT_BASE, uv);
    tint = vertex_colour;
#ifdef PAINTED
    // uv set 1: which colour of the dress, and how open to light the place is.
    tint.rgb *= dress[int(uv_both.z + 0.5)].rgb;
    open = uv_both.w;
#endif
#ifdef DEPTH
    gl_Position = clip_from_light * vec4(at, 1.0);
#else
#ifdef OUTLINE
    float width = rim.z;
#ifdef HAS_OUTLINE
    width *= textureLod(outline_map, slot_uv(SLOT_OUTLINE, uv), 0.0).g;
#endif
#ifndef OUTLINE_SCREEN
    at += n * width;
#endif
#endif
    world = at;
    world_normal = n;
#ifdef HAS_NORMAL
    vec3 t = vec3(dot(r0.xyz, tangent.xyz), dot(r1.xyz, tangent.xyz), dot(r2.xyz, tangent.xyz));
#ifdef FAST
    t = normalize(t - n * dot(n, t) + vec3(1e-9));
    vec3 b = cross(n, t) * tangent.w;
    key_here = vec3(dot(t, key_direction.xyz), dot(b, key_direction.xyz), dot(n, key_direction.xyz));
#else
    world_tangent = vec4(t, tangent.w);
#endif
#endif
    vec3 v = normalize(vec3(eye.x, eye.y * mirror, eye.z) - at);
#ifdef HAS_MATCAP
    vec3 side = normalize(vec3(v.z, 0.0, -v.x));
    matcap_uv = vec2(dot(side, n), -dot(cross(side, v), n)) * 0.495 + 0.5;
#endif
#ifdef FAST
    light = vec4(0.0, 0.0, 0.0, dot(n, key_direction.xyz));
    added = vec3(0.0);
#if defined(PAINTED)
    light.rgb = diffuse_light(n, open, mix(0.75, 1.0, open));
    // None on the inner side of cloth.
    added = thrown_back(rim_of(n, v, open), tint.rgb) * (0.35 * smoothstep(-0.2, 0.0, dot(n, v)));
#elif defined(LIT)
    light.rgb = diffuse_light(n, 1.0, 1.0);
    added = rim_of(n, v, 1.0) * 0.25;
#elif defined(TOON)
#ifdef RIM
    float edge = clamp(1.0 - dot(n, v) + rim.y, 0.0, 1.0);
    added = rim_colour.rgb * pow(edge, max(rim.x, 1e-5));
#endif
#endif
#endif
    gl_Position = clip_from_world * vec4(at.x, at.y * mirror, at.z, 1.0);
#if defined(OUTLINE) && defined(OUTLINE_SCREEN)
    // A fraction of the picture's height.
    vec4 tip = clip_from_world * vec4(at.x + n.x, (at.y + n.y) * mirror, at.z + n.z, 1.0);
    vec2 aspect = vec2(picture.z / picture.w, 1.0);
    vec2 along = (tip.xy / tip.w - gl_Position.xy / gl_Position.w) * aspect;
    gl_Position.xy += normalize(along + vec2(1e-9)) / aspect * (2.0 * width * gl_Position.w);
#endif
#endif
}
