# Writes the source OUTPUT from INPUT, which says what the program was built from: version, commit,
# compiler, kind of build. Run as a script, anew after each commit:
#   cmake -DINPUT=FILE.in -DOUTPUT=FILE -DSOURCE=FOLDER -DVERSION=0.1.0 -DCOMPILER=... -DBUILD=Release -P RaksCommit.cmake
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
configure_file("${INPUT}" "${OUTPUT}" @ONLY)
