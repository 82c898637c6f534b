// What a model holds packed is unpacked in a process of its own: to the same bytes as here, and
// whatever that process does harms nobody.
#include "render/import/model_unpacker.hpp"

#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/pending_file.hpp"
#include "engine/unpack/unpackers.hpp"
#include "render/import/image_file.hpp"
#include "render/import/png_packer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;
using namespace render;
using namespace std::chrono_literals;

/// Numbers without an order, always the same.
std::vector<std::byte> noise(std::size_t size) {
    std::vector<std::byte> bytes(size);
    std::uint32_t seed = 1;
    for (std::byte& byte : bytes) {
        seed = seed * 1'664'525U + 1'013'904'223U;
        byte = static_cast<std::byte>(seed >> 24U);
    }
    return bytes;
}

/// Something packed, and how.
struct Packed {
    UnpackRequest how;
    std::vector<std::byte> bytes;
};

Packed packed_picture(int width, int height) {
    Image image{.width = width, .height = height, .pixels = {}};
    for (const std::byte byte : noise(static_cast<std::size_t>(width * height) * 4)) {
        image.pixels.push_back(std::to_integer<std::uint8_t>(byte));
    }
    return {.how = {.kind = PackedKind::png,
                    .row_bytes = static_cast<std::uint32_t>(width) * 4,
                    .rows = static_cast<std::uint64_t>(height)},
            .bytes = pack_png(image).value()};
}

Packed packed_vertices(std::size_t count, std::size_t stride, PackedFilter filter) {
    const std::vector<std::byte> vertices = noise(count * stride);
    std::vector<std::byte> packed(meshopt_encodeVertexBufferBound(count, stride));
    packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
                                             packed.size(),
                                             vertices.data(),
                                             count,
                                             stride));
    return {.how = {.kind = PackedKind::vertices,
                    .filter = filter,
                    .row_bytes = static_cast<std::uint32_t>(stride),
                    .rows = count},
            .bytes = std::move(packed)};
}

Packed packed_triangles() {
    const std::vector<unsigned> corners = {0, 1, 2, 2, 1, 3, 4, 6, 5, 7, 8, 9};
    std::vector<std::byte> packed(meshopt_encodeIndexBufferBound(corners.size(), 10));
    packed.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
                                            packed.size(),
                                            corners.data(),
                                            corners.size()));
    return {.how = {.kind = PackedKind::triangles, .row_bytes = 4, .rows = corners.size()},
            .bytes = std::move(packed)};
}

std::vector<std::byte> room_for(const UnpackRequest& how) {
    return std::vector<std::byte>(static_cast<std::size_t>(how.rows * how.row_bytes));
}

class Unpacking : public testing::Test {
 protected:
    ~Unpacking() override { setenv("RAKS_UNPACKER", program_.c_str(), 1); }

    /// Another program takes the place of raks-unpack.
    void replace(const std::string& script) const {
        const fs::path program = folder_ / "unpacker";
        EXPECT_TRUE(write_file(program, "#!/bin/bash\n" + script));
        fs::permissions(program, fs::perms::owner_all);
        setenv("RAKS_UNPACKER", program.c_str(), 1);
    }

    /// What is said of a small picture.
    static std::string message(ModelUnpacker& unpacker) {
        const Packed picture = packed_picture(4, 2);
        std::vector<std::byte> out = room_for(picture.how);
        const auto done = unpacker.unpack(picture.how, picture.bytes, out);
        return done ? "" : done.error().message;
    }
    static std::string message(std::chrono::milliseconds longest = kLongestUnpacking) {
        ModelUnpacker unpacker(longest);
        return message(unpacker);
    }

    const std::string program_ = std::getenv("RAKS_UNPACKER");
    const TemporaryFolder folder_;
};

TEST_F(Unpacking, gives_the_same_bytes_as_in_this_process) {
    ModelUnpacker unpacker;
    const Packed all[] = {packed_picture(1, 1),
                          packed_picture(700, 500),  // more than a socket takes at once
                          packed_vertices(1000, 16, PackedFilter::none),
                          packed_vertices(1000, 8, PackedFilter::octahedral),
                          packed_vertices(1000, 8, PackedFilter::quaternion),
                          packed_vertices(1000, 12, PackedFilter::exponential),
                          packed_triangles()};
    for (const Packed& one : all) {
        std::vector<std::byte> here = room_for(one.how);
        std::vector<std::byte> there = room_for(one.how);
        ASSERT_TRUE(engine::unpack(one.how, one.bytes, here));
        const auto done = unpacker.unpack(one.how, one.bytes, there);
        ASSERT_TRUE(done) << done.error().message;
        EXPECT_EQ(here, there);
    }
}

