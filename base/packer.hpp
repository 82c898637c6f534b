#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

/// Binary files in this machine's own byte order: for caches, not for exchange.
namespace raks {

/// Bytes from `offset` to the next multiple of `alignment`.
[[nodiscard]] constexpr std::size_t padding(std::size_t offset, std::size_t alignment) noexcept {
    return (alignment - offset % alignment) % alignment;
}

/// Appends plain values and lists of them. Put a struct that has padding field by field, because
/// padding bytes differ from run to run.
class Packer {
 public:
    /// Starts with the bytes of `magic`, which identify the file.
    explicit Packer(std::string_view magic) : bytes_(magic) {}
    /// Appends the bytes of one value.
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    /// Appends the number of values (at most 2^32 - 1), then the values.
    template <class List>
    void put_list(const List& list) {
        static_assert(std::is_trivially_copyable_v<typename List::value_type>);
        put(static_cast<std::uint32_t>(list.size()));
        bytes_.append(reinterpret_cast<const char*>(list.data()),
                      list.size() * sizeof(typename List::value_type));
    }
    /// Appends the number of values, then the values at a multiple of their alignment, so that
    /// they can be used where they lie (Unpacker::take_block).
    template <class T, std::size_t Extent>
    void put_block(std::span<T, Extent> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        put(static_cast<std::uint32_t>(values.size()));
        bytes_.append(padding(bytes_.size(), alignof(T)), '\0');
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    }
    /// All bytes so far; the packer is then empty.
    [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
    std::string bytes_;
};

/// Reads values in the order in which they were put. After a fault every value is zero or empty:
/// ask is_good() at the end. A damaged count allocates no more memory than there are bytes left.
class Unpacker {
 public:
    /// `bytes`, without the magic, must outlive this.
    explicit Unpacker(std::string_view bytes) : left_(bytes) {}
    [[nodiscard]] bool is_good() const { return is_good_; }  ///< false once something was missing
    [[nodiscard]] bool at_end() const { return left_.empty(); }  ///< all was read
    /// Bytes that are not read yet.
    [[nodiscard]] std::size_t left() const { return left_.size(); }

    /// The next value.
    template <class T>
    T take() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value{};
        if (has(sizeof value)) {
            std::memcpy(&value, left_.data(), sizeof value);
            left_.remove_prefix(sizeof value);
        }
        return value;
    }
    /// The next value into `value`, for types without a default; unchanged after a fault.
    template <class T>
    void take_into(T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        if (has(sizeof value)) {
            std::memcpy(static_cast<void*>(&value), left_.data(), sizeof value);
            left_.remove_prefix(sizeof value);
        }
    }
    /// The next list.
    template <class List>
    List take_list() {
        constexpr std::size_t kSize = sizeof(typename List::value_type);
        const std::size_t count = take<std::uint32_t>();
        List list;
        if (count > 0 && has(count * kSize)) {
            list.resize(count);
            std::memcpy(list.data(), left_.data(), count * kSize);
            left_.remove_prefix(count * kSize);
        }
        return list;
    }

    /// The values of put_block() without a copy: they lie in the bytes, which must outlive them and
    /// begin, magic included, at an address that is aligned for T.
    template <class T>
    std::span<const T> take_block() {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::size_t count = take<std::uint32_t>();
        const std::size_t skipped =
            padding(reinterpret_cast<std::uintptr_t>(left_.data()), alignof(T));
        if (!has(skipped + count * sizeof(T))) {
            return {};
        }
        const auto* const first = reinterpret_cast<const T*>(left_.data() + skipped);
        left_.remove_prefix(skipped + count * sizeof(T));
        return {first, count};
    }

 private:
    bool has(std::size_t bytes) {
        is_good_ = is_good_ && bytes <= left_.size();
        left_ = is_good_ ? left_ : std::string_view{};
        return is_good_;
    }

    std::string_view left_;
    bool is_good_ = true;
};

}  // namespace raks
