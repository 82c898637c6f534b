raks_test_program(evaluate
    SOURCES evaluate/amplitude_test.cpp evaluate/beat_alignment_test.cpp
            evaluate/captured_dance_test.cpp evaluate/couple_measures_test.cpp evaluate/dance_measures_test.cpp
            evaluate/foot_skating_test.cpp evaluate/reference_metrics_test.cpp
            evaluate/repeat_distance_test.cpp
    LIBRARIES raks::motion_evaluate nlohmann_json::nlohmann_json)
