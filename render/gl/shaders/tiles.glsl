// Glowing tiles of the floor: each of four kinds has its light.
vec3 tile_light(vec2 at) {
    vec2 place = at / show.y;
    vec2 cell = floor(place);
    vec2 from_middle = abs(place - cell - 0.5);
    // Kinds are spread evenly and without a pattern that the eye finds. (Roberts 2018, "R2")
    int kind = int(4.0 * fract(dot(cell, vec2(0.754877666, 0.569840296))));
    // The dark line between tiles; far away, where it is finer than a pixel, its mean.
    float pixel = max(fwidth(place.x), fwidth(place.y));
    float inside = 0.5 - max(from_middle.x, from_middle.y);
    float line = mix(smoothstep(0.015, 0.03 + pixel, inside), 0.85, clamp(2.0 * pixel - 0.4, 0.0, 1.0));
    return tiles[kind].rgb * (line * (1.0 - 1.1 * dot(from_middle, from_middle)));
}
