// Matt paint: Lambert's law, a quarter of the light from everywhere, 15 % of a highlight. Without the
// tone curve, so that a colour stays of one hue in light and shade.
in vec3 normal;
in vec3 world;

uniform vec3 paint;  // linear

out vec4 shown;

void main() {
    vec3 n = normalize(normal);
    float facing = max(dot(n, key_direction.xyz), 0.0);
    vec3 half_way = normalize(normalize(eye.xyz - world) + key_direction.xyz);
    float highlight = facing > 0.0 ? pow(max(dot(n, half_way), 0.0), 30.0) : 0.0;
    shown = vec4(encoded(clamp(paint * (0.25 + 0.75 * facing) + 0.15 * highlight, 0.0, 1.0)), 1.0);
}
