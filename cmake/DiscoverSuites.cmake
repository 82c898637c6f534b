# Run after a test program was linked: writes SUITES_FILE, in which each of its suites is a test for
# ctest. One process a suite, and not a test: starting a process that links a hundred libraries
# takes longer than most tests.
# Set: PROGRAM, SUITES_FILE, PROPERTIES (of every test, as for set_tests_properties).
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests
    OUTPUT_VARIABLE list RESULT_VARIABLE failed)
if(failed)
    message(FATAL_ERROR "${PROGRAM} --gtest_list_tests failed: ${failed}")
endif()
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${list}")
set(text "")
foreach(suite IN LISTS suites)
    string(STRIP "${suite}" suite)  # with the dot, which ends the name
    string(REGEX REPLACE "\\.$" "" name "${suite}")
    string(APPEND text
        "add_test([=[${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}*]=])\n"
        "set_tests_properties([=[${name}]=] PROPERTIES ${PROPERTIES})\n")
endforeach()
file(WRITE "${SUITES_FILE}" "${text}")
