raks_test_program(skeleton
    SOURCES skeleton_test.cpp skeleton/bvh_test.cpp skeleton/odd_and_bad_test.cpp
    LIBRARIES raks::motion_skeleton nlohmann_json::nlohmann_json)
