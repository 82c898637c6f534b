# Compiler settings shared by every target of ours: C++20, warnings, sanitizers.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

option(RAKS_TESTS "Build the tests" ON)
option(RAKS_WERROR "Warnings are errors" OFF)
option(RAKS_UNITY "Compile several sources as one" OFF)
option(RAKS_PRECOMPILE "Compile the headers that all sources include once" OFF)
option(RAKS_FUZZ "Build the fuzzers (clang)" OFF)
option(RAKS_TRAIN "Build what learns from music and motion (FluidSynth, OpenBLAS)" ON)
option(RAKS_CAPTURE "Build what calibrates cameras (OpenCV, Ceres)" ON)
option(RAKS_IMPORT "Build what reads FBX, Collada, OBJ and Draco (assimp, draco)" ON)
option(RAKS_COVERAGE "Instrument for gcov" OFF)
set(RAKS_SANITIZE "" CACHE STRING "Value of -fsanitize=, empty for none")

# -O1 in Debug: the tests of signal code are too slow without it. No -g in Release: half the
# compile time. No -ffast-math anywhere: bits must repeat and NaN must be seen.
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1")
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
# What users get is hardened as Debian's own programs are; hardening-check (devscripts) says so.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT RAKS_SANITIZE)
    include(CheckPIESupported)
    check_pie_supported()
    string(APPEND CMAKE_CXX_FLAGS_RELEASE
        " -fstack-protector-strong -fstack-clash-protection -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2")
    add_link_options(-Wl,-z,relro -Wl,-z,now)
    # Where it was built is nobody's business, and the same source gives the same bytes everywhere.
    add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
endif()

# Tests call what takes the time. Compiled with -O1 they take half as long again as with -O0, in Release
# and under the address sanitizer; those that compute themselves say so (COMPUTES) and keep -O1 in Release.
set(RAKS_OPTIMIZATION_OF_tests -O1)
set(RAKS_OPTIMIZATION_OF_computing_tests -O1)
if(RAKS_SANITIZE MATCHES "address")
    set(RAKS_OPTIMIZATION_OF_tests -O0)
    set(RAKS_OPTIMIZATION_OF_computing_tests -O0)
elseif(CMAKE_BUILD_TYPE STREQUAL "Release")
    set(RAKS_OPTIMIZATION_OF_tests -O0 -U_FORTIFY_SOURCE)
endif()

add_library(raks_options INTERFACE)
target_compile_options(raks_options INTERFACE -ffp-contract=off)
target_compile_definitions(raks_options INTERFACE $<$<CONFIG:Debug>:RAKS_ASSERTS=1>)
if(RAKS_SANITIZE)
    target_compile_definitions(raks_options INTERFACE RAKS_SANITIZED=1)
    target_compile_options(raks_options INTERFACE -fsanitize=${RAKS_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(raks_options INTERFACE -fsanitize=${RAKS_SANITIZE})
    if(RAKS_SANITIZE MATCHES "undefined")
        target_compile_options(raks_options INTERFACE -fno-sanitize-recover=undefined)
    endif()
endif()
if(RAKS_FUZZ)
    # Coverage of edges for libFuzzer, whose main only the fuzzers link (tests/fuzz).
    target_compile_options(raks_options INTERFACE -fsanitize=fuzzer-no-link)
    target_link_options(raks_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(RAKS_COVERAGE)
    target_compile_options(raks_options INTERFACE --coverage)
    target_link_options(raks_options INTERFACE --coverage)
endif()

# GCC 12 finds faults in std::string where it inlines it from a precompiled header (its bug 105329).
set(RAKS_FALSE_WARNINGS "")
if(RAKS_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(RAKS_FALSE_WARNINGS
        -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
endif()

# GCC frees memory at 128 MB and goes through all that it holds for it, which most units reach several times.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=500000>)
endif()

add_library(raks_warnings INTERFACE)
target_compile_options(raks_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
    -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wdouble-promotion -Wformat=2
    ${RAKS_FALSE_WARNINGS}
    $<$<BOOL:${RAKS_WERROR}>:-Werror>)
# What RAKS_NONBLOCKING promises, when it is compiled; the sanitizer looks when it runs.
if(RAKS_SANITIZE STREQUAL "realtime")
    target_compile_options(raks_warnings INTERFACE -Werror=function-effects)
endif()

# A third less work for a whole build, more for one changed file.
if(RAKS_UNITY)
    set(CMAKE_UNITY_BUILD ON)
    set(CMAKE_UNITY_BUILD_BATCH_SIZE 20)
    # A class of one file may hold a type that the same file keeps to itself.
    add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
endif()

# Looked for once: a folder that was compiled without it is not compiled anew when it comes.
if(NOT DEFINED RAKS_CCACHE)
    find_program(RAKS_CCACHE ccache)
    if(NOT RAKS_CCACHE)
        set(RAKS_CCACHE "" CACHE FILEPATH "compiler cache; empty: none" FORCE)
    endif()
endif()
if(RAKS_CCACHE)
    # Sources with a precompiled header are kept, too; no source of ours asks for the date.
    set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${RAKS_CCACHE})
    set(CMAKE_C_COMPILER_LAUNCHER ${RAKS_CCACHE})
endif()
find_program(RAKS_MOLD mold)
if(RAKS_MOLD)
    add_link_options(-fuse-ld=mold)
endif()

find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)

# Everything is compiled with the definitions of fmt and of threads, as a precompiled header serves only sources with the
# same definitions.
find_package(fmt REQUIRED)
target_link_libraries(raks_options INTERFACE fmt::fmt)
target_compile_options(raks_options INTERFACE -pthread)
if(RAKS_PRECOMPILE)
    # Three sets of flags: libraries, and programs (-fPIE), which are the tests and those that compute.
    add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
    add_library(raks_precompiled STATIC cmake/precompiled.cpp)
    target_include_directories(raks_precompiled PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(raks_precompiled PRIVATE raks_options raks_warnings)
    target_precompile_headers(raks_precompiled PRIVATE cmake/precompiled.hpp)
endif()
