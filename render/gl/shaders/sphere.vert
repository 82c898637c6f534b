// A sphere: of radius 1 at the origin as it comes.
layout(location = 0) in vec3 at;

uniform vec4 place;  // centre, world; radius

out vec3 normal;
out vec3 world;

void main() {
    normal = at;
    world = place.xyz + place.w * at;
    gl_Position = clip_from_world * vec4(world, 1.0);
}
