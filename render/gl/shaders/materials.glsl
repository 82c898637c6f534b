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
// a: suit, stripe, outer side, hair; b: shoe, accent (sole and heel)
vec3 albedo_of(vec4 a, vec3 b) {
    float suit = inside(a.x);
    vec3 colour = mix(dress[DRESS_SKIN].rgb, dress[DRESS_HAIR].rgb, inside(a.w));
    colour = mix(colour, dress[DRESS_SHOES].rgb, inside(b.x));
    colour = mix(colour, dress[DRESS_SOLE].rgb, inside(b.y));
    colour = mix(colour, dress[DRESS_SUIT].rgb, suit);
    colour = mix(colour, dress[DRESS_STRIPE].rgb, inside(0.2 - abs(a.y)) * suit * inside(a.z));
    return mix(colour, dress[DRESS_TRIM].rgb, inside(0.14 - abs(a.x)));
}
#elif defined(DRESS_MANNEQUIN)
// b.z: joint band
vec3 albedo_of(vec4 a, vec3 b) {
    vec3 colour = mix(dress[0].rgb, dress[1].rgb, inside(b.z));
    return mix(colour, dress[2].rgb, inside(0.045 - abs(b.z)));
}
#else
// Stick figure; a.x: share of the left's colour, a.y: of the right's
vec3 albedo_of(vec4 a, vec3 b) {
    return dress[0].rgb * (1.0 - a.x - a.y) + dress[1].rgb * a.x + dress[2].rgb * a.y;
}
#endif
