layout(location = 0) in vec2 place_of_one;  // x, z in metres, of a floor of size 1

#ifdef FAST
out vec4 shade;
#ifdef TILES
out vec3 tiled;  // place, and how far tiles show
#endif
#else
out vec3 world;
#endif

void main() {
    vec2 place = counts.z * place_of_one;
    vec4 clip = clip_from_world * vec4(place.x, 0.0, place.y, 1.0);
    gl_Position = clip;
#ifdef FAST
    float radius = length(place);
    float fade = floor_fade(radius);
    float lit = blob_shadow(place);
    // Behind the camera there is no place in the picture; the clipper never shows that end.
    vec3 behind = backdrop(backdrop_place(clip.xy / max(clip.w, 0.1)));
    vec3 shown = mix(floor_colour(radius, lit),
                     display_horizon.rgb,
                     mirror_share(vec3(place.x, 0.0, place.y)));
    shade = mix(vec4(0.0, 0.0, 0.0, 0.6 * (1.0 - lit) * (1.0 - fade)),
                vec4(mix(shown, behind, fade), 1.0),
                tone.y);
#ifdef TILES
    tiled = vec3(place, mix(0.4, 1.0, lit) * (1.0 - fade) * tone.y);
#endif
#else
    world = vec3(place.x, 0.0, place.y);
#endif
}
