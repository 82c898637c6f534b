raks_test_program(avatar
    SOURCES avatar/mannequin_mesh_test.cpp
            avatar/mannequin_skin_test.cpp
            avatar/palette_test.cpp
            avatar/posed_mesh.cpp
    LIBRARIES raks::render_avatar)
