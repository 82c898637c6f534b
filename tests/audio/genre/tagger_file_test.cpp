#include "audio/genre/tagger_file.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "base/file.hpp"
#include "base/hash.hpp"

namespace raks::audio {
namespace {

constexpr const char* kShipped = RAKS_SOURCE_DIR "/models/pretrained/msd_musicnn.tagger";

std::string shipped_bytes() { return read_file(kShipped).value(); }

/// With the hash of what it holds now, so that the fault inside is found and not the hash.
std::string hashed(std::string bytes) {
    bytes.resize(bytes.size() - sizeof(std::uint64_t));
    const std::uint64_t hash = hash_of(bytes);
    bytes.append(reinterpret_cast<const char*>(&hash), sizeof hash);
    return bytes;
}

std::string with(std::string bytes, std::size_t at, const std::string& written) {
    return hashed(bytes.replace(at, written.size(), written));
}

std::string tagger_error(std::string_view bytes) {
    const auto network = parse_tagger(bytes);
    EXPECT_FALSE(network);
    return network ? "" : network.error().message;
}

TEST(TaggerFile, the_shipped_weights_are_read) {
    const auto network = load_tagger(kShipped);
    ASSERT_TRUE(network) << network.error().message;
    EXPECT_FLOAT_EQ((*network)->input_scale, 0.43954009F);
    EXPECT_EQ((*network)->middle[2].weights.size(), 63U * 64U * 7U);
    EXPECT_EQ((*network)->places[0].back(), 63U);
    EXPECT_LE(shipped_bytes().size(), 700'000U);
}

TEST(TaggerFile, faults_are_said_in_one_line) {
    const std::string good = shipped_bytes();
    const std::size_t kernel = good.find("timbre38.kernel");
    EXPECT_EQ(tagger_error(""), "is not the music tagger's weights; install Raks again");
    EXPECT_EQ(tagger_error("raks-tagger\n\1"), "is cut short at its head; install Raks again");
    EXPECT_EQ(tagger_error(with(good, 12, "\2")), "is of version 2, this program reads version 1");
    EXPECT_EQ(tagger_error(with(good, 14, "\5")),
              "says that it has 5 arrays, must be 49; install Raks again");
    EXPECT_EQ(tagger_error(with(good, kernel, "timbre39")),
              "has an array 'timbre39.kernel' where timbre38.kernel must be; install Raks again");
    // Behind the name: kind, number of sizes, sizes.
    const std::size_t kind = kernel + std::strlen("timbre38.kernel");
    EXPECT_EQ(tagger_error(with(good, kind, "d")),
              "timbre38.kernel is neither of halves nor of floats; install Raks again");
    EXPECT_EQ(tagger_error(with(good, kind + 6, "\x27")),
              "timbre38.kernel is 7 x 39 x 23, must be 7 x 38 x 23; install Raks again");
    EXPECT_EQ(tagger_error(with(good, kind + 14, std::string("\0\x7e", 2))),
              "timbre38.kernel[0] is inf, must be a number up to 1e6; install Raks again");
    const std::size_t places = good.find("a.index") + std::strlen("a.index") + 6;
    EXPECT_EQ(tagger_error(with(good, places, std::string("\0\0\x80\x42", 4))),
              "a.index[0] is 64, must be a whole number below 64; install Raks again");
    EXPECT_EQ(tagger_error(with(good, places, std::string("\0\0\x7c\x42", 4))),
              "a.index[1] is 6, must be a place after the one before; install Raks again");
    EXPECT_EQ(tagger_error(hashed(good + "12345678")),
              "goes on after its last array; install Raks again");
    std::string damaged = good;
    damaged[good.size() / 2] = static_cast<char>(damaged[good.size() / 2] ^ 1);
    EXPECT_EQ(tagger_error(damaged),
              "is damaged: the hash at its end is of other bytes; install Raks again");
    EXPECT_EQ(load_tagger("none.tagger").error().message.substr(0, 11), "none.tagger");
}

TEST(TaggerFile, cut_short_anywhere_it_is_refused) {
    const std::string good = shipped_bytes();
    for (std::size_t size = 0; size < good.size(); size += size < 600 ? 1 : 7919) {
        const std::string error = tagger_error(std::string_view(good).substr(0, size));
        EXPECT_EQ(error.find('\n'), std::string::npos) << size;
        EXPECT_NE(error.find("install Raks again"), std::string::npos) << size << ": " << error;
    }
}

}  // namespace
}  // namespace raks::audio
