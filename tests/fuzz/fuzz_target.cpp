// libFuzzer's entries for one reader, RAKS_FUZZ_READER (its name): see scripts/fuzz.sh.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "tests/fuzz/readers.hpp"

namespace {

const raks::fuzz::Reader& reader() {
    static const raks::fuzz::Reader* const found = raks::fuzz::reader_named(RAKS_FUZZ_READER);
    if (found == nullptr) {
        std::abort();
    }
    return *found;
}

}  // namespace

extern "C" {

std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t longest);

// The library's, not ours: see tests/support/main.cpp.
const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() { return "leak:libvorbis\n"; }

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static_cast<void>(reader().read({reinterpret_cast<const char*>(data), size}));
    return 0;
}

// Three of four inputs keep their structure; the others are changed as libFuzzer likes.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data,
                                    std::size_t size,
                                    std::size_t longest,
                                    unsigned int seed) {
    if (seed % 4 == 0 || size == 0) {
        return LLVMFuzzerMutate(data, size, longest);
    }
    const std::string text =
        raks::fuzz::damaged(reader(), {reinterpret_cast<const char*>(data), size}, seed);
    const std::size_t kept = std::min(text.size(), longest);
    std::memcpy(data, text.data(), kept);
    return kept;
}

}  // extern "C"
