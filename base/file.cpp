#include "base/file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

namespace raks {
namespace {

namespace fs = std::filesystem;

// Closes on every way out of a function.
struct CloseFile {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, CloseFile>;

// The system's words for an errno.
std::string reason(int error_number) { return std::generic_category().message(error_number); }

/// Opens an existing plain file without ever blocking: checks its type first (a pipe without a
/// writer would block) and opens it with O_NONBLOCK (files of the kernel such as /proc/kmsg would).
Expected<FileHandle> open_plain(const fs::path& path) {
    if (path.empty()) {
        return fail("a file name is empty; name a file");
    }
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status)) {
        return fail(path.string() + ": is a folder, not a file");
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        return fail(path.string() + ": is not a plain file; copy what it holds into one");
    }
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    FileHandle file(descriptor >= 0 ? ::fdopen(descriptor, "rb") : nullptr);
    if (!file) {
        const int error_number = errno;
        if (descriptor >= 0) {
            ::close(descriptor);
        }
        return fail(path.string() + ": cannot be opened: " + reason(error_number));
    }
    return file;
}

}  // namespace

bool is_there(const std::filesystem::path& path) noexcept {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

Expected<std::string> read_file(const fs::path& path, std::size_t max_bytes) {
    const auto file = open_plain(path);
    if (!file) {
        return fail(file.error());
    }
    std::error_code ignored;
    // The size is only a hint for the allocation: files of the kernel report 0.
    std::string bytes;
    if (const auto size = fs::file_size(path, ignored); !ignored && size <= max_bytes) {
        bytes.reserve(size);
    }
    // Read in chunks, so that the limit holds even for a file that grows.
    char chunk[1U << 16U];
    for (;;) {
        const std::size_t got = std::fread(chunk, 1, sizeof chunk, file->get());
        if (bytes.size() + got > max_bytes) {
            return fail(path.string() + ": is larger than " + std::to_string(max_bytes >> 20U) +
                        " MiB, the limit for this kind of file");
        }
        bytes.append(chunk, got);
        // A short read is the end of the file, or an error.
        if (got < sizeof chunk) {
            break;
        }
    }
    if (std::ferror(file->get()) != 0) {
        return fail(path.string() + ": cannot be read: " + reason(errno));
    }
    return bytes;
}

Expected<std::string> read_file_start(const fs::path& path, std::size_t count) {
    const auto file = open_plain(path);
    if (!file) {
        return fail(file.error());
    }
    std::string bytes(count, '\0');
    bytes.resize(std::fread(bytes.data(), 1, count, file->get()));
    if (std::ferror(file->get()) != 0) {
        return fail(path.string() + ": cannot be read: " + reason(errno));
    }
    return bytes;
}

fs::path temporary_folder() {
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    return error ? fs::path("/tmp") : folder;
}

Expected<std::vector<fs::path>> list_folder(const fs::path& folder, ListingDepth depth) {
    std::vector<fs::path> paths;
    std::error_code error;
    const auto list = [&](auto iterator) {
        // A loop that serves both kinds of iterators.
        for (; !error && iterator != end(iterator); iterator.increment(error)) {
            paths.push_back(iterator->path());
        }
    };
    if (depth == ListingDepth::tree) {
        list(fs::recursive_directory_iterator(folder, error));
    } else {
        list(fs::directory_iterator(folder, error));
    }
    if (error) {
        return fail(folder.string() + ": cannot be listed: " + error.message());
    }
    // The system's order is arbitrary.
    std::sort(paths.begin(), paths.end());
    return paths;
}

namespace {

/// Turns "\r\n" and "\r" into "\n", in place: a "\r" before "\n" is dropped, a lone one replaced.
void unify_line_ends(std::string& text) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (!is_pair) {
            text[kept++] = text[i] == '\r' ? '\n' : text[i];
        }
    }
    text.resize(kept);
}

}  // namespace

Expected<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes) {
    constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";
    auto text = read_file(path, max_bytes);
    if (!text) {
        return text;
    }
    // Before the zero byte, which UTF-16 also has, because this message helps more.
    if (text->starts_with("\xff\xfe") || text->starts_with("\xfe\xff")) {
        return fail(path.string() + ": is UTF-16 text; save it as UTF-8");
    }
    if (const std::size_t zero = text->find('\0'); zero != std::string::npos) {
        const auto line =
            1 + std::count(text->begin(), text->begin() + static_cast<std::ptrdiff_t>(zero), '\n');
        return fail(path.string() + ": line " + std::to_string(line) +
                    ": holds a zero byte: it is damaged, or no UTF-8 text");
    }
    if (text->starts_with(kUtf8Mark)) {
        text->erase(0, kUtf8Mark.size());
    }
    unify_line_ends(*text);
    return text;
}

}  // namespace raks
