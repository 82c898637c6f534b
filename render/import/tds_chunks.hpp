// The chunks of a 3DS file: an id, a length, and numbers or more chunks within.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/expected.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// The first fault that was found while a file was read. Threads: one. Real-time: no.
class TdsFaults {
 public:
    /// Keeps the line, if it is the first.
    void note(std::string line);
    [[nodiscard]] bool any() const noexcept { return !line_.empty(); }
    [[nodiscard]] Expected<void> finish() const;

 private:
    std::string line_;
};

/// A chunk and how far it is read. Reading beyond its end, or a number that is none, is a fault;
/// what is read is 0 then, and no more chunks come. Copies read on their own. The bytes and the
/// faults must outlive it. Threads: one. Real-time: no.
class TdsChunk {
 public:
    /// All of a file, as if it were inside of a chunk.
    TdsChunk(std::span<const std::byte> file, TdsFaults& faults)
        : file_(file), faults_(&faults), end_(file.size()) {}

    [[nodiscard]] std::uint16_t id() const noexcept { return id_; }
    [[nodiscard]] std::size_t left() const noexcept { return end_ - at_; }
    /// The next chunk within this one; none at its end, and after a fault of anything. A chunk that
    /// says that it is shorter than its head, or longer than what holds it, is a fault.
    [[nodiscard]] std::optional<TdsChunk> next();

    [[nodiscard]] std::uint8_t u8();
    [[nodiscard]] std::uint16_t u16();
    [[nodiscard]] std::uint32_t u32();
    /// Faults: not finite, beyond 1e7 either way.
    [[nodiscard]] float number();
    [[nodiscard]] glm::vec2 vector2();
    [[nodiscard]] glm::vec3 vector3();
    /// Bytes up to a zero, which is read, too. Faults: no zero.
    [[nodiscard]] std::string text();
    void skip(std::size_t bytes);
    /// How many things of `size` bytes are said to follow; `count` of them at once. Faults: more
    /// than there are; 0 is returned then.
    [[nodiscard]] std::size_t checked(std::size_t count, std::size_t size);

    /// Notes a fault with the chunk's id and place in front.
    void complain(const std::string& what) const;
    [[nodiscard]] TdsFaults& faults() const noexcept { return *faults_; }

 private:
    [[nodiscard]] bool takes(std::size_t bytes);
    [[nodiscard]] std::uint32_t little_endian(std::size_t bytes);

    std::span<const std::byte> file_;
    TdsFaults* faults_;
    std::uint16_t id_ = 0;
    std::size_t start_ = 0;  // of its head
    std::size_t at_ = 0;
    std::size_t end_ = 0;
};

}  // namespace raks::render
