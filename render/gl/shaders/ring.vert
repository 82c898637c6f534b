// Fast rings: strips of triangles round the middle, one instance a ring.
layout(location = 0) in vec4 shape;  // cos, sin, offset in half widths, brightness

out float brightness;

void main() {
    vec4 ring = rings[gl_InstanceID];
    float radius = max(ring.x + shape.z * ring.z, 0.0);
    bool is_line = abs(shape.z) < 1.0;
    brightness = ring.y * shape.w * (is_line ? 1.0 : ring.w);
    gl_Position = clip_from_world * vec4(radius * shape.x, 0.002, radius * shape.y, 1.0);
}
