/**
 * @file film.hpp
 * Films from numbered pictures, by ffmpeg.
 */
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace elvis::commands {

/** Throws Error if there is no ffmpeg on the PATH, before anything is drawn for it. */
void require_film_maker();

/** Names of an animation's pictures: the same for one run and the next, however many there are. */
inline constexpr const char* frame_pattern = "frame_%04d.png";
std::string frame_name(std::uint32_t frame);

/**
 * Makes a film of `pattern` (with %04d for the number, from 0), of the kind that its name ends in, at `frames_a_second`. It
 * appears whole or not at all. Throws Error with what ffmpeg says.
 */
void make_film(const std::filesystem::path& pattern, double frames_a_second, const std::filesystem::path& film);

} // namespace elvis::commands
