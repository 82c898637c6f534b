// What one dancer wears: linear colours. Mirrored by DressColours in render/dress.hpp.
layout(std140) uniform Dress { vec4 dress[10]; };
#define DRESS_SKIN 0
#define DRESS_SUIT 1
#define DRESS_STRIPE 2
#define DRESS_HAIR 3
#define DRESS_SHOES 4
#define DRESS_TRIM 5
#define DRESS_SOLE 6
