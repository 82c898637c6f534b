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
    else()
        add_library(${target} INTERFACE)
        target_include_directories(${target} INTERFACE ${PROJECT_SOURCE_DIR})
        target_link_libraries(${target} INTERFACE raks_options ${arg_PUBLIC})
    endif()
    add_library(raks::${name} ALIAS ${target})
endfunction()

# raks_test_program(audio SOURCES ... LIBRARIES ... [LABELS ...])
# makes the test program raks_tests_audio (GoogleTest, with the real-time guard linked in) and
# registers each of its tests with ctest. Labels: the room, plus those given.
function(raks_test_program name)
    cmake_parse_arguments(arg "SERIAL" "TIMEOUT" "SOURCES;LIBRARIES;LABELS" ${ARGN})
    set(target raks_tests_${name})
    add_executable(${target} ${arg_SOURCES})
    target_link_libraries(${target} PRIVATE raks_test_support ${arg_LIBRARIES} raks_warnings)
    target_compile_definitions(${target} PRIVATE RAKS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    if(NOT arg_TIMEOUT)
        set(arg_TIMEOUT 120)
    endif()
    set(properties TIMEOUT ${arg_TIMEOUT} LABELS "${name};${arg_LABELS}")
    if(arg_SERIAL)
        list(APPEND properties RUN_SERIAL TRUE)
    endif()
    gtest_discover_tests(${target}
        PROPERTIES ${properties}
        DISCOVERY_TIMEOUT 60)
endfunction()

# A system library found by pkg-config, as imported target PkgConfig::NAME whose headers are
# SYSTEM (no warnings from them).
function(raks_pkg name)
    pkg_check_modules(${name} REQUIRED IMPORTED_TARGET GLOBAL ${ARGN})
endfunction()
