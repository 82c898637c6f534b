#include "motion/capture/markers/track_c3d.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace raks::capture {
namespace {

constexpr std::size_t kC3dBlockBytes = 512;
constexpr char kIntel = 84;
constexpr std::size_t kMostC3dMarkers = 255;
constexpr std::size_t kMostC3dFrames = 65535;

std::string word(std::size_t value) {
    return {static_cast<char>(value & 0xFFU), static_cast<char>(value >> 8U & 0xFFU)};
}

std::string number(double value) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    return word(bits & 0xFFFFU) + word(bits >> 16U);
}

// A record of the parameter section: of a group (negative: the group itself), with its content.
std::string record(int group, const std::string& name, std::string content) {
    content += '\0';  // no description
    return std::string(1, static_cast<char>(name.size())) + static_cast<char>(group) + name +
           word(content.size() + 2) + content;
}

std::string whole(int group, const std::string& name, std::size_t value) {
    return record(group, name, std::string{2, 0} + word(value));
}

std::string real(int group, const std::string& name, double value) {
    return record(group, name, std::string{4, 0} + number(value));
}

std::string texts(int group, const std::string& name, std::vector<std::string> list) {
    std::size_t longest = 1;
    for (const std::string& text : list) {
        longest = std::max(longest, text.size());
    }
    std::string content = {'\xFF', 2, static_cast<char>(longest), static_cast<char>(list.size())};
    for (std::string& text : list) {
        text.resize(longest, ' ');
        content += text;
    }
    return record(group, name, content);
}

void fill_block(std::string& bytes) {
    bytes.resize((bytes.size() + kC3dBlockBytes - 1) / kC3dBlockBytes * kC3dBlockBytes, '\0');
}

std::string parameters_of(const Tracks& tracks, std::size_t markers) {
    constexpr int kPoint = 1;
    constexpr int kTrial = 2;
    const std::vector<std::string> names(
        tracks.markers.begin(), tracks.markers.begin() + static_cast<std::ptrdiff_t>(markers));
    std::string body = record(-kPoint, "POINT", "") + record(-kTrial, "TRIAL", "");
    body += whole(kPoint, "USED", markers) + real(kPoint, "SCALE", -1.0) +
            real(kPoint, "RATE", tracks.frames_per_second) +
            whole(kPoint, "FRAMES", std::min(kMostC3dFrames, tracks.frame_count)) +
            texts(kPoint, "LABELS", names) + texts(kPoint, "UNITS", {"m"}) +
            texts(kPoint, "X_SCREEN", {"+X"}) + texts(kPoint, "Y_SCREEN", {"+Y"});
    const auto field = [&](const std::string& name, std::size_t value) {
        // Two words, the lower one first.
        return record(
            kTrial, name, std::string{2, 1, 2} + word(value & 0xFFFFU) + word(value >> 16U));
    };
    body += field("ACTUAL_START_FIELD", 1) + field("ACTUAL_END_FIELD", tracks.frame_count);
    // What follows the last record is 0, which ends them. The blocks are counted in a byte.
    const std::size_t blocks = (4 + body.size() + 2 + kC3dBlockBytes - 1) / kC3dBlockBytes;
    std::string bytes = std::string{1, 'P', static_cast<char>(blocks), kIntel} + body;
    bytes.resize(blocks * kC3dBlockBytes, '\0');
    return bytes;
}

}  // namespace

std::string c3d_bytes(const Tracks& tracks) {
    const std::size_t markers = std::min(kMostC3dMarkers, tracks.markers.size());
    const std::string parameters = parameters_of(tracks, markers);
    std::string file = std::string{2, 'P'} + word(markers) + word(0) + word(1) +
                       word(std::min(kMostC3dFrames, tracks.frame_count)) + word(0) + number(-1.0) +
                       word(2 + parameters.size() / kC3dBlockBytes) + word(0) +
                       number(tracks.frames_per_second);
    fill_block(file);
    file += parameters;
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        for (std::size_t marker = 0; marker < markers; ++marker) {
            const MarkerPlace& place = tracks.at(frame, marker);
            const bool is_known = place.source != PlaceSource::lost;
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                file += number(is_known ? place.place[axis] : 0.0);
            }
            file += number(is_known ? 0.0 : -1.0);
        }
    }
    fill_block(file);
    return file;
}

}  // namespace raks::capture
