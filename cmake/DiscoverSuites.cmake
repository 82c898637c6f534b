# Run after a test program was linked: writes SUITES_FILE, in which each of its suites is a test for
# ctest. One process a suite, and not a test: starting a process that links a hundred libraries
# takes longer than most tests. With EACH=test each test is one.
# Set: PROGRAM, SUITES_FILE, PROPERTIES (of every test, as for set_tests_properties), EACH.
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests
    OUTPUT_VARIABLE list RESULT_VARIABLE failed)
if(failed)
    message(FATAL_ERROR "${PROGRAM} --gtest_list_tests failed: ${failed}")
endif()
set(text "")
function(add_one name filter)
    string(APPEND text
        "add_test([=[${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${filter}]=])\n"
        "set_tests_properties([=[${name}]=] PROPERTIES ${PROPERTIES})\n")
    set(text "${text}" PARENT_SCOPE)
endfunction()
# A suite's line ends in a dot; those of its tests are indented.
string(REGEX MATCHALL "[^\n]+" lines "${list}")
foreach(line IN LISTS lines)
    string(REGEX REPLACE " *#.*" "" line "${line}")
    if(line MATCHES "^([A-Za-z0-9_/]+)\\.$")
        set(suite "${CMAKE_MATCH_1}")
        if(NOT EACH STREQUAL "test")
            add_one("${suite}" "${suite}.*")
        endif()
    elseif(EACH STREQUAL "test" AND line MATCHES "^  ([A-Za-z0-9_/]+)$")
        add_one("${suite}.${CMAKE_MATCH_1}" "${suite}.${CMAKE_MATCH_1}")
    endif()
endforeach()
file(WRITE "${SUITES_FILE}" "${text}")
