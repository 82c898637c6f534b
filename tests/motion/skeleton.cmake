raks_test_program(skeleton
    SOURCES skeleton_test.cpp
    LIBRARIES raks::motion_skeleton)
