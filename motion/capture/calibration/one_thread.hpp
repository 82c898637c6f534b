// For the sources of this folder: libraries that would start threads of their own.
#pragma once

namespace raks::capture {

/// Lets OpenCV and OpenBLAS work in the caller's thread alone from now on, in the whole process:
/// sums then have one order, whatever the number of cores, and pictures can be worked on side by
/// side. Call it before either of them. Threads: any.
void use_one_thread();

}  // namespace raks::capture
