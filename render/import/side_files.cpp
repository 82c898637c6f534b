#include "render/import/side_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include "base/descriptor.hpp"
#include "base/printable.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kLongestUri = 1024;  // bytes; longer paths are no names that people give
constexpr std::string_view kDataScheme = "data:";

int hex_digit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const int letter = std::tolower(static_cast<unsigned char>(c));
    return letter >= 'a' && letter <= 'f' ? letter - 'a' + 10 : -1;
}

/// "%20" as ' '. None: a '%' without two digits.
std::optional<std::string> percent_decoded(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            text += uri[i];
            continue;
        }
        if (i + 2 >= uri.size() || hex_digit(uri[i + 1]) < 0 || hex_digit(uri[i + 2]) < 0) {
            return std::nullopt;
        }
        text += static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2]));
        i += 2;
    }
    return text;
}

bool has_scheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string_view::npos && uri.find('/') > colon;
}

/// Opens name after name, following no link.
Expected<int> open_below(const std::filesystem::path& folder,
                         const std::vector<std::string>& names) {
    const std::filesystem::path start = folder.empty() ? "." : folder;
    Descriptor here(::open(start.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    for (std::size_t i = 0; i < names.size() && here.number >= 0; ++i) {
        const bool is_last = i + 1 == names.size();
        // O_NONBLOCK: a pipe without a writer must not keep the program waiting.
        const int flags = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | (is_last ? O_NONBLOCK : O_DIRECTORY);
        const int next = ::openat(here.number, names[i].c_str(), flags);
        here.close();
        here.number = next;
    }
    if (here.number < 0) {
        return fail(
            errno == ELOOP
                ? std::string(
                      "is a symbolic link, which is not followed; put the file itself there")
                : fmt::format("cannot be opened: {}", std::generic_category().message(errno)));
    }
    return here.release();
}

Expected<std::vector<std::byte>> read_all(int file, std::size_t max_bytes) {
    struct stat status {};
    if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) {
        return fail("is not a plain file");
    }
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size > max_bytes) {
        return fail(fmt::format("has {} bytes, more than {}", size, max_bytes));
    }
    std::vector<std::byte> bytes(size);
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = ::read(file, bytes.data() + done, size - done);
        if (got <= 0) {
            return fail("cannot be read whole");
        }
        done += static_cast<std::size_t>(got);
    }
    return bytes;
}

/// The value of a base64 digit, 64 where it is none.
constexpr std::array<std::uint8_t, 256> kBase64 = [] {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<std::uint8_t, 256> values{};
    values.fill(64);
    for (std::size_t i = 0; i < kDigits.size(); ++i) {
        values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::uint8_t>(i);
    }
    return values;
}();

Expected<std::vector<std::byte>> base64_decoded(std::string_view text) {
    while (!text.empty() && text.back() == '=') {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) {
        return fail("has base64 that is cut off");
    }
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const std::uint8_t value = kBase64[static_cast<unsigned char>(c)];
        if (value == 64) {
            return fail("is not base64");
        }
        bits = (bits << 6U) | value;
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes.push_back(static_cast<std::byte>((bits >> static_cast<unsigned>(held)) & 0xFFU));
        }
    }
    return bytes;
}

}  // namespace

Expected<std::vector<std::string>> side_path(std::string_view uri) {
    if (uri.empty()) {
        return fail("does not name a file");
    }
    if (uri.size() > kLongestUri) {
        return fail(fmt::format("has a name that is too long ({} bytes)", uri.size()));
    }
    if (has_scheme(uri)) {
        return fail(fmt::format("\"{}\" is not a file beside the model", printable(uri, 80)));
    }
    const auto path = percent_decoded(uri);
    const bool is_odd =
        !path || path->front() == '/' || std::any_of(path->begin(), path->end(), [](char c) {
            return c == '\\' || static_cast<unsigned char>(c) < 0x20;
        });
    if (is_odd) {
        return fail(
            fmt::format("\"{}\" is not a plain path from the model's folder", printable(uri, 80)));
    }
    std::vector<std::string> names;
    for (std::size_t at = 0; at <= path->size();) {
        const std::size_t slash = std::min(path->find('/', at), path->size());
        names.push_back(path->substr(at, slash - at));
        at = slash + 1;
        if (names.back().empty() || names.back() == "..") {
            return fail(fmt::format("\"{}\" leads out of the model's folder", printable(uri, 80)));
        }
        if (names.back().front() == '.' && names.back() != ".") {
            return fail(
                fmt::format("\"{}\" is a hidden file, which is not read", printable(uri, 80)));
        }
    }
    return names;
}

Expected<std::vector<std::byte>> SideFiles::read(std::string_view uri,
                                                 std::size_t max_bytes) const {
    const auto names = side_path(uri);
    if (!names) {
        return fail(names.error());
    }
    const std::string shown = printable(uri, 80);
    if (!is_open_) {
        return fail(fmt::format("\"{}\" lies beside the model, which has no folder", shown));
    }
    const auto file = open_below(folder_, *names);
    if (!file) {
        return fail(fmt::format("\"{}\" {}", shown, file.error().message));
    }
    const Descriptor descriptor(*file);
    auto bytes = read_all(descriptor.number, max_bytes);
    if (!bytes) {
        return fail(fmt::format("\"{}\" {}", shown, bytes.error().message));
    }
    return bytes;
}

bool is_data_uri(std::string_view uri) noexcept {
    return uri.substr(0, kDataScheme.size()) == kDataScheme;
}

Expected<std::vector<std::byte>> read_data_uri(std::string_view uri, std::size_t max_bytes) {
    const std::size_t comma = uri.find(',');
    if (!is_data_uri(uri) || comma == std::string_view::npos) {
        return fail("is a data URI without a comma");
    }
    std::string_view type = uri.substr(kDataScheme.size(), comma - kDataScheme.size());
    constexpr std::string_view kCoding = ";base64";
    if (type.size() < kCoding.size() || type.substr(type.size() - kCoding.size()) != kCoding) {
        return fail("is a data URI that is not base64");
    }
    type.remove_suffix(kCoding.size());
    if (type != "application/octet-stream" && type != "application/gltf-buffer" &&
        type.substr(0, 6) != "image/") {
        return fail(
            fmt::format("is a data URI of type \"{}\", which is not read", printable(type, 80)));
    }
    if ((uri.size() - comma) / 4 * 3 > max_bytes) {
        return fail(fmt::format("is a data URI of more than {} bytes", max_bytes));
    }
    return base64_decoded(uri.substr(comma + 1));
}

}  // namespace raks::render
