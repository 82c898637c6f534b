// libFuzzer's entries for one reader, RAKS_FUZZ_READER (its name): see scripts/fuzz.sh.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "tests/fuzz/mutation.hpp"
#include "tests/fuzz/readers.hpp"

extern "C" {

std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t longest);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const raks::fuzz::Reader* const reader = raks::fuzz::reader_named(RAKS_FUZZ_READER);
    if (reader == nullptr) {
        std::abort();
    }
    static_cast<void>(reader->read({reinterpret_cast<const char*>(data), size}));
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
    const std::string text = raks::fuzz::mutated({reinterpret_cast<const char*>(data), size}, seed);
    const std::size_t kept = std::min(text.size(), longest);
    std::memcpy(data, text.data(), kept);
    return kept;
}

}  // extern "C"
