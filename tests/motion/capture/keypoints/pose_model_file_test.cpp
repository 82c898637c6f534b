// The files of pose networks: only those that are known are taken.
#include "motion/capture/keypoints/pose_model_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/file.hpp"
#include "base/sha256.hpp"

namespace raks::capture {
namespace {

std::string shipped(const std::string& name) {
    const auto bytes = read_file(RAKS_SOURCE_DIR "/models/pretrained/blazepose_" + name + ".pose");
    return bytes ? *bytes : std::string();
}

std::string why_not_known(std::string_view bytes) {
    const auto known = known_pose_network(bytes);
    return known ? std::string(known->name) : known.error().message;
}

TEST(Sha256, is_that_of_the_standard) {
    // FIPS 180-2, appendix B; the lengths around a block's end by sha256sum.
    EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256_of(std::string(1'000'000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(PoseModelFile, the_shipped_ones_are_known) {
    EXPECT_EQ(why_not_known(shipped("detector")), "detector");
    EXPECT_EQ(why_not_known(shipped("full")), "full");
}

TEST(PoseModelFile, another_file_is_one_line) {
    EXPECT_EQ(why_not_known("TFL3"),
              "is not a pose network of Raks (scripts/convert_pose.py makes them)");
    EXPECT_EQ(why_not_known(std::string("raks-pose\n\2\0", 12)),
              "is of version 2, this program reads version 1");
    std::string damaged = shipped("detector");
    const std::string cut = damaged.substr(0, damaged.size() / 2);
    damaged[damaged.size() / 2] ^= 1;
    for (const std::string& bytes : {damaged, cut}) {
        EXPECT_EQ(why_not_known(bytes).substr(0, 62),
                  "is cut off, damaged or of other origin: its SHA-256 begins wit");
    }
}

TEST(PoseModelFile, weights_become_floats_of_onnx) {
    // A graph of no bytes; weights "w" of 2 x 2, of which two are not zero: 1.5 and -2.
    const std::string file("raks-pose\n\1\0\1\0\0\0\0\0\1ws\2\2\0\0\0\2\0\0\0\x9\0\x3e\0\xc0", 35);
    const auto onnx = pose_file_as_onnx(file);
    ASSERT_TRUE(onnx) << onnx.error().message;
    // graph { initializer { dims: 2 dims: 2 data_type: FLOAT name: "w" raw_data: ... } }
    EXPECT_EQ(*onnx,
              std::string("\x3a\x1d\x2a\x1b\x08\x02\x08\x02\x10\x01\x42\x01w\x4a\x10"
                          "\0\0\xc0\x3f\0\0\0\0\0\0\0\0\0\0\0\xc0",
                          31));
    for (std::size_t size = 12; size < file.size(); ++size) {
        const auto cut = pose_file_as_onnx(std::string_view(file).substr(0, size));
        EXPECT_FALSE(cut) << size;
    }
    EXPECT_EQ(pose_file_as_onnx(file + "x").error().message, "goes on after its last array");
}

}  // namespace
}  // namespace raks::capture
