raks_test_program(choreography
    SOURCES choreography/authored_dance_test.cpp choreography/authored_training_test.cpp
            choreography/figure_evaluation_test.cpp choreography/hand_timing_test.cpp
    LIBRARIES raks::motion_choreography raks::motion_dance raks::motion_figures fmt::fmt)
