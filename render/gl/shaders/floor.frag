#ifdef FAST
in vec4 shade;
#ifdef TILES
in vec3 tiled;
#endif
#else
in vec3 world;
#endif
out vec4 colour;

#ifdef FAST

void main() {
    colour = vec4(shade.rgb + dither(gl_FragCoord.xy) * tone.y, shade.a);
#ifdef TILES
    colour.rgb += tile_light(tiled.xy) * tiled.z;
#endif
}

#else

// Brightness of all rings at a radius.
float ring_light(float radius) {
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        float d = (radius - rings[i].x) / rings[i].z;
        float line = exp(-d * d);
        float glow = rings[i].w * exp(-d * d / 40.0);
        sum += rings[i].y * (line + glow);
    }
    return min(sum, 1.0);
}

void main() {
    float radius = length(world.xz);
    float fade = floor_fade(radius);
    float lit = mix(1.0, key_visibility(world), counts.w) * mix(blob_shadow(world.xz), 1.0, 0.55);
    float ring = ring_light(radius) * (1.0 - fade) * mix(0.55, 1.0, lit);

    vec2 pixel = gl_FragCoord.xy - picture.xy;
    vec3 behind = backdrop(backdrop_place(2.0 * pixel / picture.zw - 1.0));
    vec3 shown = mix(floor_colour(radius, lit), behind, fade);
#ifdef TILES
    shown += tile_light(world.xz) * (mix(0.4, 1.0, lit) * (1.0 - fade));
#endif
    shown = shown * (1.0 - ring * display_ring.a) + display_ring.rgb * ring;
    shown += dither(gl_FragCoord.xy);

    // The mirrored dancer lies below already: leave the floor's share of it open.
    float mirrored = mirror_share(world) * (1.0 - fade) * tone.y;
    float alpha = 1.0 - mirrored;
    float shadow_alpha = 0.6 * (1.0 - lit) * (1.0 - fade);
    vec4 bare = vec4(display_ring.rgb * ring, max(shadow_alpha, ring));
    colour = mix(bare, vec4(shown * alpha, alpha), tone.y);
}

#endif
