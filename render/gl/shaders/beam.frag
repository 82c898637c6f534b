in vec3 light;
out vec4 colour;

// Alpha 0 adds.
void main() { colour = vec4(light, 0.0); }
