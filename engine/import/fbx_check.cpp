#include "engine/import/fbx_check.hpp"

#include <cstdint>
#include <cstring>
#include <vector>

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::string_view kMagic{"Kaydara FBX Binary  \0\x1a\0", 23};
constexpr std::size_t kHead = 27;  // the magic and the version
constexpr std::size_t kDeepestRecord = 64;
constexpr std::uint32_t kOldest = 6100;
constexpr std::uint32_t kNewest = 7900;
constexpr std::uint32_t kFirstWide = 7500;  // records with lengths of 64 bits

template <typename Number>
Number number_at(std::string_view bytes, std::size_t offset) {
    Number number = 0;
    std::memcpy(&number, bytes.data() + offset, sizeof(number));
    return number;
}

tl::unexpected<Error> damaged(std::size_t offset, const char* what) {
    return fail(fmt::format("damaged: the record at byte {} {}", offset, what));
}

/// The head of a record.
struct Record {
    std::uint64_t end = 0;  // 0: there are no more
    std::uint64_t properties = 0;
    std::uint64_t property_bytes = 0;
    std::uint8_t name_bytes = 0;
};

/// The records of a file.
class RecordWalk {
 public:
    RecordWalk(std::string_view bytes, bool is_wide)
        : bytes_(bytes), word_(is_wide ? sizeof(std::uint64_t) : sizeof(std::uint32_t)) {}

    Expected<void> run() {
        std::size_t at = kHead;
        while (true) {
            const std::size_t limit = ends_.empty() ? bytes_.size() : ends_.back();
            if (!ends_.empty() && at == limit) {
                ends_.pop_back();
                continue;
            }
            if (head_bytes() > limit - at) {
                return damaged(at, "is cut");
            }
            const Record record = record_at(at);
            if (record.end == 0) {
                if (ends_.empty()) {
                    return {};
                }
                // It closes the list of its parent.
                if (at + head_bytes() != limit) {
                    return damaged(at, "closes a list too soon");
                }
                at = limit;
                continue;
            }
            const std::size_t body = at + head_bytes() + record.name_bytes;
            if (record.end > limit || body > record.end ||
                record.property_bytes > record.end - body) {
                return damaged(at, "does not lie within the one that it is in");
            }
            const auto first = static_cast<std::size_t>(body + record.property_bytes);
            if (auto good = check_properties(record, body, first); !good) {
                return good;
            }
            ends_.push_back(static_cast<std::size_t>(record.end));
            if (ends_.size() > kDeepestRecord) {
                return damaged(at, "lies too deep");
            }
            at = first;
        }
    }

 private:
    [[nodiscard]] std::size_t head_bytes() const { return 3 * word_ + 1; }

    [[nodiscard]] std::uint64_t word_at(std::size_t offset) const {
        return word_ == sizeof(std::uint64_t) ? number_at<std::uint64_t>(bytes_, offset)
                                              : number_at<std::uint32_t>(bytes_, offset);
    }

    [[nodiscard]] Record record_at(std::size_t at) const {
        return {.end = word_at(at),
                .properties = word_at(at + word_),
                .property_bytes = word_at(at + 2 * word_),
                .name_bytes = static_cast<std::uint8_t>(bytes_[at + 3 * word_])};
    }

    /// Bytes of a property with its type; 0: it is none, or is cut.
    [[nodiscard]] std::uint64_t property_bytes(std::size_t at, std::size_t end) const {
        const std::uint64_t left = end - at;
        std::uint64_t size = 1;
        switch (bytes_[at]) {
            case 'C':
            case 'B':
                size += 1;
                break;
            case 'Y':
                size += 2;
                break;
            case 'I':
            case 'F':
                size += 4;
                break;
            case 'D':
            case 'L':
                size += 8;
                break;
            case 'S':
            case 'R':
                size += 4;
                size += left >= size ? number_at<std::uint32_t>(bytes_, at + 1) : 0;
                break;
            case 'f':
            case 'd':
            case 'l':
            case 'i':
            case 'b':
            case 'c':
                return array_bytes(at, left);
            default:
                return 0;
        }
        return size <= left ? size : 0;
    }

    /// Of an array: how many, how packed (1: by zlib), in how many bytes.
    [[nodiscard]] std::uint64_t array_bytes(std::size_t at, std::uint64_t left) const {
        constexpr std::uint64_t kArrayHead = 13;
        if (left < kArrayHead) {
            return 0;
        }
        const char type = bytes_[at];
        const std::uint64_t width = type == 'd' || type == 'l'   ? 8
                                    : type == 'b' || type == 'c' ? 1
                                                                 : 4;
        const std::uint64_t plain = width * number_at<std::uint32_t>(bytes_, at + 1);
        const auto coding = number_at<std::uint32_t>(bytes_, at + 5);
        const std::uint64_t packed = number_at<std::uint32_t>(bytes_, at + 9);
        // zlib makes nothing smaller than a thousandth.
        constexpr std::uint64_t kBestPacking = 1100;
        const bool is_good = coding == 0   ? packed == plain
                             : coding == 1 ? plain <= packed * kBestPacking
                                           : false;
        return is_good && packed <= left - kArrayHead ? kArrayHead + packed : 0;
    }

    Expected<void> check_properties(const Record& record, std::size_t at, std::size_t end) const {
        for (std::uint64_t i = 0; i < record.properties; ++i) {
            const std::uint64_t size = at < end ? property_bytes(at, end) : 0;
            if (size == 0) {
                return damaged(at, "has properties that are none");
            }
            at += static_cast<std::size_t>(size);
        }
        return at == end ? Expected<void>() : damaged(at, "has properties of another length");
    }

    std::string_view bytes_;
    std::size_t word_;
    std::vector<std::size_t> ends_;
};

/// Braces outside of texts and comments: as many close as open, and not too many at a time.
Expected<void> check_braces(std::string_view text) {
    std::size_t depth = 0;
    bool is_text = false;
    bool is_comment = false;
    for (const char c : text) {
        if (is_comment) {
            is_comment = c != '\n';
        } else if (c == '"') {
            is_text = !is_text;
        } else if (is_text) {
            continue;
        } else if (c == ';') {
            is_comment = true;
        } else if (c == '{') {
            ++depth;
        } else if (c == '}' && depth-- == 0) {
            return fail("damaged: a brace closes that was not opened");
        }
        if (depth > kDeepestRecord) {
            return fail("damaged: too many braces inside one another");
        }
    }
    return depth == 0 && !is_text ? Expected<void>() : fail("cut: a brace or a text is not closed");
}

}  // namespace

Expected<void> check_fbx(std::string_view bytes) {
    if (bytes.substr(0, kMagic.size()) == kMagic) {
        if (bytes.size() < kHead) {
            return fail("cut within its head");
        }
        const auto version = number_at<std::uint32_t>(bytes, kMagic.size());
        if (version < kOldest || version > kNewest) {
            return fail(
                fmt::format("FBX version {}: {} to {} are read", version, kOldest, kNewest));
        }
        return RecordWalk(bytes, version >= kFirstWide).run();
    }
    if (bytes.find("FBXHeaderExtension") == std::string_view::npos ||
        bytes.find('\0') != std::string_view::npos) {
        return fail("no FBX");
    }
    return check_braces(bytes);
}

}  // namespace raks::engine
