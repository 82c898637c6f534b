#include <algorithm>
#include <array>
#include <cstddef>

#include "base/random.hpp"
#include "tests/fuzz/mutation.hpp"

namespace raks::fuzz {
namespace {

constexpr std::array<std::uint32_t, 12> kEdges = {
    0, 1, 2, 0x7F, 0x80, 0xFF, 0x7FFF, 0x8000, 0xFFFF, 0x7FFF'FFFF, 0x8000'0000, 0xFFFF'FFFF};
constexpr std::size_t kHead = 128;     // bytes, where most of a format's numbers are
constexpr std::size_t kStretch = 512;  // bytes that are moved
constexpr std::size_t kPageHead = 27;  // bytes of an Ogg page before its table of segments
constexpr std::size_t kSumAt = 22;     // in it

std::size_t byte_at(std::string_view bytes, std::size_t at) {
    return static_cast<unsigned char>(bytes[at]);
}

// Size of the Ogg page at the start of `bytes`; 0: there is no whole one.
std::size_t page_size(std::string_view bytes) {
    if (!bytes.starts_with("OggS") || bytes.size() < kPageHead ||
        bytes.size() < kPageHead + byte_at(bytes, 26)) {
        return 0;
    }
    std::size_t size = kPageHead + byte_at(bytes, 26);
    for (std::size_t i = 0; i < byte_at(bytes, 26); ++i) {
        size += byte_at(bytes, kPageHead + i);
    }
    return size <= bytes.size() ? size : 0;
}

// CRC-32 of Ogg (RFC 3533): polynomial 0x04c11db7, not reflected, from 0.
std::uint32_t page_sum(std::string_view page) {
    std::uint32_t sum = 0;
    for (const char byte : page) {
        sum ^= static_cast<std::uint32_t>(static_cast<unsigned char>(byte)) << 24U;
        for (int bit = 0; bit < 8; ++bit) {
            sum = (sum << 1U) ^ ((sum & 0x8000'0000U) != 0 ? 0x04c1'1db7U : 0U);
        }
    }
    return sum;
}

void mend_page_sums(std::string& bytes) {
    for (std::size_t at = bytes.find("OggS"); at != std::string::npos;) {
        const std::size_t size = page_size(std::string_view(bytes).substr(at));
        if (size > 0) {
            std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at + kSumAt), 4, '\0');
            const std::uint32_t sum = page_sum(std::string_view(bytes).substr(at, size));
            for (std::size_t i = 0; i < 4; ++i) {
                bytes[at + kSumAt + i] = static_cast<char>(sum >> (8 * i));
            }
        }
        at = bytes.find("OggS", at + std::max<std::size_t>(size, 1));
    }
}

/// Draws of one mutation.
class ByteMutation {
 public:
    ByteMutation(std::string_view bytes, std::uint64_t seed) : bytes_(bytes), random_(seed) {}

    std::string run() {
        const std::size_t changes = 1 + below(8);
        for (std::size_t i = 0; i < changes && !bytes_.empty(); ++i) {
            change();
        }
        if (below(4) != 0) {
            mend_page_sums(bytes_);
        }
        return std::move(bytes_);
    }

 private:
    std::size_t below(std::size_t count) {
        return count == 0 ? 0 : static_cast<std::size_t>(random_.below(draw_++, count));
    }
    // Half of the places lie in the head.
    std::size_t place() {
        return below(below(2) == 0 ? std::min(bytes_.size(), kHead) : bytes_.size());
    }
    std::size_t length_from(std::size_t at) {
        return 1 + below(std::min(kStretch, bytes_.size() - at));
    }

    void change() {
        switch (below(10)) {
            case 0:
            case 1:
            case 2:
                bytes_[place()] = static_cast<char>(below(256));
                return;
            case 3:
            case 4:
            case 5:
                return put_number();
            case 6:
                return repeat_stretch();
            case 7: {
                const std::size_t at = place();
                bytes_.erase(at, length_from(at));
                return;
            }
            case 8: {
                const std::size_t at = place();
                const std::size_t length = length_from(at);
                bytes_.replace(at, length, length, '\0');
                return;
            }
            default:
                bytes_.resize(bytes_.size() - below(std::min(kStretch, bytes_.size())));
        }
    }

    // In the one or the other order of bytes.
    void put_number() {
        const std::uint32_t number = kEdges[below(kEdges.size())];
        const std::size_t size = below(2) == 0 ? 2 : 4;
        const std::size_t at = place();
        const bool is_big_first = below(2) == 0;
        for (std::size_t i = 0; i < size && at + i < bytes_.size(); ++i) {
            const std::size_t shift = 8 * (is_big_first ? size - 1 - i : i);
            bytes_[at + i] = static_cast<char>(number >> shift);
        }
    }
    void repeat_stretch() {
        const std::size_t from = place();
        const std::string copy = bytes_.substr(from, length_from(from));
        bytes_.insert(place(), copy);
    }

    std::string bytes_;
    CounterRandom random_;
    std::uint64_t draw_ = 0;
};

}  // namespace

std::string mutated_bytes(std::string_view bytes, std::uint64_t seed) {
    return ByteMutation(bytes, seed).run();
}

}  // namespace raks::fuzz
