// The records of a binary FBX. Nothing is checked beyond what each function says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace raks::engine {

/// Bytes before the first record: the magic and the version.
inline constexpr std::size_t kFbxHead = 27;

/// Whether it begins as a binary FBX does.
[[nodiscard]] bool is_binary_fbx(std::string_view bytes);
/// 7400 for 7.4. `bytes`: kFbxHead at least.
[[nodiscard]] std::uint32_t fbx_version(std::string_view bytes);

/// A number of the file at a place that is in it.
template <typename Number>
[[nodiscard]] Number fbx_number(std::string_view bytes, std::size_t offset) {
    Number number = 0;
    std::memcpy(&number, bytes.data() + offset, sizeof(number));
    return number;
}

/// The head of a record; its name, properties and the records in it follow.
struct FbxRecord {
    std::uint64_t end = 0;  ///< where it ends in the file; 0: there are no more
    std::uint64_t properties = 0;
    std::uint64_t property_bytes = 0;
    std::uint8_t name_bytes = 0;
};

/// Reads heads and properties; from 7500 on lengths have 64 bits.
/// Threads: any. Real-time: no.
class FbxRecords {
 public:
    /// `bytes`: all of the file, kFbxHead at least; they stay the caller's.
    explicit FbxRecords(std::string_view bytes);

    [[nodiscard]] std::size_t head_bytes() const { return 3 * word_ + 1; }
    /// head_bytes() from `at` on must be in the file.
    [[nodiscard]] FbxRecord record_at(std::size_t at) const;
    /// Bytes of a property with its type; 0: it is none, or does not end before `end`. `at` <
    /// `end`, and `end` in the file.
    [[nodiscard]] std::uint64_t property_bytes(std::size_t at, std::size_t end) const;

 private:
    [[nodiscard]] std::uint64_t word_at(std::size_t offset) const;
    [[nodiscard]] std::uint64_t array_bytes(std::size_t at, std::uint64_t left) const;

    std::string_view bytes_;
    std::size_t word_;
};

}  // namespace raks::engine