TEST_F(Unpacking, says_what_is_broken_and_goes_on) {
    ModelUnpacker unpacker;
    Packed picture = packed_picture(64, 64);
    std::vector<std::byte> out = room_for(picture.how);
    picture.bytes.resize(picture.bytes.size() / 2);
    const auto cut = unpacker.unpack(picture.how, picture.bytes, out);
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().message, "cut");
    Packed mesh = packed_vertices(100, 16, PackedFilter::none);
    out = room_for(mesh.how);
    mesh.bytes[0] = std::byte{0};
    const auto mixed_up = unpacker.unpack(mesh.how, mesh.bytes, out);
    ASSERT_FALSE(mixed_up);
    EXPECT_EQ(mixed_up.error().message, "its meshopt data cannot be unpacked");
    EXPECT_EQ(message(unpacker), "");
}

TEST_F(Unpacking, by_one_that_breaks_off_is_one_line_and_the_next_thing_gets_another) {
    ModelUnpacker unpacker;
    replace("exit 3\n");
    EXPECT_EQ(message(unpacker),
              "its reader ended too soon (exit code 3): it is damaged, or too large");
    replace("kill -SEGV $$\n");
    EXPECT_NE(message(unpacker).find("(killed by SIGSEGV)"), std::string::npos);
    setenv("RAKS_UNPACKER", program_.c_str(), 1);
    EXPECT_EQ(message(unpacker), "");
}

TEST_F(Unpacking, by_one_that_says_nonsense_is_one_line) {
    const std::string nonsense = "its reader sent a broken answer and was ended";
    replace("head -c 100000 /dev/urandom >&3\nsleep 100\n");
    EXPECT_EQ(message(), nonsense);
    // Words of 4 GB.
    replace("printf '\\x01\\0AR\\0\\0\\0\\0\\1\\0\\0\\0\\xff\\xff\\xff\\xff' >&3\nsleep 100\n");
    EXPECT_EQ(message(), nonsense);
    // A word that would move the cursor of a terminal.
    replace("printf '\\x01\\0AR\\0\\0\\0\\0\\1\\0\\0\\0\\3\\0\\0\\0a\\x1bb' >&3\nsleep 100\n");
    EXPECT_EQ(message(), "a?b");
}

TEST_F(Unpacking, without_a_cage_is_known) {
    ModelUnpacker unpacker;
    EXPECT_EQ(message(unpacker), "");
    EXPECT_FALSE(unpacker.is_uncaged());
    replace(
        "printf '\\x01\\0AR\\1\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0' >&3\n"
        "head -c 32 /dev/zero >&3\nsleep 100\n");
    ModelUnpacker uncaged;
    EXPECT_EQ(message(uncaged), "");
    EXPECT_TRUE(uncaged.is_uncaged());
}

TEST_F(Unpacking, by_one_that_hangs_is_ended) {
    // It says that all is well and gives one byte of 32.
    replace("printf '\\x01\\0AR\\1\\0\\0\\0\\1\\0\\0\\0\\0\\0\\0\\0a' >&3\nsleep 100\n");
    EXPECT_EQ(message(200ms), "its reader took more than 0.2 s and was ended");
    replace("sleep 100\n");
    ModelUnpacker unpacker(200ms);
    EXPECT_EQ(message(unpacker), "its reader took more than 0.2 s and was ended");
    EXPECT_EQ(message(unpacker), "its reader took more than 0.2 s and was ended");
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // no child of ours is left
}

TEST_F(Unpacking, by_one_that_is_not_there_is_one_line) {
    setenv("RAKS_UNPACKER", "/nowhere/raks-unpack", 1);
    EXPECT_NE(message().find("/nowhere/raks-unpack: is not there"), std::string::npos);
}

}  // namespace
}  // namespace raks::test
