uniform mat4 clip_from_light;  // the shadow map's own clip space

void main() {
    vec3 at;
    vec3 n;
    skin(at, n);
    gl_Position = clip_from_light * vec4(at, 1.0);
}
