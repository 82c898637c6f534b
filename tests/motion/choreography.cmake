raks_test_program(choreography
    SOURCES choreography/authored_dance_test.cpp choreography/figure_evaluation_test.cpp
    LIBRARIES raks::motion_choreography fmt::fmt)
