#include "base/file.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

namespace raks {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, CloseFile>;

std::string reason(int error_number) { return std::generic_category().message(error_number); }

}  // namespace

Expected<std::string> read_file(const fs::path& path, std::size_t max_bytes) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
        return fail(path.string() + ": is a folder, not a file");
    }
    const FileHandle file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        return fail(path.string() + ": cannot be opened: " + reason(errno));
    }
    std::string bytes;
    char chunk[1U << 16U];
    for (;;) {
        const std::size_t got = std::fread(chunk, 1, sizeof chunk, file.get());
        if (bytes.size() + got > max_bytes) {
            return fail(path.string() + ": is larger than " + std::to_string(max_bytes >> 20U) +
                        " MiB, the limit for this kind of file");
        }
        bytes.append(chunk, got);
        if (got < sizeof chunk) {
            break;
        }
    }
    if (std::ferror(file.get()) != 0) {
        return fail(path.string() + ": cannot be read: " + reason(errno));
    }
    return bytes;
}

PendingFile::PendingFile(fs::path path, fs::path part)
    : path_(std::move(path)), part_(std::move(part)) {}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : path_(std::move(other.path_)), part_(std::exchange(other.part_, {})) {}

PendingFile& PendingFile::operator=(PendingFile&& other) noexcept {
    if (this != &other) {
        remove_part();
        path_ = std::move(other.path_);
        part_ = std::exchange(other.part_, {});
    }
    return *this;
}

PendingFile::~PendingFile() { remove_part(); }

void PendingFile::remove_part() noexcept {
    if (!part_.empty()) {
        std::error_code ignored;
        fs::remove_all(part_, ignored);
        part_.clear();
    }
}

Expected<PendingFile> PendingFile::create(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
        return fail(path.string() + ": is a folder; name a file to write");
    }
    fs::path part = path;
    part += ".part";
    const FileHandle probe(std::fopen(part.c_str(), "wb"));
    if (!probe) {
        return fail(path.string() + ": cannot be written: " + reason(errno));
    }
    return PendingFile(path, std::move(part));
}

Expected<void> PendingFile::commit() {
    std::error_code error;
    fs::rename(part_, path_, error);
    if (error) {
        return fail(path_.string() + ": cannot be written: " + error.message());
    }
    part_.clear();
    return {};
}

Expected<void> write_file(const fs::path& path, std::string_view bytes) {
    auto pending = PendingFile::create(path);
    if (!pending) {
        return fail(pending.error());
    }
    FileHandle file(std::fopen(pending->part().c_str(), "wb"));
    const bool wrote = file &&
                       std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
                       std::fflush(file.get()) == 0;
    if (!wrote) {
        return fail(path.string() + ": cannot be written: " + reason(errno));
    }
    file.reset();
    return pending->commit();
}

}  // namespace raks
