#include "audio/io/container_extent.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "audio/io/head_bytes.hpp"

namespace raks::audio {
namespace {

constexpr int kMostBoxes = 100'000;
constexpr std::int64_t kMostBytes = std::int64_t{1} << 60U;

// A box of MP4 at the top.
struct Box {
    std::string name;
    std::int64_t size = 0;  // with its head
};

std::optional<Box> box_at(const FileWindow& file, std::int64_t at) {
    const std::string head = file.bytes(at, 16);
    if (head.size() < 8) {
        return std::nullopt;
    }
    Box box{head.substr(4, 4), 0};
    std::uint64_t size = number_at(head, 0, 4, ByteOrder::big);
    if (size == 1) {
        size = number_at(head, 8, 8, ByteOrder::big);
    } else if (size == 0) {
        size = static_cast<std::uint64_t>(file.size() - at);  // to the end of the file
    }
    box.size = static_cast<std::int64_t>(
        std::min<std::uint64_t>(size, static_cast<std::uint64_t>(kMostBytes)));
    return box.size >= 8 ? std::optional(box) : std::nullopt;
}

ContainerExtent extent_of_mp4(const FileWindow& file) {
    ContainerExtent extent{.is_known = true, .lacks_index = true};
    std::int64_t at = 0;
    for (int i = 0; i < kMostBoxes && at < file.size(); ++i) {
        const auto box = box_at(file, at);
        if (!box) {
            break;
        }
        at += box->size;
        extent.lacks_index = extent.lacks_index && (box->name != "moov" || at > file.size());
    }
    extent.missing_bytes = std::max<std::int64_t>(at - file.size(), 0);
    return extent;
}

// A number of EBML, whose first byte tells how many follow. All bits set mean "unknown".
std::optional<std::uint64_t> ebml_number(std::string_view bytes, std::size_t& width) {
    const auto first = static_cast<unsigned>(number_at(bytes, 0, 1, ByteOrder::big));
    width = 1;
    while (width < 9 && (first << (width - 1) & 0x80U) == 0) {
        ++width;
    }
    if (width > 8 || bytes.size() < width) {
        return std::nullopt;
    }
    const std::uint64_t mask = (std::uint64_t{1} << 7U * width) - 1;
    const std::uint64_t value = number_at(bytes, 0, width, ByteOrder::big) & mask;
    return value == mask ? std::nullopt : std::optional(value);
}

ContainerExtent extent_of_matroska(const FileWindow& file) {
    ContainerExtent extent;
    const std::string head = file.bytes(0, 4096);
    std::size_t width = 0;
    const auto first = ebml_number(std::string_view(head).substr(4), width);
    if (!first || *first > head.size()) {
        return extent;
    }
    const std::size_t at = 4 + width + static_cast<std::size_t>(*first);
    if (number_at(head, at, 4, ByteOrder::big) != 0x1853'8067 || at + 4 >= head.size()) {
        return extent;  // no segment right behind the head
    }
    const auto size = ebml_number(std::string_view(head).substr(at + 4), width);
    if (size && *size < static_cast<std::uint64_t>(kMostBytes)) {
        extent.is_known = true;
        const auto end = static_cast<std::int64_t>(at + 4 + width + *size);
        extent.missing_bytes = std::max<std::int64_t>(end - file.size(), 0);
    }
    return extent;
}

ContainerExtent extent_of_avi(const FileWindow& file, std::string_view head) {
    ContainerExtent extent;
    const auto size = static_cast<std::int64_t>(number_at(head, 4, 4, ByteOrder::little));
    // A recorder that did not come back leaves 0 or all bits set.
    if (size > 0 && size < std::numeric_limits<std::uint32_t>::max()) {
        extent.is_known = true;
        extent.missing_bytes = std::max<std::int64_t>(8 + size - file.size(), 0);
    }
    return extent;
}

}  // namespace

ContainerExtent read_container_extent(const FileWindow& file) {
    const std::string head = file.bytes(0, 12);
    if (head.size() < 12) {
        return {};
    }
    const std::string_view name = std::string_view(head).substr(4, 4);
    constexpr std::string_view kFirstBoxes = "ftyp moov mdat wide skip pnot styp";
    if (name.find(' ') == std::string_view::npos &&
        kFirstBoxes.find(name) != std::string_view::npos) {
        return extent_of_mp4(file);
    }
    if (head.starts_with("\x1a\x45\xdf\xa3")) {
        return extent_of_matroska(file);
    }
    const bool is_avi = head.starts_with("RIFF") && head.substr(8).starts_with("AVI");
    return is_avi ? extent_of_avi(file, head) : ContainerExtent{};
}

}  // namespace raks::audio
