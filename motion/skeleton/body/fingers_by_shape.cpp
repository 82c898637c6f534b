#include "motion/skeleton/body/fingers_by_shape.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace raks::motion {
namespace {

constexpr std::size_t kFingers = 5;
constexpr double kConfidence = 0.8;    // of a finger's bones
constexpr double kThumbNearer = 0.85;  // its distance from the wrist, of the next one's

/// Joints of a chain, from the hand on.
using Chain = std::vector<int>;

/// Chains of two joints or more that end below the hand and have no branch.
std::vector<Chain> chains_below(const ParentTree& tree, int hand) {
    std::vector<Chain> chains;
    for (const int joint : tree.order()) {
        if (!tree.is_below(joint, hand) || !tree.children(joint).empty()) {
            continue;
        }
        Chain chain = {joint};
        for (int at = tree.parent(joint); at != hand && tree.children(at).size() == 1;
             at = tree.parent(at)) {
            chain.push_back(at);
        }
        std::reverse(chain.begin(), chain.end());
        if (chain.size() > 1) {
            chains.push_back(std::move(chain));
        }
    }
    return chains;
}

/// A finger without the bone within the palm, which begins nearer to the wrist than it is long, and
/// without a joint at its tip.
Chain without_palm(const PosedSkeleton& skeleton, int hand, Chain chain) {
    const bool is_long = chain.size() > 3;
    if (is_long && skeleton.distance(hand, chain[0]) < skeleton.length(chain[1])) {
        chain.erase(chain.begin());
    }
    chain.resize(std::min<std::size_t>(chain.size(), 3));
    return chain;
}

/// Moves the thumb to the front: the only chain that is shorter than all others, which have a bone
/// within the palm, or the one that begins clearly nearer to the wrist. False: neither tells.
bool put_thumb_first(const PosedSkeleton& skeleton, int hand, std::vector<Chain>& chains) {
    std::sort(chains.begin(), chains.end(), [](const Chain& a, const Chain& b) {
        return a.size() < b.size();
    });
    if (chains[0].size() < chains[1].size() && chains[1].size() > 3) {
        return true;
    }
    const auto from_wrist = [&](const Chain& chain) { return skeleton.distance(hand, chain[0]); };
    std::sort(chains.begin(), chains.end(), [&](const Chain& a, const Chain& b) {
        return from_wrist(a) < from_wrist(b);
    });
    return from_wrist(chains[0]) < kThumbNearer * from_wrist(chains[1]);
}

/// Sorts the four fingers by the line on which they begin, from the thumb's end on.
void sort_from(const PosedSkeleton& skeleton, int thumb, std::vector<Chain>& fingers) {
    int first = fingers[0][0];
    int last = fingers[1][0];
    for (const Chain& a : fingers) {
        for (const Chain& b : fingers) {
            if (skeleton.distance(a[0], b[0]) > skeleton.distance(first, last)) {
                first = a[0];
                last = b[0];
            }
        }
    }
    if (skeleton.distance(thumb, last) < skeleton.distance(thumb, first)) {
        std::swap(first, last);
    }
    const auto along = [&](const Chain& chain) {
        const double from = skeleton.distance(chain[0], first);
        const double to = skeleton.distance(chain[0], last);
        return from * from - to * to;  // grows evenly along the line
    };
    std::sort(fingers.begin(), fingers.end(), [&](const Chain& a, const Chain& b) {
        return along(a) < along(b);
    });
}

/// By length a joint within the palm may have been taken for the hand: it is what carries fingers.
void lift_hand(const ParentTree& tree, Side side, FoundJoints& found) {
    constexpr double kByShape = 0.85;  // confidence of bones that no name gives, at best
    constexpr std::size_t kFan = 3;    // chains on a hand
    const Bone bone = on_side(Bone::left_hand, side);
    auto& hand = found.mapping.joints[index_of(bone)];
    const auto arm = found.mapping.joint(on_side(Bone::left_lower_arm, side));
    if (!hand || !arm || found.confidence[index_of(bone)] > kByShape) {
        return;
    }
    const int above = tree.parent(static_cast<int>(*hand));
    if (above >= 0 && tree.is_below(above, static_cast<int>(*arm)) &&
        chains_below(tree, above).size() >= kFan) {
        hand = static_cast<std::size_t>(above);
    }
}

/// A thumb of two joints has no metacarpal of its own; another finger of two has no tip.
std::array<int, 3> as_bones(const Chain& chain, bool is_thumb) {
    std::array<int, 3> bones = {-1, -1, -1};
    const std::size_t skipped = is_thumb && chain.size() == 2 ? 1 : 0;
    std::copy(chain.begin(), chain.end(), bones.begin() + static_cast<std::ptrdiff_t>(skipped));
    return bones;
}

}  // namespace

FingersByShape fingers_by_shape(const PosedSkeleton& skeleton, int hand) {
    FingersByShape found;
    std::vector<Chain> chains = chains_below(skeleton.tree(), hand);
    found.chains = static_cast<int>(chains.size());
    if (chains.size() != kFingers || !put_thumb_first(skeleton, hand, chains)) {
        return found;
    }
    Chain thumb = chains[0];
    thumb.resize(std::min<std::size_t>(thumb.size(), 3));
    std::vector<Chain> fingers;
    for (std::size_t i = 1; i < chains.size(); ++i) {
        fingers.push_back(without_palm(skeleton, hand, chains[i]));
    }
    sort_from(skeleton, thumb[0], fingers);
    found.joints[0] = as_bones(thumb, true);
    for (std::size_t i = 0; i < fingers.size(); ++i) {
        found.joints[i + 1] = as_bones(fingers[i], false);
    }
    found.is_found = true;
    return found;
}

void take_fingers(const PosedSkeleton& skeleton, FoundJoints& found) {
    int unclear = 0;  // chains on a hand
    for (const Side side : kSides) {
        const std::size_t first = index_of(on_side(Bone::left_thumb_metacarpal, side));
        const std::size_t last = index_of(on_side(Bone::left_little_distal, side));
        const bool has_some = std::any_of(found.mapping.joints.begin() + static_cast<int>(first),
                                          found.mapping.joints.begin() + static_cast<int>(last + 1),
                                          [](const auto& joint) { return joint.has_value(); });
        if (has_some) {
            continue;
        }
        lift_hand(skeleton.tree(), side, found);
        const auto hand = found.mapping.joint(on_side(Bone::left_hand, side));
        if (!hand) {
            continue;
        }
        const FingersByShape fingers = fingers_by_shape(skeleton, static_cast<int>(*hand));
        if (!fingers.is_found && fingers.chains > 1) {
            unclear = fingers.chains;
        }
        std::size_t bone = first;
        for (const auto& finger : fingers.joints) {
            for (const int joint : finger) {
                if (joint >= 0) {
                    found.mapping.joints[bone] = static_cast<std::size_t>(joint);
                    found.reasons[bone] = "by its place on the hand";
                    found.confidence[bone] = kConfidence;
                }
                ++bone;
            }
        }
    }
    if (unclear > 0) {
        found.notes.push_back(
            fmt::format("which finger is which is not clear ({} chains of joints on a hand); they "
                        "stay at rest (--joints says which they are)",
                        unclear));
    }
}

}  // namespace raks::motion
