#include "motion/capture/calibration/one_thread.hpp"

#include <dlfcn.h>

#include <opencv2/core.hpp>

namespace raks::capture {

void use_one_thread() {
    static const bool is_set = [] {
        cv::setNumThreads(1);
        // OpenCV solves by LAPACK, which may be any; only OpenBLAS splits sums over threads.
        using SetThreads = void (*)(int);
        const auto set_threads =
            reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
        if (set_threads != nullptr) {
            set_threads(1);
        }
        return true;
    }();
    static_cast<void>(is_set);
}

}  // namespace raks::capture
