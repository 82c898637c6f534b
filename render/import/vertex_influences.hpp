#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raks::render {

/// All joints and weights of vertices as they lie in a file, `sets` times four a vertex: sets one
/// after the other, each vertex after vertex.
struct RawInfluences {
    std::size_t vertices = 0;
    std::vector<std::vector<std::uint32_t>> joints;  ///< by set; 4 a vertex
    std::vector<std::vector<float>> weights;
};

/// What was mended.
struct InfluenceFaults {
    bool has_negative = false;   ///< read as 0
    bool has_none = false;       ///< a vertex without weight: all of it to its first joint
    bool has_other_sum = false;  ///< further than 5 % from 1
    std::size_t uneven = 0;      ///< vertices whose weights sum to other than 1 (0.001)
    bool has_more = false;       ///< more than four that weigh
    int used = -1;               ///< the largest joint that weighs
    int unused = -1;             ///< the largest that does not
};

/// The four that weigh most, in falling order, divided by their sum; joint 0 where there are fewer.
InfluenceFaults merge_influences(const RawInfluences& raw,
                                 std::vector<std::array<std::uint16_t, 4>>& joints,
                                 std::vector<std::array<float, 4>>& weights);

}  // namespace raks::render
