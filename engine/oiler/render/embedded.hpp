// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace oiler::embedded {

extern "C" {
extern const char oiler_disc_frag[], oiler_disc_frag_end[];
extern const char oiler_disc_vert[], oiler_disc_vert_end[];
extern const char oiler_line_frag[], oiler_line_frag_end[];
extern const char oiler_line_vert[], oiler_line_vert_end[];
extern const char oiler_overlay_frag[], oiler_overlay_frag_end[];
extern const char oiler_overlay_vert[], oiler_overlay_vert_end[];
extern const char oiler_splats_frag[], oiler_splats_frag_end[];
extern const char oiler_splats_vert[], oiler_splats_vert_end[];
extern const char oiler_sprite_frag[], oiler_sprite_frag_end[];
extern const char oiler_sprite_vert[], oiler_sprite_vert_end[];
extern const char oiler_text_frag[], oiler_text_frag_end[];
extern const char oiler_text_vert[], oiler_text_vert_end[];
extern const char oiler_font[], oiler_font_end[];
}

inline std::string_view disc_frag() { return {oiler_disc_frag, oiler_disc_frag_end}; }
inline std::string_view disc_vert() { return {oiler_disc_vert, oiler_disc_vert_end}; }
inline std::string_view line_frag() { return {oiler_line_frag, oiler_line_frag_end}; }
inline std::string_view line_vert() { return {oiler_line_vert, oiler_line_vert_end}; }
inline std::string_view overlay_frag() { return {oiler_overlay_frag, oiler_overlay_frag_end}; }
inline std::string_view overlay_vert() { return {oiler_overlay_vert, oiler_overlay_vert_end}; }
inline std::string_view splats_frag() { return {oiler_splats_frag, oiler_splats_frag_end}; }
inline std::string_view splats_vert() { return {oiler_splats_vert, oiler_splats_vert_end}; }
inline std::string_view sprite_frag() { return {oiler_sprite_frag, oiler_sprite_frag_end}; }
inline std::string_view sprite_vert() { return {oiler_sprite_vert, oiler_sprite_vert_end}; }
inline std::string_view text_frag() { return {oiler_text_frag, oiler_text_frag_end}; }
inline std::string_view text_vert() { return {oiler_text_vert, oiler_text_vert_end}; }
inline std::span<const char> font() { return {oiler_font, oiler_font_end}; }

}  // namespace oiler::embedded
