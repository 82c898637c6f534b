# raks_library(audio_beat SOURCES a.cpp ... [PUBLIC targets] [PRIVATE targets])
# makes the static library raks_audio_beat and its alias raks::audio_beat. A room without
# sources is an interface library. Headers are included by full path from the root.
function(raks_library name)
    cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
    set(target raks_${name})
    if(arg_SOURCES)
        add_library(${target} STATIC ${arg_SOURCES})
        target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
        target_link_libraries(${target} PUBLIC raks_options ${arg_PUBLIC}
                                        PRIVATE raks_warnings ${arg_PRIVATE})
        if(RAKS_PRECOMPILE)
            target_precompile_headers(${target} REUSE_FROM raks_precompiled)
        endif()
    else()
        add_library(${target} INTERFACE)
        target_include_directories(${target} INTERFACE ${PROJECT_SOURCE_DIR})
        target_link_libraries(${target} INTERFACE raks_options ${arg_PUBLIC})
    endif()
    add_library(raks::${name} ALIAS ${target})
endfunction()

# raks_add_to(audio_analyzer SOURCES a.cpp ... [PUBLIC targets] [PRIVATE targets])
# adds the sources of a sub-room to the library of its room, whose folder comes first.
function(raks_add_to name)
    cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
    target_sources(raks_${name} PRIVATE ${arg_SOURCES})
    target_link_libraries(raks_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
endfunction()

# raks_vectorized(audio_analyzer a.cpp ...)
# compiles these sources of a library with -O3, without contraction, so that all clones of a loop give
# the same bits, and without errno after a square root, which no register of several could set.
function(raks_vectorized name)
    # GCC 12 breaks down over clones of functions behind a header that was compiled with other options.
    set_source_files_properties(${ARGN} TARGET_DIRECTORY raks_${name}
        PROPERTIES COMPILE_OPTIONS "-O3;-ffp-contract=off;-fno-math-errno" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# raks_compile_quickly(render_import)
# compiles a library with -O1 in Release: for what is read, written or drawn once and not in every hop,
# where a fifth of the compile time counts more.
function(raks_compile_quickly name)
    target_compile_options(raks_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# raks_test_program(audio [COMPUTES] SOURCES ... LIBRARIES ... [LABELS ...] [NEEDS servers|display] [TIMEOUT seconds] [COST seconds] [LOCK name])
# makes the test program raks_tests_audio (GoogleTest, with the real-time guard linked in) and
# registers each of its suites with ctest. Labels: the room, plus those given, plus what it needs
# that a person's computer may not have: sound servers of its own, or a display (Xvfb). LOCK: none
# of those with the same lock runs beside it. COST: what its longest suites take, about; on a clean
# clone ctest starts with the longest, so that no core idles at the end. COMPUTES: not only what it tests
# takes its time, but also its own code, or templates (Eigen's) whose copy of the test the program runs.
# Which files a program tests is written to RAKS_TEST_FILES, for scripts/sanitize.sh.
function(raks_test_program name)
    cmake_parse_arguments(arg "COMPUTES" "TIMEOUT;COST;LOCK;NEEDS" "SOURCES;LIBRARIES;LABELS" ${ARGN})
    set(target raks_tests_${name})
    add_executable(${target} ${arg_SOURCES})
    target_link_libraries(${target} PRIVATE raks_test_support ${arg_LIBRARIES} raks_warnings)
    set(kind tests)
    if(arg_COMPUTES)
        set(kind computing_tests)
    endif()
    target_compile_options(${target} PRIVATE ${RAKS_OPTIMIZATION_OF_${kind}})
    if(RAKS_PRECOMPILE)
        target_precompile_headers(${target} REUSE_FROM raks_precompiled_${kind})
    endif()
    target_compile_definitions(${target} PRIVATE RAKS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    if(NOT arg_TIMEOUT)
        set(arg_TIMEOUT 400)
    endif()
    list(JOIN arg_LABELS ";" labels)
    list(APPEND labels ${arg_NEEDS})
    set(properties "TIMEOUT ${arg_TIMEOUT} LABELS [=[${name};${labels}]=]")
    string(APPEND properties " WORKING_DIRECTORY [=[${CMAKE_CURRENT_BINARY_DIR}]=]")
    if(arg_COST)
        string(APPEND properties " COST ${arg_COST}")
    endif()
    if(arg_LOCK)
        string(APPEND properties " RESOURCE_LOCK ${arg_LOCK}")
    endif()
    set(each suite)
    if(arg_NEEDS STREQUAL "servers")
        set(each test)  # they wait for real time: two at a time
    endif()
    set(suites "${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake")
    add_custom_command(TARGET ${target} POST_BUILD
        BYPRODUCTS "${suites}"
        COMMAND "${CMAKE_COMMAND}" "-DPROGRAM=$<TARGET_FILE:${target}>"
                "-DSUITES_FILE=${suites}" "-DPROPERTIES=${properties}" "-DEACH=${each}"
                -P "${PROJECT_SOURCE_DIR}/cmake/DiscoverSuites.cmake"
        VERBATIM)
    raks_note_tested_files(${name})
    # A program that was not built has no tests.
    set(include "${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake")
    file(WRITE "${include}" "include([=[${suites}]=] OPTIONAL)\n")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${include}")
endfunction()

# One line of RAKS_TEST_FILES: the program, and all sources of its own and of the libraries of ours that
# it names.
set(RAKS_TEST_FILES ${CMAKE_BINARY_DIR}/test_files.txt)
file(WRITE ${RAKS_TEST_FILES} "")
function(raks_note_tested_files name)
    set(line ${name})
    get_target_property(libraries raks_tests_${name} LINK_LIBRARIES)
    list(FILTER libraries INCLUDE REGEX "^raks::")
    foreach(target raks_tests_${name} ${libraries})
        string(REGEX REPLACE "^raks::" "raks_" target "${target}")
        if(NOT TARGET ${target} OR NOT target MATCHES "^raks_")
            continue()
        endif()
        get_target_property(sources ${target} SOURCES)
        get_target_property(folder ${target} SOURCE_DIR)
        foreach(source ${sources})
            cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} NORMALIZE)
            cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
            string(APPEND line " ${source}")
        endforeach()
    endforeach()
    file(APPEND ${RAKS_TEST_FILES} "${line}\n")
endfunction()

# A system library found by pkg-config, as imported target PkgConfig::NAME whose headers are
# SYSTEM (no warnings from them).
function(raks_pkg name)
    pkg_check_modules(${name} REQUIRED IMPORTED_TARGET GLOBAL ${ARGN})
endfunction()
