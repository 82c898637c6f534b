#include "render/stage_painter.hpp"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "render/scene/stage_shapes.hpp"

namespace raks::render {
namespace {

/// A mesh with one attribute: the vertex itself.
template <typename Vertex>
gl::Mesh float_mesh(const Shape<Vertex>& shape) {
    const std::array<gl::Attribute, 1> attributes = {
        {{.location = 0, .components = static_cast<GLint>(Vertex::length()), .type = GL_FLOAT}}};
    return {std::as_bytes(std::span(shape.vertices)), sizeof(Vertex), attributes, shape.indices};
}

/// The program of one part of the stage. Vertex and fragment shader have the same stem.
enum class Floor { plain, tiled };

Expected<gl::Program> build(Quality quality,
                            std::string_view name,
                            std::string_view vertex,
                            Floor floor = Floor::plain) {
    const std::string_view stem = vertex.substr(0, vertex.find('.'));
    const std::string fragment_file = std::string(stem) + ".frag";
    const std::array<std::string_view, 2> vertex_files = {"frame.glsl", vertex};
    const std::array<std::string_view, 4> fragment_files = {
        "frame.glsl", "shadow.glsl", "tiles.glsl", fragment_file};
    const std::array<std::string_view, 2> defines = {
        quality == Quality::fast ? std::string_view("FAST") : std::string_view("HIGH"),
        floor == Floor::tiled ? std::string_view("TILES") : std::string_view("PLAIN")};
    return gl::Program::build({name, vertex_files, fragment_files, defines});
}

}  // namespace

Expected<StagePainter> StagePainter::create(Quality quality) {
    Expected<gl::Program> floor = build(quality, "floor", "floor.vert");
    if (!floor) {
        return fail(std::move(floor.error()));
    }
    Expected<gl::Program> tiled = build(quality, "tiled floor", "floor.vert", Floor::tiled);
    if (!tiled) {
        return fail(std::move(tiled.error()));
    }
    Expected<gl::Program> rings = build(quality, "beat rings", "ring.vert");
    if (!rings) {
        return fail(std::move(rings.error()));
    }
    Expected<gl::Program> backdrop = build(quality, "backdrop", "backdrop.vert");
    if (!backdrop) {
        return fail(std::move(backdrop.error()));
    }
    Expected<gl::Program> beams = build(quality, "beams", "beam.vert");
    if (!beams) {
        return fail(std::move(beams.error()));
    }
    return StagePainter(quality,
                        Programs{std::move(*floor),
                                 std::move(*tiled),
                                 std::move(*rings),
                                 std::move(*backdrop),
                                 std::move(*beams)});
}

StagePainter::StagePainter(Quality quality, Programs programs)
    : quality_(quality),
      floor_(float_mesh(floor_disc())),
      ring_(float_mesh(ring_strip())),
      backdrop_(float_mesh(backdrop_grid())),
      beam_(float_mesh(beam_strip())),
      programs_(std::move(programs)) {}

void StagePainter::draw_floor(const TileFloor& tiles) const noexcept {
    (tiles.size > 0.0F ? programs_.tiled_floor : programs_.floor).use();
    floor_.draw();
}

void StagePainter::draw_rings(int count) const noexcept {
    // In high quality the floor's fragment shader draws the rings.
    if (quality_ == Quality::fast) {
        programs_.rings.use();
        ring_.draw_instances(count);
    }
}

void StagePainter::draw_beams(const LightBeams& beams) const noexcept {
    programs_.beams.use();
    glUniform1i(programs_.beams.uniform("beams"), beams.count);
    beam_.draw_instances(beams.count + 1);
}

void StagePainter::draw_backdrop() const noexcept {
    programs_.backdrop.use();
    backdrop_.draw();
}

}  // namespace raks::render
