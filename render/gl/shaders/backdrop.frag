#ifdef FAST
in vec3 shade;
#endif
out vec4 colour;

void main() {
#ifndef FAST
    vec2 pixel = gl_FragCoord.xy - picture.xy;
    vec3 shade = backdrop(backdrop_place(2.0 * pixel / picture.zw - 1.0));
#endif
    colour = vec4(shade + dither(gl_FragCoord.xy), 1.0);
}
