#include "motion/skeleton/formats/zip_archive.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/printable.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kEndSize = 22;         // of the record at the archive's end
constexpr std::size_t kMostComment = 65535;  // bytes, after it
constexpr std::size_t kEntrySize = 46;       // of a directory entry, without its name
constexpr std::size_t kLocalSize = 30;       // of the head before a file, without its name
constexpr std::size_t kMostEntries = 10000;
constexpr std::string_view kEndMark = "PK\x05\x06";
constexpr std::string_view kEntryMark = "PK\x01\x02";
constexpr std::string_view kLocalMark = "PK\x03\x04";
constexpr std::size_t kWide = 0xFFFFFFFF;  // stands where the value needs 64 bits
// Numbers that move shrink to a third, those of a body that stands still for hours a thousandfold.
constexpr std::size_t kMostOfMotion = 100;
constexpr std::size_t kSurelySmall = std::size_t{16} << 20U;  // bytes: harmless whatever they are

std::uint32_t field_at(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
        value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8U * i);
    }
    return value;
}

bool is_at(std::string_view archive, std::size_t at, std::string_view mark, std::size_t size) {
    return at <= archive.size() && size <= archive.size() - at &&
           archive.substr(at, mark.size()) == mark;
}

// Where the record at the archive's end begins; a comment may follow it.
std::optional<std::size_t> end_of(std::string_view archive) {
    if (archive.size() < kEndSize) {
        return std::nullopt;
    }
    const std::size_t last = archive.size() - kEndSize;
    for (std::size_t at = last + 1; at-- > last - std::min(last, kMostComment);) {
        if (archive.substr(at, kEndMark.size()) == kEndMark) {
            return at;
        }
    }
    return std::nullopt;
}

// A deflate stream without a head, into exactly `size` bytes.
std::optional<std::string> inflated(std::string_view packed, std::size_t size) {
    z_stream stream{};
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) {
        return std::nullopt;
    }
    std::string out(size, '\0');
    // zlib takes no constant pointer, but does not write there.
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    // Where nothing is to come out zlib still wants a place.
    Bytef nothing = 0;
    stream.next_out = size == 0 ? &nothing : reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(size);
    const int result = inflate(&stream, Z_FINISH);
    const bool is_whole = result == Z_STREAM_END && stream.total_out == size;
    inflateEnd(&stream);
    return is_whole ? std::optional(std::move(out)) : std::nullopt;
}

std::uint32_t checksum_of(std::string_view bytes) {
    return static_cast<std::uint32_t>(crc32_z(
        crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

Expected<std::vector<ZipEntry>> zip_entries(std::string_view archive) {
    const auto end = end_of(archive);
    if (!end) {
        return fail("is a ZIP archive without its end: it is cut off; fetch it again");
    }
    const std::size_t count = field_at(archive, *end + 10, 2);
    if (count > kMostEntries) {
        return fail(fmt::format("packs {} files; at most {} are looked at", count, kMostEntries));
    }
    std::size_t at = field_at(archive, *end + 16, 4);
    std::vector<ZipEntry> entries;
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_at(archive, at, kEntryMark, kEntrySize)) {
            return fail("is a ZIP archive with a damaged directory; fetch it again");
        }
        ZipEntry entry;
        entry.flags = static_cast<std::uint16_t>(field_at(archive, at + 8, 2));
        entry.method = static_cast<std::uint16_t>(field_at(archive, at + 10, 2));
        entry.checksum = field_at(archive, at + 16, 4);
        entry.packed = field_at(archive, at + 20, 4);
        entry.unpacked = field_at(archive, at + 24, 4);
        entry.offset = field_at(archive, at + 42, 4);
        const std::size_t name = field_at(archive, at + 28, 2);
        const std::size_t more = field_at(archive, at + 30, 2) + field_at(archive, at + 32, 2);
        if (name > archive.size() - at - kEntrySize) {
            return fail("is a ZIP archive with a damaged directory; fetch it again");
        }
        if (std::max({entry.packed, entry.unpacked, entry.offset}) == kWide) {
            return fail("packs files of 4 GiB or more");
        }
        entry.name = std::string(archive.substr(at + kEntrySize, name));
        entries.push_back(std::move(entry));
        at += kEntrySize + name + more;
    }
    return entries;
}

Expected<std::string> unzipped(std::string_view archive,
                               const ZipEntry& entry,
                               std::size_t most_bytes) {
    const std::string name = printable(entry.name, 60);
    if ((entry.flags & 1U) != 0) {
        return fail(name + " is encrypted");
    }
    if (entry.method != 0 && entry.method != 8) {
        return fail(fmt::format(
            "{} is packed by the method {}; known are stored and deflated", name, entry.method));
    }
    if (entry.unpacked > most_bytes) {
        return fail(fmt::format(
            "{} unpacks to {} bytes; at most {} are read", name, entry.unpacked, most_bytes));
    }
    if (entry.unpacked > kSurelySmall && entry.unpacked / kMostOfMotion > entry.packed) {
        return fail(fmt::format("{} unpacks from {} bytes to {}, as no motion does",
                                name,
                                entry.packed,
                                entry.unpacked));
    }
    if (!is_at(archive, entry.offset, kLocalMark, kLocalSize)) {
        return fail(name + " is not where the archive says; fetch it again");
    }
    const std::size_t begin = entry.offset + kLocalSize + field_at(archive, entry.offset + 26, 2) +
                              field_at(archive, entry.offset + 28, 2);
    if (begin > archive.size() || entry.packed > archive.size() - begin) {
        return fail(name + " is cut off; fetch it again");
    }
    const std::string_view packed = archive.substr(begin, entry.packed);
    std::optional<std::string> content;
    // Deflate shrinks nothing more than that, so a small file cannot ask for much memory.
    constexpr std::size_t kMostShrinking = 1032;
    if (entry.method == 8 && entry.unpacked / kMostShrinking <= entry.packed) {
        content = inflated(packed, entry.unpacked);
    } else if (entry.packed == entry.unpacked) {
        content = std::string(packed);
    }
    if (!content || checksum_of(*content) != entry.checksum) {
        return fail(name + " is damaged; fetch it again");
    }
    return std::move(*content);
}

}  // namespace raks::motion
