#include "render/mannequin/face_shape.hpp"

namespace raks::render {

FaceShape face_shape(FaceExpression expression) noexcept {
    using E = FaceExpression;
    switch (expression) {
        case E::happy:
            return {.lids = {0.16F, 0.16F},
                    .lower_lids = 0.34F,
                    .brow_inner = 0.0020F,
                    .brow_outer = 0.0030F,
                    .mouth_open = 0.0078F,
                    .mouth_wider = 0.0072F,
                    .corners_up = 0.0078F};
        case E::angry:
            return {.lids = {0.18F, 0.18F},
                    .lower_lids = 0.20F,
                    .brow_inner = -0.0066F,
                    .brow_outer = 0.0024F,
                    .mouth_wider = 0.0010F,
                    .corners_up = -0.0066F};
        case E::sad:
            return {.lids = {0.24F, 0.24F},
                    .brow_inner = 0.0072F,
                    .brow_outer = -0.0036F,
                    .mouth_wider = -0.0022F,
                    .corners_up = -0.0078F};
        case E::relaxed:
            return {.lids = {0.28F, 0.28F},
                    .lower_lids = 0.14F,
                    .brow_inner = 0.0014F,
                    .brow_outer = 0.0010F,
                    .mouth_wider = 0.0036F,
                    .corners_up = 0.0038F};
        case E::surprised:
            return {.lids = {-0.24F, -0.24F},
                    .lower_lids = -0.12F,
                    .brow_inner = 0.0085F,
                    .brow_outer = 0.0075F,
                    .mouth_open = 0.0140F,
                    .mouth_wider = -0.0056F,
                    .corners_up = -0.0030F};
        case E::aa:
            return {.mouth_open = 0.0150F, .mouth_wider = 0.0010F};
        case E::ih:
            return {.mouth_open = 0.0050F, .mouth_wider = 0.0025F};
        case E::ou:
            return {.mouth_open = 0.0060F, .mouth_wider = -0.0100F};
        case E::ee:
            return {.mouth_open = 0.0078F, .mouth_wider = 0.0045F, .corners_up = 0.0010F};
        case E::oh:
            return {.mouth_open = 0.0130F, .mouth_wider = -0.0065F};
        case E::blink:
            return {.lids = {1.0F, 1.0F}};
        case E::blink_left:
            return {.lids = {1.0F, 0.0F}};
        case E::blink_right:
            return {.lids = {0.0F, 1.0F}};
        case E::look_up:
            return {.lids = {-0.12F, -0.12F}, .gaze_up = 0.0035F, .brow_inner = 0.0008F};
        case E::look_down:
            return {.lids = {0.28F, 0.28F}, .gaze_up = -0.0035F};
        case E::look_left:
            return {.gaze_right = 0.0062F};
        case E::look_right:
            return {.gaze_right = -0.0062F};
        case E::brow_up_left:
            return {.lids = {-0.10F, 0.04F}, .brow_up = {0.0062F, -0.0014F}};
        case E::brow_up_right:
            return {.lids = {0.04F, -0.10F}, .brow_up = {-0.0014F, 0.0062F}};
        case E::neutral:
            break;
    }
    return {};
}

}  // namespace raks::render
