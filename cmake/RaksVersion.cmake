# raks_note_build(target source.cpp): compiles source.cpp, made from source.cpp.in in this folder, into
# `target`: it says what the program was built from (cmake/RaksCommit.cmake). Made anew after each
# commit, and only then.
function(raks_note_build target source)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${source})
    set(input ${CMAKE_CURRENT_SOURCE_DIR}/${source}.in)
    # Git appends a line to it with each commit and checkout.
    execute_process(
        COMMAND git -C ${PROJECT_SOURCE_DIR} rev-parse --path-format=absolute --git-path logs/HEAD
        OUTPUT_VARIABLE log OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT log OR NOT EXISTS ${log})
        set(log "")
    endif()
    set(script ${PROJECT_SOURCE_DIR}/cmake/RaksCommit.cmake)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DINPUT=${input} -DOUTPUT=${output} -DSOURCE=${PROJECT_SOURCE_DIR}
                -DVERSION=${PROJECT_VERSION}
                "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
                -DBUILD=${CMAKE_BUILD_TYPE} -P ${script}
        # It may be as it was: what it is made from is newer all the same.
        COMMAND ${CMAKE_COMMAND} -E touch ${output}
        DEPENDS ${script} ${input} ${log}
        VERBATIM)
    # A commit compiles nothing else.
    set_source_files_properties(${output} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    target_sources(${target} PRIVATE ${output})
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
endfunction()
