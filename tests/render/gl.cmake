raks_test_program(render_gl
    SOURCES gl/clip_figure_test.cpp gl/scene_test.cpp gl/offscreen_test.cpp gl/renderer_test.cpp gl/pose_sheet_test.cpp
    LIBRARIES raks::render_renderer raks::render_avatar)
