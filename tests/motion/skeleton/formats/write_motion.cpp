// raks_write_motion X.bvh Y: writes a clip in VRM's names (as `raks dance -o X.bvh` writes it) in
// another format, by the ending of Y: .npz or .json (SMPL).
#include <iostream>
#include <string>

#include "base/pending_file.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "tests/motion/skeleton/formats/motion_writers.hpp"

int main(int count, char** words) {
    using namespace raks;
    if (count != 3) {
        std::cerr << "usage: raks_write_motion X.bvh Y.npz|Y.json\n";
        return 2;
    }
    const auto clip = motion::read_skeleton_motion(words[1], {});
    if (!clip) {
        std::cerr << clip.error().message << "\n";
        return 1;
    }
    const std::string output = words[2];
    const auto arrays = raks::test::smpl_arrays(*clip);
    const auto written = write_file(
        output,
        output.ends_with(".json") ? raks::test::json_text(arrays) : raks::test::npz_bytes(arrays));
    if (!written) {
        std::cerr << written.error().message << "\n";
        return 1;
    }
    return 0;
}
