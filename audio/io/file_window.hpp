#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "base/expected.hpp"

namespace raks::audio {

/// The bytes of a file as they were when it was opened, or a part of them: what a recorder appends
/// later is not seen. The first bytes may be replaced by others, so that a decoder finds a head
/// without faults. Copies share the open file.
/// Threads: any number, each with its own copy. Real-time: no.
class FileWindow {
 public:
    /// The whole file. Errors: it cannot be opened.
    [[nodiscard]] static Expected<FileWindow> open(const std::filesystem::path& path);

    /// The whole of an open file, whose descriptor it closes at the end. Errors: the system's.
    [[nodiscard]] static Expected<FileWindow> adopt(int descriptor, const std::string& name);
    /// From here on each read of any window adds one to `count`: whoever waits for a decoder sees
    /// that it goes on. Called before the first read; `count` stays until the program ends.
    static void count_reads(std::atomic<std::uint64_t>* count) noexcept;

    /// Number of bytes.
    [[nodiscard]] std::int64_t size() const noexcept;
    /// Copies bytes from position `at` (>= 0) on; returns how many: fewer only at the end, or where
    /// the file cannot be read.
    std::size_t read(std::int64_t at, std::span<char> bytes) const;
    /// The bytes at `at`, at most `count`: fewer at the end only.
    [[nodiscard]] std::string bytes(std::int64_t at, std::size_t count) const;

    /// The bytes [begin, end) of this window, which must lie within it.
    [[nodiscard]] FileWindow part(std::int64_t begin, std::int64_t end) const;
    /// This window with `head` in place of its first `replaced` bytes.
    [[nodiscard]] FileWindow with_head(std::string head, std::int64_t replaced) const;

    /// Has the file become longer since it was opened?
    [[nodiscard]] bool has_grown() const;

 private:
    struct File;
    std::shared_ptr<const File> file_;
    std::shared_ptr<const std::string> head_;  // before the file's bytes; may be null
    std::int64_t begin_ = 0;                   // of the file's bytes behind the head
    std::int64_t end_ = 0;
};

/// A window read from front to back with seeks, as decoders want it. Threads: one.
struct WindowCursor {
    FileWindow window;
    std::int64_t at = 0;  ///< position of the next byte, >= 0; behind the end nothing is read

    /// Reads and moves on; returns how many bytes.
    std::size_t read(std::span<char> bytes);
    /// Moves to `offset` bytes behind `whence` (SEEK_SET, SEEK_CUR, SEEK_END); returns the new
    /// position. A position before the start is an error, -1.
    std::int64_t seek(std::int64_t offset, int whence);
};

}  // namespace raks::audio
