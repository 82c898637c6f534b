in float brightness;
out vec4 colour;

void main() {
    float cover = mix(1.0, display_ring.a, tone.y);
    colour = vec4(display_ring.rgb * brightness, brightness * cover);
}
