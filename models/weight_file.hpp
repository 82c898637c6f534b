#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "base/packer.hpp"

namespace raks::models {

/// Reads a file of named arrays, the form of the pretrained networks (docs/reference/files.md):
/// the format and a line feed, version and number of arrays (2 bytes each), the arrays, and a hash
/// of all before it (8 bytes, hash_of). Little-endian.
///
///     auto file = WeightReader::open(bytes, "raks-tagger", 1);
///     weights.dense = file->take("dense.kernel", {424, 200});
///     if (auto finished = file->finish(); !finished) { ... }
///
/// The first fault is kept, after which all arrays are zeros. Threads: one. Real-time: no.
class WeightReader {
 public:
    /// Sizes of an array, the last dimension being the one whose numbers are neighbours.
    using Sizes = std::vector<std::size_t>;

    /// Reads the head. `bytes` must outlive this; `what`: what the file holds, for errors. Errors:
    /// another format, another version, cut short.
    [[nodiscard]] static Expected<WeightReader> open(std::string_view bytes,
                                                     std::string_view format,
                                                     int version,
                                                     std::string_view what);

    /// The next array, which must have this name and these sizes, as floats; halves are widened.
    std::vector<float> take(const std::string& name, const Sizes& sizes);
    /// The next array as whole numbers from 0 to `below` - 1.
    std::vector<std::size_t> take_whole(const std::string& name,
                                        std::size_t count,
                                        std::size_t below);
    /// Keeps a fault that the caller found, unless there was one.
    void complain(std::string fault);
    /// Errors: the first fault; bytes or arrays are left; the hash is of other bytes.
    [[nodiscard]] Expected<void> finish() const;

 private:
    WeightReader(std::string_view arrays, int count, bool is_whole)
        : bytes_(arrays), arrays_(count), is_whole_(is_whole) {}
    void fill(const std::string& name, char kind, std::vector<float>& values);

    Unpacker bytes_;
    int arrays_ = 0;         // that the head says are there
    bool is_whole_ = false;  // the hash is of these bytes
    int taken_ = 0;
    std::string fault_;
};

}  // namespace raks::models
