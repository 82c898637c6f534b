// ZIP archive: the files packed in one, stored or deflated, as NumPy's savez writes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::motion {

/// One packed file.
struct ZipEntry {
    std::string name;
    std::uint16_t method = 0;    ///< 0: stored, 8: deflated
    std::uint16_t flags = 0;     ///< bit 0: encrypted
    std::uint32_t checksum = 0;  ///< CRC-32 of its content
    std::size_t packed = 0;      ///< bytes in the archive
    std::size_t unpacked = 0;    ///< bytes, as declared
    std::size_t offset = 0;      ///< of its local head
};

/// What the archive's directory lists (APPNOTE 4.3.12), at most 10,000 files. Errors, without a
/// file's name: cut off, damaged, in several parts, with sizes of 4 GiB and more.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<std::vector<ZipEntry>> zip_entries(std::string_view archive);

/// The content of one of them. Memory: at most `most_bytes`, whatever is declared or packed.
/// Errors, without a file's name: larger than that, large and packed a hundredfold (a bomb),
/// damaged, packed in another way, encrypted.
[[nodiscard]] Expected<std::string> unzipped(std::string_view archive,
                                             const ZipEntry& entry,
                                             std::size_t most_bytes);

}  // namespace raks::motion
