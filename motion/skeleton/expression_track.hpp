// What an expression of the face does while poses go on.
#pragma once

#include <string>
#include <vector>

namespace raks::motion {

/// One expression, by frame of a clip.
struct ExpressionTrack {
    std::string name;            ///< "happy"
    bool is_preset = true;       ///< one of VRM 1.0's
    std::vector<float> weights;  ///< one a pose, [0, 1]
};

}  // namespace raks::motion
