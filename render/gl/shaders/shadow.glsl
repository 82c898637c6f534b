uniform sampler2DShadow shadow_map;

// Share of the key light that reaches a point: 5 x 5 taps, 1 outside of the map.
float key_visibility(vec3 at) {
    vec3 p = (shadow_from_world * vec4(at, 1.0)).xyz;
    if (any(lessThan(p, vec3(0.0))) || any(greaterThan(p, vec3(1.0)))) {
        return 1.0;
    }
    vec2 texel = 1.0 / vec2(textureSize(shadow_map, 0));
    float sum = 0.0;
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) {
            sum += texture(shadow_map, vec3(p.xy + vec2(x, y) * texel, p.z - 0.0012));
        }
    }
    return sum / 25.0;
}
