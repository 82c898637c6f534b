layout(location = 0) in vec2 ndc;

#ifdef FAST
out vec3 shade;
#endif

void main() {
#ifdef FAST
    shade = backdrop(backdrop_place(ndc));
#endif
    gl_Position = vec4(ndc, 0.9999999, 1.0);
}
