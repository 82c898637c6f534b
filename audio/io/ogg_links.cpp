#include "audio/io/ogg_links.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>

#include "audio/io/head_bytes.hpp"
#include "audio/io/opus_stamps.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kPageHeadBytes = 27;  // of a page, before its table of segments
constexpr std::size_t kMostPageBytes = 27 + 255 + 255 * 255;
constexpr std::size_t kMostLinks = 4096;
constexpr unsigned kIsFirstPage = 2;  // bit of a page's flags: a stream begins
constexpr unsigned kIsLastPage = 4;   // bit of a page's flags: a stream ends
constexpr std::string_view kMark = "OggS";

// CRC-32 of Ogg: polynomial 0x04c11db7, not reflected, from 0.
constexpr std::array<std::uint32_t, 256> kCrc = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t value = i << 24U;
        for (int bit = 0; bit < 8; ++bit) {
            value = (value << 1U) ^ ((value & 0x8000'0000U) != 0 ? 0x04c1'1db7U : 0U);
        }
        table[i] = value;
    }
    return table;
}();

// The check sum of a page, with its own four bytes taken for 0.
std::uint32_t check_sum_of(std::string_view page) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < page.size(); ++i) {
        const bool is_sum = i >= 22 && i < 26;
        const auto byte = is_sum ? 0U : static_cast<unsigned char>(page[i]);
        sum = (sum << 8U) ^ kCrc[(sum >> 24U) ^ byte];
    }
    return sum;
}

// A page at the start of `bytes`.
struct OggPage {
    std::size_t size = 0;  // bytes; may be more than there are
    bool is_first = false;
    bool is_last = false;
    std::int64_t granule = -1;  // -1: no packet ends here
    std::uint32_t stream = 0;
    std::uint32_t number = 0;
    std::string_view segments;  // their lengths, a byte each
    std::string_view body;      // what there is of it
};

std::optional<OggPage> page_at(std::string_view bytes) {
    if (!bytes.starts_with(kMark) || bytes.size() < kPageHeadBytes || bytes[4] != 0) {
        return std::nullopt;
    }
    const auto segments = static_cast<std::size_t>(static_cast<unsigned char>(bytes[26]));
    OggPage page;
    page.size = kPageHeadBytes + segments;
    if (bytes.size() < page.size) {
        return std::nullopt;
    }
    page.segments = bytes.substr(kPageHeadBytes, segments);
    for (const char length : page.segments) {
        page.size += static_cast<unsigned char>(length);
    }
    page.body = bytes.substr(0, page.size).substr(kPageHeadBytes + segments);
    page.is_first = (static_cast<unsigned char>(bytes[5]) & kIsFirstPage) != 0;
    page.is_last = (static_cast<unsigned char>(bytes[5]) & kIsLastPage) != 0;
    page.granule = static_cast<std::int64_t>(number_at(bytes, 6, 8, ByteOrder::little));
    page.stream = static_cast<std::uint32_t>(number_at(bytes, 14, 4, ByteOrder::little));
    page.number = static_cast<std::uint32_t>(number_at(bytes, 18, 4, ByteOrder::little));
    return page;
}

bool is_whole(const OggPage& page, std::string_view bytes) {
    return page.size <= bytes.size() &&
           check_sum_of(bytes.substr(0, page.size)) ==
               static_cast<std::uint32_t>(number_at(bytes, 22, 4, ByteOrder::little));
}

// Sorts pages into links: one begins where first pages follow others.
class LinkSorter {
 public:
    explicit LinkSorter(OggPages& pages) : pages_(pages) {}

    void add(const OggPage& page, std::int64_t at) {
        const bool begins = page.is_first && (pages_.links.empty() || !was_first_);
        if (begins && pages_.links.size() < kMostLinks) {
            pages_.links.push_back({.begin = at, .end = at});
            next_numbers_.clear();
            opus_.clear();
        }
        was_first_ = page.is_first;
        if (pages_.links.empty()) {
            return;  // the file begins within a stream whose head is gone
        }
        OggLink& link = pages_.links.back();
        link.end = at + static_cast<std::int64_t>(page.size);
        const auto next = next_numbers_.find(page.stream);
        link.has_hole =
            link.has_hole || (next != next_numbers_.end() && next->second != page.number);
        next_numbers_[page.stream] = page.number + 1;
        follow_opus(page, link);
    }

    // Bytes that are no page lie between pages.
    void note_damage() {
        if (!pages_.links.empty()) {
            pages_.links.back().has_hole = true;
        }
    }

 private:
    void follow_opus(const OggPage& page, OggLink& link) {
        if (page.is_first && page.body.starts_with("OpusHead")) {
            opus_[page.stream] = {};
        }
        if (const auto stamps = opus_.find(page.stream); stamps != opus_.end()) {
            stamps->second.add({page.granule, page.is_last, page.segments, page.body});
            link.has_loose_stamps = link.has_loose_stamps || !stamps->second.agree();
        }
    }

    OggPages& pages_;
    bool was_first_ = false;
    std::map<std::uint32_t, std::uint32_t> next_numbers_;  // of each stream's pages
    std::map<std::uint32_t, OpusStamps> opus_;             // of the link's Opus streams
};

}  // namespace

OggPages read_ogg_pages(const FileWindow& file) {
    OggPages pages;
    LinkSorter sorter(pages);
    // A piece of the file, read anew when less than a whole page is left of it.
    constexpr std::size_t kPiece = 1 << 20U;
    std::string piece;
    std::int64_t piece_at = 0;
    std::int64_t at = 0;
    std::int64_t lost_from = -1;  // bytes from here on belong to no page
    while (at < file.size()) {
        if (piece_at + static_cast<std::int64_t>(piece.size()) <
                std::min(file.size(), at + static_cast<std::int64_t>(kMostPageBytes)) ||
            piece.empty()) {
            piece = file.bytes(at, kPiece);
            piece_at = at;
            if (piece.empty()) {
                break;
            }
        }
        const std::string_view rest =
            std::string_view(piece).substr(static_cast<std::size_t>(at - piece_at));
        const auto page = page_at(rest);
        if (page && is_whole(*page, rest)) {
            if (lost_from >= 0) {
                sorter.note_damage();
                lost_from = -1;
            }
            sorter.add(*page, at);
            at += static_cast<std::int64_t>(page->size);
            continue;
        }
        lost_from = lost_from < 0 ? at : lost_from;
        const std::size_t next = rest.find(kMark, 1);
        // Without a mark all but the last three bytes, with which one may begin.
        at += static_cast<std::int64_t>(
            next != std::string_view::npos ? next : std::max<std::size_t>(4, rest.size()) - 3);
    }
    // What is left behind the last whole page: a page that was cut off.
    pages.is_cut = lost_from >= 0 && file.bytes(lost_from, 4).starts_with("Ogg");
    return pages;
}

}  // namespace raks::audio
