#include "engine/import/fbx_records.hpp"

namespace raks::engine {
namespace {

constexpr std::string_view kMagic{"Kaydara FBX Binary  \0\x1a\0", 23};
constexpr std::uint32_t kFirstWide = 7500;  // records with lengths of 64 bits

}  // namespace

bool is_binary_fbx(std::string_view bytes) { return bytes.substr(0, kMagic.size()) == kMagic; }

std::uint32_t fbx_version(std::string_view bytes) {
    return fbx_number<std::uint32_t>(bytes, kMagic.size());
}

FbxRecords::FbxRecords(std::string_view bytes)
    : bytes_(bytes),
      word_(fbx_version(bytes) >= kFirstWide ? sizeof(std::uint64_t) : sizeof(std::uint32_t)) {}

std::uint64_t FbxRecords::word_at(std::size_t offset) const {
    return word_ == sizeof(std::uint64_t) ? fbx_number<std::uint64_t>(bytes_, offset)
                                          : fbx_number<std::uint32_t>(bytes_, offset);
}

FbxRecord FbxRecords::record_at(std::size_t at) const {
    return {.end = word_at(at),
            .properties = word_at(at + word_),
            .property_bytes = word_at(at + 2 * word_),
            .name_bytes = static_cast<std::uint8_t>(bytes_[at + 3 * word_])};
}

std::uint64_t FbxRecords::property_bytes(std::size_t at, std::size_t end) const {
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
            size += left >= size ? fbx_number<std::uint32_t>(bytes_, at + 1) : 0;
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
std::uint64_t FbxRecords::array_bytes(std::size_t at, std::uint64_t left) const {
    constexpr std::uint64_t kArrayHead = 13;
    if (left < kArrayHead) {
        return 0;
    }
    const char type = bytes_[at];
    const std::uint64_t width = type == 'd' || type == 'l' ? 8 : type == 'b' || type == 'c' ? 1 : 4;
    const std::uint64_t plain = width * fbx_number<std::uint32_t>(bytes_, at + 1);
    const auto coding = fbx_number<std::uint32_t>(bytes_, at + 5);
    const std::uint64_t packed = fbx_number<std::uint32_t>(bytes_, at + 9);
    // zlib makes nothing smaller than a thousandth.
    constexpr std::uint64_t kBestPacking = 1100;
    const bool is_good = coding == 0   ? packed == plain
                         : coding == 1 ? plain <= packed * kBestPacking
                                       : false;
    return is_good && packed <= left - kArrayHead ? kArrayHead + packed : 0;
}

}  // namespace raks::engine
