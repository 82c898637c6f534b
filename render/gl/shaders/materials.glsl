// Colour areas: signed distances (0.04 m = 1) cut to a crisp edge at the pixel.
#ifdef FAST
in float sharpness;  // pixels of 0.04 m here, seen face-on
float inside(float depth) { return clamp(depth * sharpness + 0.5, 0.0, 1.0); }
#else
float inside(float depth) {
    return clamp(depth / max(fwidth(depth), 1e-5) + 0.5, 0.0, 1.0);
}
#endif

#if defined(DRESS_DANCER)
// a: suit, stripe, outer side, hair; b: shoe, accent (sole and heel, lashes, lips)
vec3 albedo_of(vec4 a, vec3 b) {
    float suit = inside(a.x);
    vec3 colour = mix(materials[0].rgb, materials[3].rgb, inside(a.w));
    colour = mix(colour, materials[4].rgb, inside(b.x));
    vec3 lips = mix(materials[0].rgb, materials[4].rgb, 0.6);
    vec3 accent = mix(mix(lips, materials[3].rgb, inside(a.y)), materials[6].rgb, inside(b.x));
    colour = mix(colour, accent, inside(b.y));
    colour = mix(colour, materials[1].rgb, suit);
    colour = mix(colour, materials[2].rgb, inside(0.2 - abs(a.y)) * suit * inside(a.z));
    return mix(colour, materials[5].rgb, inside(0.14 - abs(a.x)));
}
#elif defined(DRESS_MANNEQUIN)
// b.z: joint band
vec3 albedo_of(vec4 a, vec3 b) {
    vec3 colour = mix(materials[0].rgb, materials[1].rgb, inside(b.z));
    return mix(colour, materials[2].rgb, inside(0.045 - abs(b.z)));
}
#else
// Stick figure; a.x: share of the left's colour, a.y: of the right's
vec3 albedo_of(vec4 a, vec3 b) {
    return materials[0].rgb * (1.0 - a.x - a.y) + materials[1].rgb * a.x + materials[2].rgb * a.y;
}
#endif
