// Light on the body, for a vertex (fast) or a fragment (high).
float wrapped(float cosine, float wrap) { return max((cosine + wrap) / (1.0 + wrap), 0.0); }

// Diffuse light that falls on a surface; `open` is its ambient occlusion, 1 = open.
vec3 diffuse_light(vec3 n, float open, float lit) {
    float key = wrapped(dot(n, key_direction.xyz), 0.18);
    key *= 0.65 + 0.35 * key;
    float fill = wrapped(dot(n, fill_direction.xyz), 0.4);
    vec3 around = mix(ground_light.rgb, sky_light.rgb, 0.5 + 0.5 * n.y);
    return key_light.rgb * (key * lit) + (fill_light.rgb * fill + around) * open;
}

// Light from behind that outlines the body.
vec3 rim_of(vec3 n, vec3 v, float open) {
    float edge = 1.0 - max(dot(n, v), 0.0);
    float facing = max((dot(n, rim_direction.xyz) + 0.25) / 1.25, 0.0);
    return rim_light.rgb * (edge * edge * edge * sqrt(edge) * facing * open);
}
