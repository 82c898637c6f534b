layout(location = 4) in vec4 areas_a;  // as albedo_of takes them
layout(location = 5) in vec3 areas_b;
layout(location = 6) in float occlusion;  // ambient: 1 is open

uniform float mirror;  // 1, or -1 for the reflection in the floor

out vec4 a;
out vec3 b;
#ifdef FAST
out vec3 diffuse;
out vec3 added;
out float sharpness;
#else
out vec3 world;
out vec3 world_normal;
out float open;
#endif

void main() {
    vec3 at;
    vec3 n;
    skin(at, n);
    a = areas_a;
    b = areas_b;
#ifdef FAST
    n = normalize(n);
    vec3 v = normalize(eye.xyz - at);
    diffuse = diffuse_light(n, occlusion, mix(0.75, 1.0, occlusion));
    float shine = max(dot(n, normalize(v + key_direction.xyz)), 0.0);
    shine *= shine;               // ^2
    float shine4 = shine * shine; // ^4
    float shine8 = shine4 * shine4;
    // Cloth is matte, skin nearly so.
    float gloss = areas_a.x > 0.0 ? 0.012 : 0.035;
    added = rim_of(n, v, occlusion) * 0.35 + key_light.rgb * (gloss * shine8 * shine4);
    gl_Position = clip_from_world * vec4(at, 1.0);
    sharpness = tone.w / gl_Position.w;
#else
    world = at;
    world_normal = n;
    open = occlusion;
    gl_Position = clip_from_world * vec4(at.x, at.y * mirror, at.z, 1.0);
#endif
}
