#include "render/import/tds_chunks.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <utility>

namespace raks::render {
namespace {

constexpr std::size_t kTdsHead = 6;         // bytes: id and length
constexpr float kFarthestTdsNumber = 1e7F;  // places and scales beyond it are refused

}  // namespace

void TdsFaults::note(std::string line) {
    if (line_.empty()) {
        line_ = std::move(line);
    }
}

Expected<void> TdsFaults::finish() const {
    if (any()) {
        return fail(line_);
    }
    return {};
}

void TdsChunk::complain(const std::string& what) const {
    faults_->note(fmt::format("chunk {:04X} at byte {}: {}", id_, start_, what));
}

bool TdsChunk::takes(std::size_t bytes) {
    if (left() < bytes) {
        complain("ends too soon");
        at_ = end_;
        return false;
    }
    at_ += bytes;
    return true;
}

std::uint32_t TdsChunk::little_endian(std::size_t bytes) {
    if (!takes(bytes)) {
        return 0;
    }
    std::uint32_t value = 0;
    for (std::size_t i = bytes; i > 0; --i) {
        value = (value << 8U) | std::to_integer<std::uint32_t>(file_[at_ - bytes + i - 1]);
    }
    return value;
}

std::optional<TdsChunk> TdsChunk::next() {
    if (left() == 0 || faults_->any()) {
        return std::nullopt;
    }
    TdsChunk chunk = *this;
    chunk.start_ = at_;
    chunk.id_ = u16();
    const std::uint32_t length = u32();
    if (faults_->any()) {
        return std::nullopt;
    }
    const std::size_t room = end_ - chunk.start_;
    if (length < kTdsHead || length > room) {
        chunk.complain(
            length < kTdsHead
                ? fmt::format("says that it has {} bytes, less than its header has", length)
                : fmt::format("says that it has {} bytes, but {} are there", length, room));
        return std::nullopt;
    }
    chunk.at_ = at_;
    chunk.end_ = chunk.start_ + length;
    at_ = chunk.end_;
    return chunk;
}

std::uint8_t TdsChunk::u8() { return static_cast<std::uint8_t>(little_endian(1)); }

std::uint16_t TdsChunk::u16() { return static_cast<std::uint16_t>(little_endian(2)); }

std::uint32_t TdsChunk::u32() { return little_endian(4); }

float TdsChunk::number() {
    const auto value = std::bit_cast<float>(u32());
    if (!(std::abs(value) <= kFarthestTdsNumber)) {
        complain(fmt::format("{} is not a number within {}", value, kFarthestTdsNumber));
        return 0.0F;
    }
    return value;
}

glm::vec2 TdsChunk::vector2() {
    const float x = number();
    return {x, number()};
}

glm::vec3 TdsChunk::vector3() {
    const float x = number();
    const float y = number();
    return {x, y, number()};
}

std::string TdsChunk::text() {
    std::string text;
    for (char c = static_cast<char>(u8()); c != '\0'; c = static_cast<char>(u8())) {
        text += c;
    }
    return faults_->any() ? std::string() : text;
}

void TdsChunk::skip(std::size_t bytes) { static_cast<void>(takes(bytes)); }

std::size_t TdsChunk::checked(std::size_t count, std::size_t size) {
    if (count > left() / size) {
        complain(fmt::format(
            "says that it has {} entries, but there is room for {}", count, left() / size));
        return 0;
    }
    return count;
}

}  // namespace raks::render
