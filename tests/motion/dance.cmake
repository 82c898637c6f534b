raks_test_program(dance
    SOURCES dance/choreography_test.cpp dance/dancer_test.cpp dance/ensemble_test.cpp dance/figure_size_test.cpp dance/frame_generator_test.cpp dance/hands_test.cpp dance/landing_test.cpp dance/parts_test.cpp dance/position_dance_test.cpp dance/repertoire_test.cpp dance/salsa_test.cpp dance/steps_test.cpp
            dance/stage.cpp
            evaluate/dance_metrics_test.cpp
    LIBRARIES raks::motion_dancer raks::motion_dance raks::motion_evaluate raks::motion_figures
    TIMEOUT 300)
