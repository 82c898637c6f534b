// Beams of light in the air, one instance each, from the lamp to the floor; behind them, as the
// instance after the last, the haze.
layout(location = 0) in vec2 at;  // across, [-1, 1]; along, [0, 1]

uniform int beams;

out vec3 light;

const float kLampHalfWidth = 0.05;  // metres
const float kEndHalfWidth = 0.50;

void main() {
    vec3 place;
    if (gl_InstanceID < beams) {
        vec4 lamp = lamps[gl_InstanceID];
        vec4 end = beam_ends[gl_InstanceID];
        vec3 axis = mix(lamp.xyz, end.xyz, at.y);
        vec3 side = normalize(cross(end.xyz - lamp.xyz, eye.xyz - axis));
        place = axis + side * (at.x * mix(kLampHalfWidth, kEndHalfWidth, at.y));
        float soft = 1.0 - at.x * at.x;
        float fading = (1.0 - 0.8 * at.y) * smoothstep(1.0, 0.85, at.y);
        light = beam_colours[int(end.w)].rgb * (lamp.w * soft * soft * fading);
    } else {
        vec2 flat_toward = normalize(eye.xz + vec2(0.0, 1e-4));
        vec2 flat_side = vec2(flat_toward.y, -flat_toward.x);
        vec2 base = flat_side * (9.0 * at.x) - 3.0 * flat_toward;
        place = vec3(base.x, 3.4 * at.y, base.y);
        float drift = 0.6 + 0.25 * sin(4.0 * at.x + 0.21 * show.z) +
                      0.15 * sin(9.0 * at.x - 5.0 * at.y - 0.37 * show.z);
        float soft = (1.0 - at.x * at.x) * at.y * (1.0 - at.y) * (1.0 - at.y) * 6.7;
        light = mix(beam_colours[0].rgb, beam_colours[1].rgb, 0.5 + 0.5 * at.x) *
                (show.w * soft * drift);
    }
    gl_Position = clip_from_world * vec4(place, 1.0);
}
