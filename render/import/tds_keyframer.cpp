#include "render/import/tds_keyframer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/printable.hpp"

namespace raks::render {
namespace {

constexpr std::uint16_t kTdsFirstNode = 0xB001;
constexpr std::uint16_t kTdsLastNode = 0xB007;
constexpr std::uint16_t kTdsNodeHead = 0xB010;
constexpr std::uint16_t kTdsInstance = 0xB011;
constexpr std::uint16_t kTdsPivot = 0xB013;
constexpr std::uint16_t kTdsPositions = 0xB020;
constexpr std::uint16_t kTdsTurns = 0xB021;
constexpr std::uint16_t kTdsScales = 0xB022;
constexpr std::uint16_t kTdsNodeId = 0xB030;
constexpr std::uint16_t kNoTdsParent = 0xFFFF;

/// By id from B001 on.
constexpr std::array<TdsNodeKind, 7> kTdsNodeKinds = {TdsNodeKind::other,
                                                      TdsNodeKind::object,
                                                      TdsNodeKind::camera,
                                                      TdsNodeKind::target,
                                                      TdsNodeKind::light,
                                                      TdsNodeKind::target,
                                                      TdsNodeKind::light};

void read_value(TdsChunk& chunk, glm::vec3& value) { value = chunk.vector3(); }

void read_value(TdsChunk& chunk, TdsTurn& value) {
    value.angle = chunk.number();
    value.axis = chunk.vector3();
}

/// A key's head: its frame, and which numbers of the curve follow.
template <typename Value>
TdsKey<Value> read_key(TdsChunk& chunk) {
    TdsKey<Value> key;
    key.frame = chunk.u32();
    const std::uint16_t flags = chunk.u16();
    float ease = 0.0F;  // how fast the key is come to and left: not drawn
    float* const numbers[] = {&key.tension, &key.continuity, &key.bias, &ease, &ease};
    for (std::size_t bit = 0; bit < std::size(numbers); ++bit) {
        if ((flags >> bit & 1U) != 0) {
            *numbers[bit] = std::clamp(chunk.number(), -1.0F, 1.0F);
        }
    }
    read_value(chunk, key.value);
    return key;
}

template <typename Value>
std::vector<TdsKey<Value>> read_track(TdsChunk& chunk, const TdsNode& node, TdsFile& file) {
    constexpr std::size_t kBeforeCount = 10;  // flags and two numbers that say nothing
    constexpr std::size_t kLeastKey = 18;
    chunk.skip(kBeforeCount);
    std::vector<TdsKey<Value>> keys(chunk.checked(chunk.u32(), kLeastKey));
    std::generate(keys.begin(), keys.end(), [&] { return read_key<Value>(chunk); });
    const bool rises =
        std::adjacent_find(keys.begin(), keys.end(), [](const auto& a, const auto& b) {
            return a.frame >= b.frame;
        }) == keys.end();
    if (!rises) {
        file.note(fmt::format(
            "\"{}\": its keyframes do not follow one another in time; only the first is kept",
            printable(node.name, 60)));
        keys.resize(1);
    }
    return keys;
}

void read_node_head(TdsChunk& chunk, TdsNode& node) {
    node.name = chunk.text();
    chunk.skip(4);  // flags
    const std::uint16_t parent = chunk.u16();
    node.parent = parent == kNoTdsParent ? std::nullopt : std::optional(parent);
}

TdsNode read_node(TdsChunk& chunk, TdsFile& file) {
    TdsNode node;
    node.kind = kTdsNodeKinds[chunk.id() - kTdsFirstNode];
    while (auto part = chunk.next()) {
        switch (part->id()) {
            case kTdsNodeId:
                node.id = part->u16();
                break;
            case kTdsNodeHead:
                read_node_head(*part, node);
                break;
            case kTdsInstance:
                node.instance = part->text();
                break;
            case kTdsPivot:
                node.pivot = part->vector3();
                break;
            case kTdsPositions:
                node.positions = read_track<glm::vec3>(*part, node, file);
                break;
            case kTdsTurns:
                node.turns = read_track<TdsTurn>(*part, node, file);
                break;
            case kTdsScales:
                node.scales = read_track<glm::vec3>(*part, node, file);
                break;
            default:
                break;
        }
    }
    return node;
}

}  // namespace

void read_tds_keyframer(TdsChunk& chunk, TdsFile& file) {
    while (auto part = chunk.next()) {
        if (part->id() >= kTdsFirstNode && part->id() <= kTdsLastNode) {
            file.nodes.push_back(read_node(*part, file));
            if (file.nodes.size() > kMostTdsNodes) {
                part->complain(fmt::format("there are more than {} nodes", kMostTdsNodes));
            }
        }
    }
}

}  // namespace raks::render
