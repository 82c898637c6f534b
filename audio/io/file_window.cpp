#include "audio/io/file_window.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <limits>
#include <system_error>

#include "base/assert.hpp"

namespace raks::audio {

// The open file; closed with the last window on it.
struct FileWindow::File {
    int descriptor = -1;
    std::int64_t size = 0;  // when it was opened

    File() = default;
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File() {
        if (descriptor >= 0) {
            close(descriptor);
        }
    }
};

namespace {

std::atomic<std::uint64_t>* counted_reads = nullptr;

std::string cannot_open(const std::string& name) {
    return name + ": cannot be opened: " + std::generic_category().message(errno);
}

}  // namespace

void FileWindow::count_reads(std::atomic<std::uint64_t>* count) noexcept { counted_reads = count; }

Expected<FileWindow> FileWindow::adopt(int descriptor, const std::string& name) {
    auto file = std::make_shared<File>();
    file->descriptor = descriptor;
    struct stat status {};
    if (fstat(descriptor, &status) != 0) {
        return fail(cannot_open(name));
    }
    file->size = status.st_size;
    FileWindow window;
    window.end_ = file->size;
    window.file_ = std::move(file);
    return window;
}

Expected<FileWindow> FileWindow::open(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    return descriptor < 0 ? fail(cannot_open(path.string())) : adopt(descriptor, path.string());
}

std::int64_t FileWindow::size() const noexcept {
    const auto head = head_ ? static_cast<std::int64_t>(head_->size()) : 0;
    return head + end_ - begin_;
}

std::size_t FileWindow::read(std::int64_t at, std::span<char> bytes) const {
    const auto head = head_ ? static_cast<std::int64_t>(head_->size()) : 0;
    std::size_t done = 0;
    if (counted_reads != nullptr) {
        counted_reads->fetch_add(1, std::memory_order_relaxed);  // relaxed: orders nothing
    }
    if (at < head) {
        done = std::min(bytes.size(), static_cast<std::size_t>(head - at));
        std::copy_n(head_->data() + at, done, bytes.data());
    }
    while (done < bytes.size()) {
        const std::int64_t place = begin_ + at - head + static_cast<std::int64_t>(done);
        const std::int64_t left = std::max<std::int64_t>(end_ - place, 0);
        const std::size_t wanted = std::min(bytes.size() - done, static_cast<std::size_t>(left));
        const ssize_t got = pread(file_->descriptor, bytes.data() + done, wanted, place);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            break;
        }
        done += static_cast<std::size_t>(got);
    }
    return done;
}

std::string FileWindow::bytes(std::int64_t at, std::size_t count) const {
    const std::int64_t left = std::max<std::int64_t>(size() - at, 0);
    std::string found(std::min(count, static_cast<std::size_t>(left)), '\0');
    found.resize(read(at, found));
    return found;
}

FileWindow FileWindow::part(std::int64_t begin, std::int64_t end) const {
    RAKS_ASSERT(!head_ && 0 <= begin && begin <= end && end <= size());
    FileWindow window = *this;
    window.begin_ = begin_ + begin;
    window.end_ = begin_ + end;
    return window;
}

FileWindow FileWindow::with_head(std::string head, std::int64_t replaced) const {
    RAKS_ASSERT(!head_ && replaced <= size());
    FileWindow window = *this;
    window.head_ = std::make_shared<const std::string>(std::move(head));
    window.begin_ = begin_ + replaced;
    return window;
}

bool FileWindow::has_grown() const {
    struct stat status {};
    return fstat(file_->descriptor, &status) == 0 && status.st_size > file_->size;
}

std::size_t WindowCursor::read(std::span<char> bytes) {
    const std::size_t got = window.read(at, bytes);
    at += static_cast<std::int64_t>(got);
    return got;
}

std::int64_t WindowCursor::seek(std::int64_t offset, int whence) {
    const std::int64_t from = whence == SEEK_SET ? 0 : (whence == SEEK_CUR ? at : window.size());
    // Compared before it is added: a damaged head may ask for any number.
    if (offset < -from || offset > std::numeric_limits<std::int64_t>::max() - from) {
        return -1;
    }
    at = from + offset;
    return at;
}

}  // namespace raks::audio
