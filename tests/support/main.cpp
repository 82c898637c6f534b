#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/shared_caches.hpp"
#include "tests/support/temporary_folder.hpp"

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    // A test never reads or writes what the user of this machine has.
    const raks::test::TemporaryFolder home;
    setenv("XDG_CONFIG_HOME", (home.path() / "config").c_str(), 1);
    setenv("XDG_CACHE_HOME", (home.path() / "cache").c_str(), 1);
    raks::test::share_solved_dances(home.path() / "cache",
                                    std::filesystem::path(argv[0]).filename().string());
    setenv("XDG_STATE_HOME", (home.path() / "state").c_str(), 1);
    setenv("XDG_DATA_HOME", (home.path() / "share").c_str(), 1);
    // What Mesa compiled: a quarter of what a small picture costs.
    setenv("MESA_SHADER_CACHE_DIR", raks::test::shared_folder("shaders").c_str(), 1);
    // They do not lie beside the programs of the tests.
    setenv("RAKS_DECODER", RAKS_DECODE_PROGRAM, 1);
    setenv("RAKS_UNPACKER", RAKS_UNPACK_PROGRAM, 1);
    setenv("RAKS_SOUNDFONT", RAKS_SOUNDFONT_PROGRAM, 1);
    setenv("RAKS_IMPORTER", RAKS_IMPORT_PROGRAM, 1);
    setenv("RAKS_CODEC_MODULE", RAKS_CODEC_MODULE, 1);
    setenv("RAKS_FILM_MODULE", RAKS_FILM_MODULE, 1);
    return RUN_ALL_TESTS();
}

#ifdef __SANITIZE_ADDRESS__
extern "C" const char* __lsan_default_suppressions();
// The library leaks, not our reader: libsndfile 1.2.0 alone, given an Ogg Vorbis file cut at 244
// places of its first 9000 bytes, refused 109 of them, and 107 of those refusals left what
// vorbis_info_init had allocated (5.8 kB each). sf_open returns null then, so there is nothing to
// close. The 135 that it opened, closed by sf_close, left nothing. The tests with mangled files
// open hundreds.
extern "C" const char* __lsan_default_suppressions() { return "leak:libvorbis\n"; }
#endif
