// Strip picture: what is written and drawn around the bodies of a strip.
#pragma once

#include <span>
#include <string>

#include "apps/grid/beat_strip.hpp"
#include "render/pose_sheet.hpp"
#include "training/cells/grid_cues.hpp"

namespace raks::apps {

/// Sizes of a strip; pixels. As wide as what is looked at without being made smaller.
inline constexpr int kStripTileWidth = 96;
inline constexpr int kStripTileHeight = 148;  ///< of a body
inline constexpr int kStripTitle = 44;        ///< above all rows
inline constexpr int kStripLine = 20;         ///< below each row: number and time
inline constexpr int kStripLane = 34;         ///< below that: landings, and the hips' height
/// From the top of a row to that of the next.
inline constexpr int kStripRowHeight = kStripTileHeight + kStripLine + kStripLane;

/// A page of a strip from its bodies. `bodies`: a sheet of tiles of the sizes above, kStripColumns
/// a row without gaps, one for each picture of `rows` in order. Below a body stand the beat's
/// number in its take, from 1, and its time, amber on beats of the first half of the bar; bodies of
/// beats that are not used are grey. Below these landings stand where they are between the
/// pictures, left and right in the colours of these sides, over the height of the hips. Pure.
[[nodiscard]] render::PoseSheet paint_strip(const std::string& title,
                                            std::span<const StripRow> rows,
                                            const render::PoseSheet& bodies,
                                            const motion::GridCues& cues);

/// Where a moment is in a row, pixels from its left: between its pictures as their times say, as
/// far beyond the outer ones as half a picture; elsewhere outside of the row's pictures.
[[nodiscard]] double strip_place(const StripRow& row, double time);

}  // namespace raks::apps
