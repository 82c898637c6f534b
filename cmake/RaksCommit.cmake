# Writes the header OUTPUT, which says what the program was built from: version, commit, compiler, kind
# of build. Run as a script, anew after each commit:
#   cmake -DOUTPUT=FILE -DSOURCE=FOLDER -DVERSION=0.1.0 -DCOMPILER=... -DBUILD=Release -P RaksCommit.cmake
# A source tree without git names its commit by RAKS_COMMIT in the environment, or not at all.
set(commit "$ENV{RAKS_COMMIT}")
if(NOT commit)
    execute_process(
        COMMAND git -C "${SOURCE}" rev-parse --short=12 HEAD
        OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE fault)
    if(fault)
        set(commit "unknown")
    endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[
#pragma once

namespace raks {

inline constexpr const char* kVersion = "@VERSION@";
inline constexpr const char* kCommit = "@commit@";
inline constexpr const char* kCompiler = "@COMPILER@, @BUILD@";

}  // namespace raks
]])
