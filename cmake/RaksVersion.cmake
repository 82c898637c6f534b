# raks_note_build(target): the sources of `target` may include "raks_build.hpp", which says what the
# program was built from (cmake/RaksCommit.cmake). Written anew after each commit, and only then.
function(raks_note_build target)
    set(header ${CMAKE_CURRENT_BINARY_DIR}/build/raks_build.hpp)
    # Git appends a line to it with each commit and checkout.
    execute_process(
        COMMAND git -C ${PROJECT_SOURCE_DIR} rev-parse --path-format=absolute --git-path logs/HEAD
        OUTPUT_VARIABLE log OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT log OR NOT EXISTS ${log})
        set(log "")
    endif()
    set(write ${CMAKE_COMMAND} -DOUTPUT=${header} -DSOURCE=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
        "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" -DBUILD=${CMAKE_BUILD_TYPE}
        -P ${PROJECT_SOURCE_DIR}/cmake/RaksCommit.cmake)
    if(NOT EXISTS ${header})
        execute_process(COMMAND ${write})  # for clang-tidy, which looks at what was not built
    endif()
    add_custom_command(
        OUTPUT ${header}
        COMMAND ${write}
        # The header may be as it was: what it is made from is newer all the same.
        COMMAND ${CMAKE_COMMAND} -E touch ${header}
        DEPENDS ${PROJECT_SOURCE_DIR}/cmake/RaksCommit.cmake ${log}
        VERBATIM)
    target_sources(${target} PRIVATE ${header})
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/build)
endfunction()
