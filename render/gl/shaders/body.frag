in vec4 a;
in vec3 b;
#ifdef FAST
in vec3 diffuse;
in vec3 added;
#else
in vec3 world;
in vec3 world_normal;
in float open;
uniform float mirror;
#endif
out vec4 colour;

#ifdef FAST

void main() {
    vec3 albedo = albedo_of(a, b);
    colour = vec4(sqrt(tone_mapped(albedo * diffuse + thrown_back(added, albedo))), 1.0);
}

#else

// Key light's highlight: GGX with Schlick's Fresnel term and the Kelemen visibility term.
vec3 highlight(vec3 n, vec3 v, float roughness) {
    float alpha2 = roughness * roughness * roughness * roughness;
    vec3 h = normalize(v + key_direction.xyz);
    float nh = max(dot(n, h), 0.0);
    float lh = max(dot(key_direction.xyz, h), 0.05);
    float d = nh * nh * (alpha2 - 1.0) + 1.0;
    float fresnel = 0.025 + 0.975 * pow(1.0 - lh, 5.0);
    float facing = max(dot(n, key_direction.xyz), 0.0);
    return key_light.rgb * (facing * fresnel * alpha2 / (4.0 * d * d * lh * lh));
}

void main() {
    if (mirror < 0.0 && !floor_mirrors(world)) {
        discard;
    }
    vec3 n = normalize(world_normal);
    vec3 v = normalize(vec3(eye.x, eye.y * mirror, eye.z) - world);
    float lit = key_visibility(world + 0.012 * n);
    vec3 albedo = albedo_of(a, b);
    vec3 light = albedo * diffuse_light(n, open, lit);
    // Cloth is matte; skin shines a little, and lets light through where its own shadow begins.
    float suit = inside(a.x);
    light += highlight(n, v, mix(0.66, 0.88, suit)) * (mix(0.75, 0.5, suit) * lit);
    light += thrown_back(0.35 * rim_of(n, v, open), albedo);
#ifdef DRESS_DANCER
    float turn = dot(n, key_direction.xyz) + 0.05;
    light += (1.0 - suit) * exp(-18.0 * turn * turn) * lit * key_light.rgb *
             (albedo * vec3(0.10, 0.02, 0.008));
#endif
    colour = vec4(encoded(tone_mapped(light)), 1.0);
}

#endif
