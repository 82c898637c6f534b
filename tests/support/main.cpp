#include <gtest/gtest.h>

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}

#ifdef __SANITIZE_ADDRESS__
extern "C" const char* __lsan_default_suppressions();
// libsndfile 1.2.0 does not give back what libvorbis allocated when an Ogg file breaks
// off in its headers; the tests with mangled files open hundreds of them.
extern "C" const char* __lsan_default_suppressions() { return "leak:libvorbis\n"; }
#endif
