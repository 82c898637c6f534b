uniform sampler2D drawn;  // premultiplied
uniform vec3 key;
uniform ivec2 corner;  // of the picture in its target

out vec4 colour;

void main() {
    vec4 at = texelFetch(drawn, ivec2(gl_FragCoord.xy) - corner, 0);
    colour = vec4(at.a < 0.5 ? key : at.rgb / at.a, 1.0);
}
